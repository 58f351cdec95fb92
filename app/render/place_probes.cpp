// Generated probes: a cell of open air by one random sequence a probe, and rays along the axes to the walls around it.
// SPDX-License-Identifier: Apache-2.0
#include "render/place_probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "error.h"
#include "render/scene_occluders.h"
#include "scene/procedural_random.h"

namespace lamp::app {
namespace {

using procedural::Random;

constexpr float PROBES_AT_A_POINT = 4.0F;  // of open air

/// The smallest probe: 5 cm, less in a scene that is small.
float least_side_m(const OpenAir& air) { return std::min(0.05F, 0.25F * air.diagonal_m); }

/// The half extents of a cube of such a probe.
float reach_of(const OpenAir& air, std::uint32_t count) {
  const auto reach = static_cast<float>(0.5 * std::cbrt(PROBES_AT_A_POINT * air.volume() / count));
  return std::clamp(reach, least_side_m(air), 0.25F * air.diagonal_m);
}

/// Metres along an axis to the walls, or the scene's diagonal: the median of five rays, so that a column or a gap
/// decides nothing.
float wall_distance(const Occluders& walls, const glm::dvec3& from, int axis, double side, const OpenAir& air) {
  constexpr double ASIDE = 0.15;  // of the way
  constexpr std::array<std::array<double, 2>, 5> TURNS{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::array<float, TURNS.size()> distances{};
  for (std::size_t i = 0; i < TURNS.size(); ++i) {
    glm::dvec3 way(0.0);
    way[axis] = side;
    way[(axis + 1) % 3] = ASIDE * TURNS[i][0];
    way[(axis + 2) % 3] = ASIDE * TURNS[i][1];
    const auto hit = walls.first_hit({.from = from, .to = from + way * static_cast<double>(air.diagonal_m)});
    distances[i] = hit ? static_cast<float>(hit->at) * air.diagonal_m : air.diagonal_m;
  }
  std::ranges::sort(distances);
  return std::max(distances[TURNS.size() / 2], least_side_m(air));
}

struct Sides {
  glm::vec3 low{0.0F};  ///< m from the capture, > 0
  glm::vec3 high{0.0F};
  [[nodiscard]] glm::vec3 center(const glm::vec3& capture) const { return capture + 0.5F * (high - low); }
  [[nodiscard]] glm::vec3 half_extents() const { return 0.5F * (high + low); }
};

/// How a generated probe follows from the scene.
struct Surroundings {
  const OpenAir& air;
  const Occluders& walls;
  float reach_m = 1.0F;
};

Probe generated(const Surroundings& of, std::uint32_t number, std::uint64_t seed) {
  Random random(seed * 0x9E3779B97F4A7C15ULL + number + 1);
  const AirCell& cell = of.air.cells[random.below(static_cast<std::uint32_t>(of.air.cells.size()))];
  const glm::vec3 capture = cell.min + 0.5F * of.air.cell_m;
  const float reach = of.reach_m * random.between(0.5F, 1.5F);
  Sides walls;
  for (int axis = 0; axis < 3; ++axis) {
    walls.low[axis] = wall_distance(of.walls, capture, axis, -1.0, of.air);
    walls.high[axis] = wall_distance(of.walls, capture, axis, 1.0, of.air);
  }
  // Walls are lit with full weight: they lie deeper in the volume than it blends.
  const float blend = 0.25F * std::min({reach, walls.half_extents().x, walls.half_extents().y, walls.half_extents().z});
  const Sides influence{glm::min(walls.low + 1.05F * blend, reach), glm::min(walls.high + 1.05F * blend, reach)};
  return {.shape = number % 4 == 3 ? ProbeShape::ellipsoid : ProbeShape::box,
          .center = influence.center(capture),
          .half_extents = influence.half_extents(),
          .blend_m = blend,
          .parallax_center = walls.center(capture),
          .parallax_half_extents = walls.half_extents(),
          .capture = capture};
}

}  // namespace

std::vector<Probe> place_probes(const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  if (count != 0 && scene.captured)
    throw Error(fmt::format("scene '{}': a captured frame has no surfaces that probes could show, expected 0 probes",
                            scene.name));
  const std::size_t own = std::min<std::size_t>(count, scene.probes.size());
  std::vector<Probe> probes(scene.probes.begin(), scene.probes.begin() + static_cast<std::ptrdiff_t>(own));
  if (probes.size() == count) return probes;
  const Box box = bounds(scene);
  if (box.min == box.max)
    throw Error(fmt::format(
        "scene '{}': is a single point, which leaves no room for generated probes, expected at most {} probes",
        scene.name, scene.probes.size()));
  const OpenAir air = find_open_air(scene);
  const Occluders walls = scene_occluders(scene);
  const Surroundings of{.air = air, .walls = walls, .reach_m = reach_of(air, count)};
  for (std::uint32_t i = 0; probes.size() < count; ++i) probes.push_back(generated(of, i, seed));
  return probes;
}

}  // namespace lamp::app
