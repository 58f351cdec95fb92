// Shadows for many lights in one image: which light has which squares at which size, and what a host draws this frame.
// The library draws no triangles: a host draws the views of each frame into its image (shared/shadow.h says how),
// uploads the maps, and looks them up with lib/shaders/shadow. docs/shadow-atlas.md shows the whole of it.
// Promise: pure code, no device. Squares do not overlap. What stands still is drawn once and kept where it is. Sizes
// fall before any light goes without a shadow. What waits and what does not fit is counted and named.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/shared/light.h"
#include "lamplight/shared/radial.h"
#include "lamplight/shared/shadow.h"
#include "lamplight/vectors.h"
#include "lamplight/view.h"

namespace lamp {

enum class ShadowFilter : std::uint32_t {
  hard = shared::SHADOW_HARD,
  pcf = shared::SHADOW_PCF,
  vsm = shared::SHADOW_VSM,
  evsm = shared::SHADOW_EVSM,
};

enum class PointShadows : std::uint8_t {
  faces,       ///< six squares, as a cube map has them
  octahedron,  ///< one square, whose taps fold across its edges
};

/// A spot of a larger half-angle is drawn as an octahedron: its one plane would be all edge.
inline constexpr float WIDEST_SPOT_SQUARE = 1.308996939F;  // radians, 75 degrees

/// Of a shader that includes shadow/shadow.glsl and says nothing else (SHADOW_FIRST_BINDING, SHADOW_FIRST_CONSTANT):
/// the storage buffer of maps is at this binding of set 0, the atlas at the next, moments at the one behind it, sampled
/// images both. The specialization constant is a ShadowFilter, or shared::SHADOW_OFF.
inline constexpr std::uint32_t SHADOW_BINDING = 11;
inline constexpr std::uint32_t SHADOW_CONSTANT = 15;

inline constexpr std::uint64_t ALL_TEXELS = ~std::uint64_t{0};

struct ShadowAtlasInfo {
  std::uint32_t size = 4096;            ///< texels a side of the image: a power of two, 16 .. 32768
  std::uint32_t max_image_size = 4096;  ///< of the device (DeviceTraits); `size` may not be larger
  std::uint32_t light_capacity = 1024;  ///< ids are less, >= 1
  PointShadows points = PointShadows::faces;
  ShadowFilter filter = ShadowFilter::pcf;  ///< squares have its border
  float texels_per_pixel = 1.0F;            ///< > 0; of a light's map at its range, over those of the picture there
};

struct ShadowFrameInfo {
  /// What the picture shows: a light's size goes by the view that shows it largest. Without views nothing is seen.
  std::span<const View> views{};
  std::span<const shared::Light> lights{};
  /// Which light is which from frame to frame: each once, less than the capacity. Empty: light i has id i.
  std::span<const std::uint32_t> ids{};
  /// Geometry that moved since the last frame: a sphere around where it was and one around where it is. A sphere with a
  /// number that is not finite touches every light.
  std::span<const shared::LightSphere> moved{};
  /// Texels that may be drawn in this frame. No light gets squares that take more than this, so another budget means
  /// other sizes, and draws, also where nothing moves. A light whose least squares take more keeps what it has; 0: all
  /// do, and nothing is drawn.
  std::uint64_t budget_texels = ALL_TEXELS;
};

/// A light whose squares are drawn in this frame, all of them.
struct ShadowRedraw {
  std::uint32_t light = 0;  ///< index in the frame's lights
  std::uint32_t first_view = 0;
  std::uint32_t views = 0;
  std::uint64_t texels = 0;
  float priority = 0.0F;  ///< pixels that the light is wide, times frames waited; lights without a shadow come first
};

/// A part of the atlas that one map has to itself.
struct ShadowSquare {
  UVec2 corner{};          ///< its top left texel
  std::uint32_t side = 0;  ///< texels
};

/// Of lights in view that reach anything, where not said otherwise.
struct ShadowCounts {
  std::uint32_t seen = 0;      ///< lights
  std::uint32_t shadowed = 0;  ///< have squares that are, or are drawn in this frame
  std::uint32_t without = 0;   ///< have none: nothing fits, or they wait for it
  std::uint32_t no_room = 0;   ///< of those, that even a square of LEAST_SQUARE does not fit
  std::uint32_t waiting = 0;   ///< are to be drawn, and the budget does not allow it in this frame
  std::uint32_t smaller = 0;   ///< have smaller squares than their share of the picture asks for
  std::uint32_t redrawn = 0;
  std::uint32_t moved = 0;    ///< of the redrawn: to other squares than before
  std::uint32_t evicted = 0;  ///< not in view: lost their squares to others
  std::uint64_t redrawn_texels = 0;
  std::uint64_t used_texels = 0;  ///< of all squares that belong to a light, seen or not
};

/// Valid until the next call of `schedule`.
struct ShadowFrame {
  std::span<const shared::ShadowMap> maps;    ///< one for each light of the frame, as after this frame's draws
  std::span<const shared::ShadowView> views;  ///< to draw, in the order of `redraws`
  std::span<const ShadowRedraw> redraws;      ///< by priority, but for lights that give squares back, or then get them
  std::span<const ShadowSquare> squares;      ///< of the redraws, to be cleared to 0 before their views are drawn
  /// For shadow/radial_bounds and shadow/light_meshes, after the draws: indices whose bound is not that of their
  /// light's map. In the first frame that is every light, then those that were redrawn, that have another map than
  /// their index had in the frame before, or that have moved away from the place of theirs.
  std::span<const shared::RadialJob> radial_jobs;
  std::span<const std::uint32_t> waiting;  ///< indices of lights, as counted; ascending
  std::span<const std::uint32_t> without;
  ShadowCounts counts;
};

class LAMPLIGHT_API ShadowAtlas {
 public:
  /// Errors: a size that is no power of two or beyond the device's, a capacity of 0, texels that are not > 0, points or
  /// a filter that are none of those named.
  [[nodiscard]] static Result<ShadowAtlas> create(const ShadowAtlasInfo& info);
  ShadowAtlas(ShadowAtlas&&) noexcept;
  ShadowAtlas& operator=(ShadowAtlas&&) noexcept;
  ~ShadowAtlas();

  /// Once a frame: what is to be drawn before this frame's look-ups. Lights that are not among those of the frame lose
  /// their squares. A light that moved, or that something moved near, is drawn anew; that is seen here, nobody says it.
  /// Errors, that change nothing: more lights than ids, or an id twice or beyond the capacity.
  [[nodiscard]] Result<ShadowFrame> schedule(const ShadowFrameInfo& frame);

  /// All that was drawn is lost, or a frame that was scheduled was not drawn: everything is drawn anew, and
  /// so is every radial bound.
  void redraw_all();

  [[nodiscard]] const ShadowAtlasInfo& info() const;

 private:
  struct State;
  explicit ShadowAtlas(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Texels on each side of a square of this side that lie around what the light is asked for, so that no tap of the
/// filter leaves the square. Squares of an octahedron have none: taps fold.
[[nodiscard]] LAMPLIGHT_API std::uint32_t shadow_border(ShadowFilter filter, std::uint32_t side);

/// The map of a light at given squares (texels, top left), as many as `shadow_squares` says; none: no map.
[[nodiscard]] LAMPLIGHT_API shared::ShadowMap shadow_map(const shared::Light& light, const ShadowAtlasInfo& info,
                                                         std::uint32_t side, std::span<const UVec2> squares);

/// How many squares a light has: 0 if it reaches nothing, or has no intensity.
[[nodiscard]] LAMPLIGHT_API std::uint32_t shadow_squares(const shared::Light& light, PointShadows points);

/// Whether a map, made some frames ago, shows all that its light reaches now, from where it is now. What it holds then
/// cuts the light (shared/radial.h).
[[nodiscard]] LAMPLIGHT_API bool shadow_shows_all(const shared::ShadowMap& map, const shared::Light& light);

/// Appends the views that a map is drawn by, for an atlas of this size. `light` is written into them.
LAMPLIGHT_API void add_shadow_views(const shared::ShadowMap& map, std::uint32_t atlas_size, std::uint32_t light,
                                    std::vector<shared::ShadowView>& views);

/// The part of the atlas that a view of a map shows, for draws with a viewport and a scissor of their own: the square
/// of a face or spot, and of an octant the quarter that it shares with one other, from which planes[2] parts it.
[[nodiscard]] LAMPLIGHT_API ShadowSquare shadow_viewport(const shared::ShadowMap& map, const shared::ShadowView& view);
/// The same view with clip space of that viewport, not of the whole atlas. Nothing then needs to be clipped but
/// octants.
[[nodiscard]] LAMPLIGHT_API shared::ShadowView shadow_view_in(const shared::ShadowView& view,
                                                              const ShadowSquare& viewport, std::uint32_t atlas_size);

/// Where in the atlas a map holds what lies at a point, in texels (centres at +0.5), and the depth of the point.
struct ShadowPlace {
  Vec2 texel{};
  std::uint32_t square = 0;
  float w = 0.0F;  ///< m; not > 0: a point that the map does not show
};
[[nodiscard]] LAMPLIGHT_API ShadowPlace shadow_place(const shared::ShadowMap& map, const Vec3& world);

/// How large a view shows a sphere: its diameter in pixels, at most the picture's longer side; 0 if it lies outside the
/// picture.
[[nodiscard]] LAMPLIGHT_API double shown_diameter_px(const View& view, const shared::LightSphere& sphere);

}  // namespace lamp
