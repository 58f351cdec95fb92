// What the options common to all commands ask for, and the scene, lights and camera they come to.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/shadow_choice.h"
#include "error.h"
#include "lamplight/triangle_lists.h"
#include "lamplight/world_tree.h"
#include "render/kept_rays.h"
#include "render/probe_captures.h"
#include "render/renderer.h"
#include "render/verification.h"
#include "scene/free_camera.h"
#include "scene/light_path.h"
#include "scene/open_air.h"
#include "scene/scene.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lamp::app {

struct Request {
  std::string scene = "atrium";
  std::string size = "1280x720";
  bool size_given = false;  ///< on the command line: a capture has its own
  std::uint32_t lights = 4096;
  bool lights_given = false;         ///< on the command line: to a capture, lights are added when asked for
  std::string_view about_generated;  ///< first option on the command line that speaks of generated lights
  float spots = 0.5F;
  std::string range;                     ///< "MIN:MAX" or "inf", empty: automatic
  std::uint32_t decals = 0;              ///< the scene's own, then generated ones
  std::uint32_t probes = 0;              ///< the scene's own, then generated ones
  std::string probes_show = "captures";  ///< or "flat", a colour each
  std::uint32_t probe_budget = 4;        ///< captures that are renewed in a frame
  std::uint64_t seed = 1;
  std::string method = "auto";
  std::vector<std::string> options;
  std::string path = "deferred";
  std::string brdf = "ggx";
  float still = 0.0F;                        ///< part of the generated lights that stand still; the scene's own do
  std::string still_lists = "off";           ///< or what they are looked up in
  std::uint32_t still_occlusion = 0;         ///< texels a side of what each looks around with; 0: walls hide nothing
  float still_bytes = 16.0F;                 ///< that their lists take, for each triangle
  bool moving = false;                       ///< small instances move with the frames
  float mirror = 0.0F;                       ///< roughness from which on surfaces mirror nothing; 0: none does
  std::string mirror_lists = "world-cells";  ///< of what mirror rays meet
  ShadowChoice shadows;
  std::string camera;
  int frame = -1;                         ///< of the flight; -1: the camera
  int light_frame = -1;                   ///< of the generated lights' paths; -1: as the flight's
  std::optional<FreeCamera> free_camera;  ///< in place of the camera; not with a frame of the flight
  std::string projection = "camera";
  std::string depth = "reversed";   ///< or "standard": which way device depth runs
  std::uint32_t depth_samples = 1;  ///< a pixel, of what lights are culled with: 1, 2, 4 or 8
  float stereo_m = 0.0F;            ///< between two eyes, which share the picture's width; 0: one eye
  std::uint32_t views = 1;          ///< of a frame, turned about the vertical; not with two eyes
  std::string device;
  std::string shader_dir;
  bool pipeline_statistics = false;
  std::string calibration;  ///< file that `auto` goes by; empty: the user's cache
  bool explain = false;     ///< say what `auto` predicts
  bool grow = false;        ///< make room until everything fits
};

/// Adds what all commands with a scene take: the scene, its camera, its lights, the device.
void add_scene_options(CLI::App& command, Request& request);
/// The same, and the size and the projection of a picture.
void add_common_options(CLI::App& command, Request& request);
/// Adds `--method` for several methods; `help` says what is done with them.
void add_method_option(CLI::App& command, std::vector<std::string>& methods, const std::string& help);
/// Adds `--method` for one method or auto, and what goes with it: `--option`, `--path`, `--grow`, `--explain`,
/// `--calibration`, `--decals`, `--probes`.
void add_picture_options(CLI::App& command, Request& request);
/// Adds `--option`.
void add_option_option(CLI::App& command, Request& request);
/// Adds `--depth` and `--depth-samples`, for commands that can draw it so.
void add_depth_options(CLI::App& command, Request& request);
/// Adds `--stereo`.
void add_stereo_option(CLI::App& command, Request& request);
/// Adds `--brdf`.
void add_brdf_option(CLI::App& command, Request& request);
/// Adds `--path` and `--brdf`.
void add_path_option(CLI::App& command, Request& request);
/// Adds `--grow`.
void add_grow_option(CLI::App& command, Request& request);
/// Adds `--explain` and `--calibration`.
void add_auto_options(CLI::App& command, Request& request);
/// Adds `--shadows` and what goes with it; the second without `--shadow-budget`.
void add_shadow_options(CLI::App& command, Request& request);
void add_shadow_map_options(CLI::App& command, Request& request);
/// Adds `--mirror` and `--mirror-lists`.
void add_mirror_options(CLI::App& command, Request& request);
void add_moving_flag(CLI::App& command, Request& request);
/// Adds `--still-lists` and what goes with it.
void add_still_options(CLI::App& command, Request& request);
void add_still_bytes_option(CLI::App& command, Request& request);
/// Adds `--decals`, for commands whose numbers and pictures may have them.
void add_decal_option(CLI::App& command, Request& request);
/// Adds `--probes`, likewise; with add_probe_options also what they show, and how many captures a frame renews.
CLI::Option* add_probe_option(CLI::App& command, Request& request);
void add_probe_options(CLI::App& command, Request& request);
/// Adds `-o` and `--out`.
CLI::Option& add_out_option(CLI::App& command, std::string& out, const std::string& help);
/// Adds `--pipeline-statistics`, for commands that have numbers of each pass.
void add_statistics_flag(CLI::App& command, Request& request);
/// Adds `--json`.
void add_json_flag(CLI::App& command, bool& json, const std::string& help);

/// Throws Error, naming the option, if one of the values is there twice.
void check_once(std::string_view option, std::vector<std::string> values);

/// Throws Error for whatever can be known to be wrong before a scene is loaded: the method (`auto` or one of the
/// table), its options, size, path, BRDF.
void check_request(const Request& request, const std::string& method);

/// An error of these checks for those who do not type options: "--shadow-blur" is what `name` makes of "shadow-blur".
[[nodiscard]] std::string with_options_named(std::string_view error,
                                             const std::function<std::string(std::string_view)>& name);

/// A request made concrete on the host: nothing of it needs a device.
struct Setup {
  Scene scene;
  std::vector<Instance> at_rest;      ///< the scene's instances, where they move; else empty
  View view;                          ///< the first of these
  std::vector<View> views;            ///< of the frame, all of one size
  std::vector<Light> generated;       ///< besides the scene's own
  std::vector<shared::Light> lights;  ///< the scene's, then the generated ones; with still ones, these last
  std::uint32_t still = 0;            ///< how many lights stand still, the last ones
  bool still_lists = false;           ///< these are in lists of their own
  /// The lights that a picture's lists have.
  [[nodiscard]] std::span<const shared::Light> listed() const {
    return std::span(lights).first(lights.size() - (still_lists ? still : 0));
  }
  [[nodiscard]] std::span<const shared::Light> standing() const { return std::span(lights).last(still); }
  std::vector<gpu::DecalData> decals;
  std::vector<gpu::ProbeData> probes;  ///< in the order of their ids
  std::string probes_note;
  /// How many decals and probes there are.
  [[nodiscard]] std::size_t boxes() const { return decals.size() + probes.size(); }
  std::string decals_note;  ///< "44 of the scene + 20 generated"
  std::string lights_note;  ///< "4096 generated (range 1.20 to 2.80 m) + 0 of the scene"
};
[[nodiscard]] Setup make_setup(const Request& request);

/// The parts of a Setup, for who keeps a scene from frame to frame. Throw Error for what the scene does not have.
[[nodiscard]] View requested_view(const Request& request, const Scene& scene);
[[nodiscard]] std::vector<View> requested_views(const Request& request, const Scene& scene);
/// The generated lights. `air`: the scene's.
[[nodiscard]] std::vector<Light> requested_lights(const Request& request, const Scene& scene, const OpenAir& air);
/// A frame's lights in the order that the request asks for, and the paths of the generated ones, which come one after
/// the other: at another time they are elsewhere on these, and otherwise the same.
struct MovingLights {
  std::vector<shared::Light> lights;
  std::vector<LightPath> paths;
  std::uint32_t first = 0;  ///< the light that the first path belongs to
};
/// `air`: the scene's; without, nothing is generated.
[[nodiscard]] MovingLights requested_moving_lights(const Request& request, const Scene& scene, const OpenAir* air);
/// Where the request's frame has the lights on their paths.
[[nodiscard]] PathTime requested_time(const Request& request, const Scene& scene);
/// The scene's, then the generated ones, as the GPU has them.
[[nodiscard]] std::vector<shared::Light> packed_lights(const Scene& scene, std::span<const Light> generated);
/// The same in the order that the request asks for: those that stand still, the scene's among them, are the last.
[[nodiscard]] std::vector<shared::Light> packed_lights(const Request& request, const Scene& scene,
                                                       std::span<const Light> generated);
/// Whether the scene's lights come behind the generated ones in that order.
[[nodiscard]] bool generated_first(const Request& request);
/// How many of them stand still; 0 where nobody asks for it.
[[nodiscard]] std::uint32_t still_lights(const Request& request, const Scene& scene, std::size_t generated);
/// The decals. Throws Error for a capture, and for boxes that none can be.
[[nodiscard]] std::vector<gpu::DecalData> requested_decals(const Request& request, const Scene& scene);
/// The probes as they are made. Throws Error for a capture, and for probes that none can be.
[[nodiscard]] std::vector<Probe> requested_probes(const Request& request, const Scene& scene);
/// To a capture lights are added only where a number of them is asked for. Throws Error for what else is said of them.
void check_generated(const Request& request, const Scene& scene);
/// The scene's lights and the generated ones are few enough, and as lights must be.
void check_scene_lights(const Request& request, const Scene& scene);

/// The scene of a name, a file or a capture's folder. Throws Error with the nearest names.
[[nodiscard]] Scene load_scene(const std::string& name);

/// "1280x720" to numbers, each 1 or more.
[[nodiscard]] glm::uvec2 parse_size(const std::string& text, std::string_view option = "--size");
/// "MIN:MAX" or one number, in metres; both infinite for "inf": no range; 0, 0 when empty: automatic.
[[nodiscard]] std::pair<float, float> parse_range(const std::string& text);
[[nodiscard]] ShadingPath parse_path(const std::string& text);
[[nodiscard]] Brdf parse_brdf(const std::string& text);
/// "reversed" or "standard"; 1, 2, 4 or 8 samples.
[[nodiscard]] HostDepth parse_depth(const std::string& text, std::uint32_t samples);
/// Of `--shadows` and what goes with it; nothing if they are off. Throws Error for a capture, where it is known.
[[nodiscard]] std::optional<ShadowSettings> requested_shadows(const Request& request);
[[nodiscard]] std::optional<ShadowSettings> requested_shadows(const Request& request, const Scene& scene);
/// The first option of a method that cuts lights by their shadow maps.
[[nodiscard]] std::optional<std::string_view> cut_by_shadows(std::span<const std::string> options);
/// Throws Error for what they cannot be, on any device.
void check_shadow_choice(const Request& request);
/// Throws Error, naming `--probes-show`.
void check_probes_show(const Request& request);
/// What `--probes-show` takes.
[[nodiscard]] std::span<const std::string_view> probes_show_names();
/// What `--shadows`, `--point-shadows` and `--depth` take.
[[nodiscard]] std::span<const std::string_view> shadow_names();
[[nodiscard]] std::span<const std::string_view> point_shadow_names();
[[nodiscard]] std::span<const std::string_view> shadow_raster_names();
[[nodiscard]] std::span<const std::string_view> shadow_blur_names();
/// Where instances move: puts the setup's where they are in its frame.
void move_instances(const Request& request, Setup& setup);
/// Of `--mirror`; nothing where no surface mirrors. Throws Error for what it does not go with.
[[nodiscard]] std::optional<MirrorSettings> requested_mirror(const Request& request, const Scene& scene);
/// The same, as far as it is known before a scene is loaded.
void check_mirror(const Request& request);
/// What `--still-lists` takes.
[[nodiscard]] std::span<const std::string_view> still_lists_names();
/// Throws Error for `--still-lists` and what goes with it, as far as it is known before a scene is loaded.
void check_still(const Request& request);
/// The same with a look at the scene, which a capture has no triangles of.
void check_still(const Request& request, const Scene& scene);
[[nodiscard]] std::span<const std::string_view> depth_names();
/// What `--brdf`, `--verifier` take.
[[nodiscard]] std::span<const std::string_view> brdf_names();
[[nodiscard]] std::span<const std::string_view> verifier_names();
/// As `--shadows` takes it.
[[nodiscard]] std::string_view shadow_filter_name(ShadowFilter filter);
/// "oracle", "gpu" or "auto": by the number of pairs where the device has double precision, else the oracle. Throws
/// Error for `gpu` where it has not.
[[nodiscard]] VerifierChoice parse_verifier(const std::string& text, const Context& context);
/// Adds `--verifier`.
void add_verifier_option(CLI::App& command, std::string& verifier);
/// Pairs of pixel and light that brute force walks in about a minute on a software device, and on a GPU in the second
/// or two after which a desktop takes the device away.
[[nodiscard]] std::uint64_t brute_force_pairs(const Context& context);
/// Lights that brute force surely walks at a pixel: a device may end a thread's loops.
[[nodiscard]] std::uint64_t brute_force_lights(const Context& context);
/// Throws Error for options where there is more than one method that they could be of.
void check_one_method(std::size_t methods, std::span<const std::string> options);
/// A method of the table, by its name.
[[nodiscard]] const Method& parse_method(const std::string& text);
/// A method with options of its own, in one word: "tiled:tile=8,bounds=mask".
struct MethodWord {
  std::string method;  ///< or auto
  std::vector<std::string> options;
};
/// Throws Error for options of auto, which chooses its own; names and values are not checked.
[[nodiscard]] MethodWord parse_method_word(const std::string& text);
/// Whether a method's name asks for whatever suits best.
[[nodiscard]] bool is_auto(std::string_view method);

/// Longer lists in place of those of a lighting that `asked` for some, as long as the renderer's frame needs. False:
/// they fit, or options and device allow no longer ones.
bool make_room(Renderer& renderer, const ShaderLibrary& shaders, Lighting& lighting, const Options& asked);

/// Lists of the lights that stand still, and what they were made of.
struct StillSetup {
  std::vector<StillTriangle> triangles;
  TriangleLists lists;            ///< of `triangles`, or
  std::optional<WorldTree> tree;  ///< of the world
  double build_ms = 0.0;

  [[nodiscard]] std::uint32_t kind() const { return tree ? gpu::STILL_TREE : gpu::STILL_TRIANGLES; }
  [[nodiscard]] std::span<const std::uint32_t> words() const { return tree ? tree->words() : lists.words; }
  /// The list that a look-up finds.
  [[nodiscard]] std::vector<std::uint32_t> lights_at(const gpu::StillPoint& point) const {
    return tree ? tree->lights_at(point.position) : lamp::lights_at(lists, point.triangle, point.position);
  }
};
/// Of `--still-lists`.
[[nodiscard]] std::uint32_t still_kind(const std::string& lists);
struct StillInfo {
  const Scene& scene;
  float margin_m = 0.0F;  ///< of `still_margin`
  std::span<const shared::Light> lights;
  bool painted = false;  ///< decals may bend normals
};
/// How far rounding and the rasterizer may move the points that these views look up, or, for a tree, how far away eyes
/// may be; metres. In steps: views near each other have the same. `scene`: its bounds.
[[nodiscard]] float still_margin(const Request& request, const Box& scene, std::span<const View> views,
                                 const DeviceTraits& traits);
[[nodiscard]] StillSetup make_still(const Request& request, const StillInfo& of);

/// Device, renderer and what they need, for one Setup.
class Session {
 public:
  Session(const Request& request, const Setup& setup,
          ContextInfo::Validation validation = ContextInfo::Validation::off);

  /// With `--grow`, with as much room as the frame needs.
  [[nodiscard]] Lighting lighting(const Method& method, const std::vector<std::string>& options,
                                  ShadingPath path) const;
  [[nodiscard]] Renderer& renderer() { return *renderer_; }
  [[nodiscard]] const GpuScene& gpu_scene() const { return *gpu_scene_; }
  /// The scene as rays read it, where its instances are: the mirrors', or made at the first call, in a while.
  [[nodiscard]] const MirrorScene& rays() { return rays_.of(*context_, *gpu_scene_, *renderer_); }
  /// Null: all lights are the picture's.
  [[nodiscard]] const StillSetup* still() const { return still_ ? &*still_ : nullptr; }
  /// Whether the next frames look up still lights in their lists, which they do at first, or have all lights in the
  /// picture's, for comparison. Shows the setup's frame anew; lightings are made for one of them.
  void split_still(bool splits);
  /// Null: no probe shows what it saw.
  [[nodiscard]] const ProbeCaptures* captures() const { return captures_.get(); }
  /// The setup's lights or instances are elsewhere: renews captures of probes, as many as the request allows.
  void renew_probes();
  /// The setup's instances are elsewhere. Before the frame is set.
  void move_instances();
  [[nodiscard]] Context& context() { return *context_; }
  [[nodiscard]] const ShaderLibrary& shaders() const { return shaders_; }

 private:
  void make_probes(const Request& request);

  const Setup& setup_;
  Brdf brdf_;
  HostDepth depth_;
  std::optional<ShadowSettings> shadows_;
  bool grow_;
  std::uint32_t probe_budget_;
  std::optional<StillSetup> still_;
  ShaderLibrary shaders_;
  std::unique_ptr<Context> context_;
  std::unique_ptr<GpuScene> gpu_scene_;
  KeptRays rays_;
  std::unique_ptr<StillLists> still_lists_;
  std::unique_ptr<FlatProbes> flat_probes_;
  std::unique_ptr<ProbeCaptures> captures_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace lamp::app
