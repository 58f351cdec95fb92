// Lists of still lights held against the oracle: at pixels, and at random points of surfaces.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lamplight/triangle_lists.h"
#include "oracle/occluders.h"
#include "render/judgement.h"
#include "render/renderer.h"

namespace lamp::app {

/// Of a pixel that shows none, and of all where a renderer has no lists of triangles.
inline constexpr std::uint32_t NO_TRIANGLE = ~0U;

/// The point that each pixel of the picture shows, row by row, and its triangle: those that deferred shading asks lists
/// with.
[[nodiscard]] std::vector<gpu::StillPoint> pixel_points(Renderer& renderer);
/// Without those of the sky.
[[nodiscard]] std::vector<gpu::StillPoint> points_of_pixels(Renderer& renderer);
[[nodiscard]] std::vector<gpu::StillPoint> random_points_on(std::span<const StillTriangle> triangles, std::size_t count,
                                                            std::uint64_t seed);

/// What walks of lists were found to hold.
struct StillFindings {
  std::size_t points = 0;
  std::uint64_t missed = 0;          ///< pairs of point and light that must be listed and are not
  std::uint64_t walked = 0;          ///< lights of the points' lists
  std::uint64_t reaching = 0;        ///< lights that reach the points
  std::uint64_t lighting = 0;        ///< and are not behind the surface, nor hidden where lists leave out what is
  std::uint64_t boundary_pairs = 0;  ///< not checked
  std::uint64_t unordered = 0;       ///< points whose list does not ascend
  std::uint64_t differing = 0;       ///< points where the GPU walked another list than the host
  std::uint64_t longest = 0;
  std::string first_miss;  ///< in words

  [[nodiscard]] Verdict verdict() const;
};

/// Walks lists on the device. `spirv`: of still_walk.comp, or a shader with its bindings.
[[nodiscard]] std::vector<gpu::StillWalk> walk_still_points(Context& context, std::span<const std::uint32_t> spirv,
                                                            const StillLists& lists,
                                                            std::span<const gpu::StillPoint> points);

struct StillCheck {
  Context& context;
  const ShaderLibrary& shaders;
  std::span<const StillTriangle> triangles;  ///< lists leave out lights behind them; none: lists know no surface
  std::span<const shared::Light> lights;
  std::function<std::vector<std::uint32_t>(const gpu::StillPoint&)> list;  ///< on the host
  const StillLists& on_gpu;
  const Occluders* occluders = nullptr;  ///< null: lists leave out nothing that is hidden
};
[[nodiscard]] StillFindings check_still_points(const StillCheck& check, std::span<const gpu::StillPoint> points);

}  // namespace lamp::app
