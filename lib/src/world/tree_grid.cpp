// Chooses cells by the lights alone.
// SPDX-License-Identifier: Apache-2.0
#include "tree_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lamplight/shared/world_tree.h"
#include "mean_bricks.h"

namespace lamp::world {
namespace {

constexpr double MOST_CELLS_ACROSS = 1U << 20;  // of the root, and from the origin to it: exact in 32-bit arithmetic
constexpr double FAR_REACHING = 4.0;            // times how far lights lie apart, and a usual range
constexpr double SHIFT = 0.381966;              // of a cell: walls at whole numbers are no faces of cells
constexpr double BUDGETS = 4.0;                 // times the budget is what is made and then pruned,
constexpr double FEWEST_BYTES = 256U << 20;     // or this, where it is more
constexpr double ENTRY_BYTES = 12.0;
constexpr double LEAST_DETAIL = 1.0 / 64.0;

bool reaches_something(const shared::Light& light) { return light.range > 0.0F; }
bool is_infinite(const shared::Light& light) { return light.range >= shared::INFINITE_RADIUS; }

struct SceneBounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p, double radius) {
    min = glm::min(min, p - radius);
    max = glm::max(max, p + radius);
  }
  [[nodiscard]] double longest() const {
    const glm::dvec3 size = max - min;
    return std::max({size.x, size.y, size.z, 0.0});
  }
};

/// m; lights that reach farther have no part in where the root lies.
double usual_reach(std::span<const shared::Light> lights) {
  SceneBounds positions;
  std::vector<float> ranges;
  for (const shared::Light& light : lights)
    if (reaches_something(light) && !is_infinite(light)) {
      positions.add(glm::dvec3(glm::vec3(light.position)), 0.0);
      ranges.push_back(light.range);
    }
  if (ranges.empty()) return 0.0;
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::ranges::nth_element(ranges, middle);
  return FAR_REACHING * std::max(positions.longest(), double{*middle});
}

double power_of_two_below(double value) { return std::ldexp(1.0, static_cast<int>(std::floor(std::log2(value)))); }

}  // namespace

TreeGrid grid_of(const WorldTreeInfo& info) {
  const double reach = usual_reach(info.lights);
  SceneBounds bounds;
  double least = std::numeric_limits<double>::infinity();
  const double room = eye_slack_m(info.eyes_m);
  for (const shared::Light& light : info.lights) {
    if (!reaches_something(light) || double{light.range} > reach) continue;
    bounds.add(glm::dvec3(glm::vec3(light.position)), light.range * (1.0 + 1e-3) + room);
    least = std::min(least, double{light.range} + room);
  }
  if (!(least < std::numeric_limits<double>::infinity())) return {};
  const double farthest = std::max({glm::length(bounds.min), glm::length(bounds.max), bounds.longest()});
  TreeGrid grid{.eyes_m = info.eyes_m};
  grid.cell_m =
      std::max(power_of_two_below(least / info.detail), 2.0 * power_of_two_below(farthest / MOST_CELLS_ACROSS));
  grid.cell_m = std::clamp(grid.cell_m, 0x1p-60, 0x1p60);
  // Exact as floats: eighths of a cell.
  grid.low = (glm::floor(bounds.min / grid.cell_m) * 8.0 - std::round(SHIFT * 8.0) - 8.0) / 8.0;
  const double across = bounds.longest() / grid.cell_m + 4.0;
  while (grid.levels < shared::TREE_MOST_LEVELS && std::ldexp(4.0, static_cast<int>(grid.levels)) < across)
    ++grid.levels;
  return grid;
}

BrickLevels::BrickLevels(const WorldTreeInfo& info, const TreeGrid& grid) : grid_(grid), detail_(info.detail) {
  const double most = std::max(BUDGETS * static_cast<double>(info.budget), FEWEST_BYTES);
  const auto bytes = [&] {
    double sum = 0.0;
    for (const shared::Light& light : info.lights)
      if (reaches_something(light)) sum += ENTRY_BYTES * mean_bricks(grid_.brick_m(of(light)) / reach_m(light));
    return sum;
  };
  while (detail_ > LEAST_DETAIL && bytes() > most) detail_ *= 0.7071;
}

double BrickLevels::reach_m(const shared::Light& light) const {
  return std::min(double{light.range} + grid_.slack_m(), grid_.side_m());
}

std::uint32_t BrickLevels::of(const shared::Light& light) const {
  const double halvings = std::ceil(std::log2(4.0 * grid_.cell_m * std::ldexp(1.0, static_cast<int>(grid_.levels)) *
                                              detail_ / (4.0 * reach_m(light))));
  return static_cast<std::uint32_t>(std::clamp(halvings, 0.0, static_cast<double>(grid_.levels)));
}

}  // namespace lamp::world
