// Lists of lights for triangles: lights that stand still on surfaces that stand still, listed once and for all frames.
// Large triangles are cut into patches; lists of neighbours share their lights. Pure code: no device, no threads.
// The look-up is lib/shaders/world/triangle_lists.glsl.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), bonus slides: light
// lists by triangle, for static lights. Promise: a light that reaches a position within `slack_m` of its triangle is in
// that position's list, but for what `hides` says, and where shading is exactly 0. Lists ascend, and are the same in
// every run.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/occlusion.h"
#include "lamplight/shared/light.h"
#include "lamplight/shared/triangle_lists.h"
#include "lamplight/vectors.h"

namespace lamp {

/// Shading of either side, or with any normal: no light is behind such a triangle.
inline constexpr float ANY_NORMAL = 4.0F;

/// World space, m. Degenerate triangles are listed as the lines or points that they are.
struct StillTriangle {
  std::array<DVec3, 3> corners{};
  std::array<Vec3, 3> normals{};  ///< that shading interpolates between the corners; of any length
  /// Radians: how far the normal that shading takes may lean from the interpolated one (a normal map). Shading is 0 for
  /// lights behind that normal: those that are behind all of a triangle's normals are left out. Two-sided surfaces, and
  /// whatever is not known, say ANY_NORMAL.
  float normal_tilt = ANY_NORMAL;
};

/// Whether nothing of a light arrives in the convex hull of some points, because of what stands between. Must be
/// proved: what is undecided is not hidden. The points enclose all positions that the list is for, slack included.
using Hides = std::function<bool(std::uint32_t light, std::span<const DVec3> hull)>;

/// What these occluders prove; `occluders` must live on. Each light looks around at a cube of `texels` a side of a
/// face; that many maps are kept (24 bytes a texel at 6 faces: some 150 KB each at 32 texels), and lights look again
/// where theirs was not.
[[nodiscard]] LAMPLIGHT_API Hides hidden_by(const StillOccluders& occluders, std::span<const shared::Light> lights,
                                            std::uint32_t texels = 32, std::size_t kept_maps = 1024);

struct TriangleListsInfo {
  std::span<const StillTriangle> triangles{};
  std::span<const shared::Light> lights{};  ///< ids count from 0
  /// m, >= 0, finite: how far from its triangle a position may be that asks. A pixel's is off by what rasterisation
  /// rounds: see `raster_slack`.
  float slack_m = 0.0F;
  /// Side of a patch over the range of the lights there (the median of them), > 0. Smaller patches waste less.
  float patch = 0.25F;
  /// What the lists may take, > 0. Where they would take more, patches grow, and then neighbours share longer lists; a
  /// note says so.
  std::uint64_t budget_bytes = UINT64_MAX;
  Hides hides{};  ///< or empty: nothing hides anything
};

/// What was made.
struct TriangleListsStats {
  std::uint64_t patches = 0;  ///< lists asked for: triangles that are not cut, and patches of the others
  std::uint64_t tables = 0;   ///< of patches
  std::uint64_t groups = 0;   ///< of lists
  std::uint64_t lists = 0;    ///< that differ, none of them empty
  std::uint64_t listed = 0;   ///< lights of all patches' lists together
  std::uint64_t hidden = 0;   ///< lights left out of a triangle or a patch because `hides` said so
  std::uint64_t behind = 0;   ///< and because they are behind the surface
  float patch = 0.0F;         ///< as in the info; larger where the budget asked for it
  std::uint32_t merged = 1;   ///< neighbours that share a list
};

struct TriangleLists {
  std::vector<std::uint32_t> words;  ///< one storage buffer for the look-up (shared/triangle_lists.h); never empty
  std::uint32_t triangles = 0;
  std::uint32_t lights = 0;
  TriangleListsStats stats{};
  std::vector<std::string> notes;  ///< what was done otherwise than asked, one sentence each

  [[nodiscard]] std::uint64_t bytes() const { return words.size() * sizeof(std::uint32_t); }
};

/// Lists for all triangles. Errors name the triangle, the light or the number that is wrong: corners and normals must
/// be finite, corners at most 1e15 m from the origin, lights as `check_lights` wants them.
[[nodiscard]] LAMPLIGHT_API Result<TriangleLists> make_triangle_lists(const TriangleListsInfo& info);

/// The list of a position on a triangle, as the look-up in the shader walks it. `triangle` < lists.triangles.
[[nodiscard]] LAMPLIGHT_API std::vector<std::uint32_t> lights_at(const TriangleLists& lists, std::uint32_t triangle,
                                                                 const Vec3& position);

/// m: how far from its triangle a pixel's position may be, whose depth is at most `z_view` (m): vertices are moved to a
/// grid of 2^-subpixel_bits pixels (VkPhysicalDeviceLimits::subPixelPrecisionBits) before they are drawn.
/// `pixel_m`: side of a pixel 1 m before the eye.
[[nodiscard]] LAMPLIGHT_API float raster_slack(float z_view, float pixel_m, std::uint32_t subpixel_bits);

}  // namespace lamp
