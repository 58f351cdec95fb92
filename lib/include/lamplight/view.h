// The camera: projection, pose and size, and the way from a depth sample back to a position.
// Conventions: world right-handed, +Y up; view space looks down -Z, `z_view` is the positive distance ahead;
// Vulkan clip space. Depth is reversed (near 1, far 0; 0 is sky) or standard (near 0, far 1; 1 is sky), infinite far
// allowed. Pixel (0,0) is top left.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/shared/frame.h"
#include "lamplight/vectors.h"

namespace lamp {

/// A camera and a picture size. All numbers are 32-bit values (what the GPU sees) held in double precision,
/// so that the oracle and the GPU speak of the same camera.
class LAMPLIGHT_API View {
 public:
  /// `clip_from_view` may be any perspective or orthographic projection, off-centre too, whose x and y do not mix:
  /// only the entries [0][0], [1][1], the z column, the w column's x, y, z and [3][3] may differ from 0.
  /// Errors: a size of 0, a number that is not finite in 32 bits, shear, a singular matrix, a projection that looks
  /// along +Z, a `view_from_world` that is not rigid within 1e-4 (mirrors are allowed).
  [[nodiscard]] static Result<View> create(std::uint32_t width, std::uint32_t height, const DMat4& clip_from_view,
                                           const DMat4& view_from_world);

  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }
  [[nodiscard]] const DMat4& clip_from_view() const { return clip_from_view_; }
  [[nodiscard]] const DMat4& view_from_world() const { return view_from_world_; }
  [[nodiscard]] const DMat4& world_from_view() const { return world_from_view_; }
  /// Whether device depth falls with distance: near 1, sky 0. Else it grows, and the sky has 1.
  [[nodiscard]] bool reversed_depth() const { return reversed_depth_; }
  /// Device depth where nothing is.
  [[nodiscard]] float sky_depth() const { return reversed_depth_ ? 0.0F : 1.0F; }
  [[nodiscard]] bool orthographic() const { return clip_from_view_[2][3] == 0.0; }
  /// The largest share by which `view_from_world` may change a length: 0 if it is rigid, else some 1e-7 from the
  /// rounding of its numbers, up to 1.6e-4. Every bound of a light in view space is wider by it.
  [[nodiscard]] double stretch() const { return stretch_; }

  /// Metres ahead of the eye of a device depth in 0..1 that is not the sky's.
  [[nodiscard]] double z_view(double device_depth) const;

  /// View-space position of the point at `pixel` (continuous; centres at +0.5) that lies `z_view` metres ahead.
  [[nodiscard]] DVec3 view_position(DVec2 pixel, double z_view) const;

  /// World-space position of the depth sample of a pixel.
  [[nodiscard]] DVec3 world_position(std::uint32_t x, std::uint32_t y, double device_depth) const;

  /// The GPU's record of this view, for a plan with room for `light_capacity` lights.
  [[nodiscard]] shared::Frame frame(std::uint32_t light_count, std::uint32_t light_capacity) const;

  friend bool operator==(const View&, const View&) = default;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  DMat4 clip_from_view_ = DMat4::identity();
  DMat4 view_from_world_ = DMat4::identity();
  DMat4 world_from_view_ = DMat4::identity();
  double stretch_ = 0.0;
  bool reversed_depth_ = true;
};

/// Edges of a projection's window at 1 m ahead (perspective) or in metres (orthographic): left < right, bottom < top.
struct Window {
  double left, right, bottom, top;
};

/// From here on a far plane is infinite. No infinity: with -ffast-math, clang leaves out what would pass one.
inline constexpr double INFINITE_FAR = 1e300;

/// Reversed-depth perspective through `window` (tangents), `near_m` > 0, `far_m` > `near_m` or INFINITE_FAR. Of other
/// numbers, or a window without area, such as a minimised one's, it is a matrix that View::create refuses.
[[nodiscard]] LAMPLIGHT_API DMat4 perspective(const Window& window, double near_m, double far_m);

/// Reversed-depth orthographic projection, `near_m` < `far_m`, both finite. Of other numbers likewise.
[[nodiscard]] LAMPLIGHT_API DMat4 orthographic(const Window& window, double near_m, double far_m);

/// The same projection with depth that runs the other way: a reversed one made standard, or back. Exact but for the
/// rounding of one sum.
[[nodiscard]] LAMPLIGHT_API DMat4 flip_depth(const DMat4& clip_from_view);

/// The symmetric window of a vertical field of view (radians) and an aspect ratio (width over height).
[[nodiscard]] LAMPLIGHT_API Window symmetric_window(double fov_y, double aspect);

}  // namespace lamp
