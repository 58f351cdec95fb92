// Draws states: keeps the scene, its lights, the renderer and the last few lightings, and makes anew only what a state
// changed. One thread at a time.
// Promise: a picture that is saved is that of `lamp render` with the same options, bit for bit on the same device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <glm/glm.hpp>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands/auto_method.h"
#include "render/display.h"
#include "view/shown.h"
#include "view/still_pixels.h"

namespace lamp::app {

class Stage {
 public:
  Stage(Context& context, const ShaderLibrary& shaders, const std::string& calibration);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Draws the state in this size; a captured frame has its own. Throws Error: nothing that was shown before changes.
  [[nodiscard]] Shown draw(const ViewState& state, glm::uvec2 size);

  /// The picture of the state in the size that its request says.
  struct Picture {
    HdrImage radiance;
    LdrImage toned;
  };
  /// `follows`: shadow maps go on from those of the picture before, as in a flight.
  [[nodiscard]] Picture picture(const ViewState& state, bool follows = false);
  /// The frame of that picture as a capture's scene.
  [[nodiscard]] Scene capture(const ViewState& state);

  /// Holds the lists of all pixels against the oracle: the first method's, and the second's if the state has one.
  [[nodiscard]] std::vector<Proof> prove(const ViewState& state, glm::uvec2 size);
  /// What each method of the table would list for the state's picked pixel: those of the picture with the state's
  /// options, others with their own.
  [[nodiscard]] std::vector<OtherList> ask_others(const ViewState& state, glm::uvec2 size);
  /// How much of that is done, 0 .. 1; from any thread.
  [[nodiscard]] float progress() const { return progress_; }

 private:
  struct KeptScene;
  struct KeptLights;
  struct KeptLighting {
    std::string key;
    Lighting lighting;
    Options asked;      ///< from which it grew
    bool full = false;  ///< lists overflow, and cannot be longer
  };
  struct Chosen {
    Lighting& lighting;
    bool by_auto = false;
  };
  struct KeptProbes;
  struct KeptStill;
  /// Of captures that are old, those that are renewed before a frame.
  enum class Captures : std::uint8_t { some, all };
  void need_scene(const Request& request);
  /// Its instances where the request's frame has them, where they move.
  void move_scene(const Request& request);
  void make_renderer(const Request& request, const View& view, std::string key);
  void renew_probes(const ViewState& state, const View& view, Captures which);
  void need_lights(const ViewState& state);
  /// Lists of the lights that stand still, if the request asks for such.
  void need_still(const Request& request, const View& view);
  [[nodiscard]] std::size_t still_count(const Request& request) const;
  /// The lights that the picture's lists have, and how many.
  [[nodiscard]] std::span<const shared::Light> listed_lights() const;
  [[nodiscard]] std::size_t listed_count() const;
  /// Nothing where all lights are the picture's.
  [[nodiscard]] std::optional<StillPixels> still_pixels(std::span<const float> depth);
  /// What pixels walk in lists of still lights, and what these miss; of `depth_`.
  void add_still_walks(std::vector<Visit>& visits);
  void add_still_misses(std::vector<Visit>& visits);
  /// The state's lights at its time, seen from there.
  void move_lights(const View& view);
  /// The scene's instances where they are without moving, on the CPU alone.
  void at_rest();
  /// The same lights once more, from the CPU.
  void bring_lights();
  [[nodiscard]] static bool needs_lights_here(const Lighting& lighting);
  /// The renderer with the state's frame in it.
  void need_frame(const ViewState& state, Captures which);
  [[nodiscard]] MethodChoice choice(const Request& request, const std::string& method,
                                    const std::vector<std::string>& options);
  [[nodiscard]] Chosen lighting(const Request& request, const std::string& method,
                                const std::vector<std::string>& options);
  /// Longer lists, for the lights of this frame. False: they fit, or options and device allow no longer ones.
  [[nodiscard]] bool grow(KeptLighting& kept);
  [[nodiscard]] ShownSide side(const ViewState& state, const Chosen& chosen, Rendered rendered);
  /// Where the second side begins; the width where there is none.
  [[nodiscard]] std::uint32_t divider_x(const ViewState& state) const;
  struct SideOf {
    const std::string& method;
    const std::vector<std::string>& options;
    bool second = false;  ///< right of the divider
    std::uint32_t first_x = 0;
    std::uint32_t end_x = 0;
    double scale_least = 0.0;
  };
  /// Into its columns; and what lit it.
  [[nodiscard]] std::pair<ShownSide, Lighting*> draw_side(const ViewState& state, const SideOf& of, Shown& shown);
  /// Returns what lit both; null: there is no second.
  std::pair<Lighting*, Lighting*> draw_sides(const ViewState& state, Shown& shown);
  /// An overlay of columns of the picture that `lighting` made last.
  struct Overlaying {
    const ViewState& state;
    Lighting& lighting;
    bool second = false;  ///< right of the divider
    bool overflowed = false;
    double scale_least = 0.0;  ///< the top of the scale, unless more is walked
    std::uint32_t first_x = 0;
    std::uint32_t end_x = 0;
  };
  [[nodiscard]] Legend lay_over(const Overlaying& o);
  /// Of `visits_`, which are known.
  [[nodiscard]] Overlaid overlaid(const Overlaying& o);
  [[nodiscard]] Overlaid walk_overlay(const Overlaying& o);
  [[nodiscard]] Overlaid shadow_overlay(const Overlaying& o);
  [[nodiscard]] Overlaid leaks_overlay(const Overlaying& o);
  [[nodiscard]] Overlaid slice_overlay(const Overlaying& o);
  [[nodiscard]] Overlaid light_cells_overlay(const Overlaying& o);
  [[nodiscard]] Overlaid mask_overlay(const Overlaying& o);
  /// What lists of the first method hold besides what its pixels walk, as far as the state asks for it.
  void add_findings(const ViewState& state, Lighting& lighting, Shown& shown);
  /// Of what the method made last; nothing if it has none.
  [[nodiscard]] std::optional<DepthBins> read_bins(const Lighting& lighting);
  [[nodiscard]] ShownProxies read_proxies(const ViewState& state, const Lighting& lighting, const Shown& shown);
  /// Of the light that is looked at; nothing where none is, or no light casts a shadow.
  [[nodiscard]] std::optional<ShownShadow> read_shadow(const ViewState& state);
  [[nodiscard]] std::vector<float> read_square(const shared::ShadowMap& map, std::uint32_t square);
  /// Words of a buffer that a method made.
  [[nodiscard]] std::vector<std::uint32_t> read_words(VkBuffer buffer, std::size_t count, std::size_t first = 0);
  /// What the ray of a pixel meets; nothing where it mirrors nothing, or the sky.
  [[nodiscard]] std::optional<glm::vec3> mirrored_point(glm::uvec2 pixel);
  [[nodiscard]] ShownWorld read_world(const Lighting& lighting, const Inspection& found);
  /// What the other of the two methods walks.
  [[nodiscard]] std::vector<Visit> visits_of_other(const Overlaying& o);
  /// The largest difference of the two methods' pictures.
  [[nodiscard]] float picture_difference(const ViewState& state);
  /// Of all pixels, against the oracle's truth of `depth_`.
  [[nodiscard]] std::vector<Visit> checked_visits(Lighting& lighting);
  [[nodiscard]] Inspected inspected(Lighting& lighting, std::optional<std::uint32_t> light = std::nullopt);
  /// The state's picked pixel, of what is rendered.
  [[nodiscard]] glm::uvec2 picked_pixel(const ViewState& asked) const;
  /// The state's frame in the renderer, drawn by a side's method.
  [[nodiscard]] Lighting& need_drawn(const ViewState& state, glm::uvec2 size, const SideOf& of);

  Context& context_;
  const ShaderLibrary& shaders_;
  DeviceClock clock_;
  AutoMethod chooser_;
  std::unique_ptr<KeptScene> scene_;
  std::unique_ptr<KeptLights> lights_;
  std::unique_ptr<KeptProbes> probes_;  ///< null: there are none
  std::unique_ptr<KeptStill> still_;    ///< null: there are none
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<Display> display_;
  std::string renderer_key_;
  std::list<KeptLighting> lightings_;  ///< the last used first
  std::string auto_key_;               ///< of what `auto_choice_` was made for
  MethodChoice auto_choice_;
  std::vector<Visit> visits_;  ///< of the last walk
  std::vector<float> depth_;
  std::optional<StillPixels> still_at_;  ///< what the last inspection refers to
  std::uint64_t number_ = 0;
  bool made_anew_ = false;
  std::atomic<float> progress_ = 0.0F;
};

}  // namespace lamp::app
