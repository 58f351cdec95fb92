// Open air: what the cameras can reach, in front of surfaces, near them.
// Based on: flood filling a conservative occupancy grid.
// SPDX-License-Identifier: Apache-2.0
#include "scene/open_air.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "scene/occupancy.h"
#include "scene/surface_distance.h"

namespace lamp::app {
namespace {

// A flood that covers less than this part of the air that it could mean says that the cameras stand in some closet, or
// behind a closed door.
constexpr double LEAST_FLOOD = 0.1;

using Marks = std::vector<std::uint8_t>;  // one per cell of the grid: 1 is air

struct Ray {
  glm::vec3 origin{0.0F};   // cells
  glm::vec3 forward{0.0F};  // unit, or 0
};

Ray ray_of(const Occupancy& grid, const Camera& camera) {
  const glm::mat4& pose = camera.world_from_camera;
  return {(glm::vec3(pose[3]) - grid.origin) / grid.cell_m, -glm::vec3(pose[2])};
}

Ray ray_of(const Occupancy& grid, const FlightKey& key) {
  const glm::vec3 ahead = key.target - key.eye;
  const float length = glm::length(ahead);
  return {(key.eye - grid.origin) / grid.cell_m, length > 0.0F ? ahead / length : glm::vec3(0.0F)};
}

// Whether surfaces face the air that cameras are in. They do not in files whose triangles are wound the other way.
bool faces_are_right(const Scene& scene, const Occupancy& grid, const SurfaceDistance& distance) {
  int in_front = 0;
  int behind = 0;
  for (const Camera& camera : scene.cameras) {
    const glm::ivec3 cell(glm::floor(ray_of(grid, camera).origin));
    if (!grid.inner(cell) || grid.solid[grid.index(cell)] != 0) continue;
    (distance.behind[grid.index(cell)] != 0 ? behind : in_front) += 1;
  }
  return behind <= in_front;
}

// All air of a scene. There is some, because the grid reaches above the bounds.
Marks all_air(const Scene& scene, const Occupancy& grid, const SurfaceDistance& distance) {
  Marks open(grid.solid.size(), 0);
  Marks in_front(grid.solid.size(), 0);
  for (std::size_t i = 0; i < open.size(); ++i) {
    open[i] = grid.solid[i] == 0 && grid.inner(grid.cell(i)) ? 1 : 0;
    in_front[i] = open[i] != 0 && distance.behind[i] == 0 ? 1 : 0;
  }
  const bool use_sides = faces_are_right(scene, grid, distance) && std::ranges::count(in_front, 1) > 0;
  return use_sides ? in_front : open;
}

std::size_t nearest_air(const Occupancy& grid, const Marks& air, const glm::vec3& place) {
  std::size_t best = 0;
  float best_distance = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < air.size(); ++i) {
    if (air[i] == 0) continue;
    const glm::vec3 apart = glm::vec3(grid.cell(i)) + 0.5F - place;
    const float distance = glm::dot(apart, apart);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = i;
  }
  return best;
}

// Where a ray is within the grid, from its origin on; the end before the begin: nowhere.
std::pair<float, float> within(const Occupancy& grid, const Ray& ray) {
  constexpr float FARTHEST = 1e15F;  // steps are counted
  float begin = 0.0F;
  float end = ray.forward == glm::vec3(0.0F) ? 0.0F : FARTHEST;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = static_cast<float>(grid.size[axis]);
    if (ray.forward[axis] == 0.0F) {
      if (ray.origin[axis] < 0.0F || ray.origin[axis] > size) end = -1.0F;
      continue;
    }
    const float a = -ray.origin[axis] / ray.forward[axis];
    const float b = (size - ray.origin[axis]) / ray.forward[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return {begin, end};
}

// The cell where a camera's air begins: its own, or else the first air that it looks at, or else the nearest.
std::size_t first_air(const Occupancy& grid, const Marks& air, const Ray& ray) {
  const auto [begin, end] = within(grid, ray);
  if (begin > end) return nearest_air(grid, air, ray.origin);
  for (auto step = static_cast<std::int64_t>(2.0F * begin); static_cast<float>(step) <= 2.0F * end; ++step) {
    const glm::ivec3 cell(glm::floor(ray.origin + 0.5F * static_cast<float>(step) * ray.forward));
    if (grid.inner(cell) && air[grid.index(cell)] != 0) return grid.index(cell);
  }
  return nearest_air(grid, air, ray.origin);
}

Marks flood(const Occupancy& grid, const Marks& air, std::vector<std::size_t> open) {
  const auto row = static_cast<std::ptrdiff_t>(grid.size.x);
  const std::array<std::ptrdiff_t, 6> neighbours{1, -1, row, -row, row * grid.size.y, -row * grid.size.y};
  Marks reached(air.size(), 0);
  for (const std::size_t start : open) reached[start] = 1;
  while (!open.empty()) {
    const std::size_t cell = open.back();
    open.pop_back();
    for (const std::ptrdiff_t step : neighbours) {
      const std::size_t next = cell + static_cast<std::size_t>(step);
      if (air[next] == 0 || reached[next] != 0) continue;
      reached[next] = 1;
      open.push_back(next);
    }
  }
  return reached;
}

std::vector<std::size_t> flood_starts(const Scene& scene, const Occupancy& grid, const Marks& air) {
  std::vector<std::size_t> starts;
  starts.reserve(scene.cameras.size());
  for (const Camera& camera : scene.cameras) starts.push_back(first_air(grid, air, ray_of(grid, camera)));
  if (!scene.flight) return starts;
  for (const FlightKey& key : scene.flight->keys) starts.push_back(first_air(grid, air, ray_of(grid, key)));
  return starts;
}

// Air that goes on beyond the grid: under the sky, or outside of a closed building.
Marks outdoors_of(const Occupancy& grid, const Marks& air) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < air.size(); ++i) {
    const glm::ivec3 cell = grid.cell(i);
    const bool at_border = glm::any(glm::equal(cell, glm::ivec3(1))) || glm::any(glm::equal(cell, grid.size - 2));
    if (air[i] != 0 && at_border) starts.push_back(i);
  }
  return flood(grid, air, std::move(starts));
}

// The cells of `marks` that pass a test, or all of them if none does.
template <class Test>
std::vector<std::size_t> preferred(const Marks& marks, Test test) {
  std::vector<std::size_t> passed;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == 0) continue;
    all.push_back(i);
    if (test(i)) passed.push_back(i);
  }
  return passed.empty() ? all : passed;
}

// The cells of open air, never none.
std::vector<std::size_t> choose(const Scene& scene, const Occupancy& grid, const SurfaceDistance& distance) {
  const float near_cells = grid.near_m / grid.cell_m;
  const auto is_near = [&](std::size_t i) { return static_cast<float>(distance.steps[i]) <= near_cells; };

  const Marks air = all_air(scene, grid, distance);
  const Marks outdoors = outdoors_of(grid, air);
  const std::vector<std::size_t> starts = flood_starts(scene, grid, air);
  const bool indoors = !starts.empty() && std::ranges::none_of(starts, [&](std::size_t i) { return outdoors[i] != 0; });
  const auto is_candidate = [&](std::size_t i) { return is_near(i) && (!indoors || outdoors[i] == 0); };
  const std::vector<std::size_t> candidates = preferred(air, is_candidate);

  const Marks reached = flood(grid, air, starts);
  const std::vector<std::size_t> chosen = preferred(reached, is_near);
  const bool closet = static_cast<double>(chosen.size()) < LEAST_FLOOD * static_cast<double>(candidates.size());
  return closet ? candidates : chosen;
}

// Cubes that fill a box but for less than one of them along each axis.
OpenAir air_in(const Box& box) {
  constexpr float CELLS_A_SIDE = 32.0F;  // of the longest side
  const glm::vec3 side = box.max - box.min;
  const float cell_m = std::min({side.x, side.y, side.z, std::max({side.x, side.y, side.z}) / CELLS_A_SIDE});
  const glm::ivec3 count = glm::max(glm::ivec3(glm::floor(side / cell_m + 1e-3F)), glm::ivec3(1));
  const glm::vec3 origin = 0.5F * (box.min + box.max - cell_m * glm::vec3(count));
  OpenAir air{.cell_m = cell_m, .diagonal_m = glm::length(side)};
  for (int i = 0; i < count.x * count.y * count.z; ++i) {
    const glm::ivec3 cell(i % count.x, i / count.x % count.y, i / (count.x * count.y));
    const glm::ivec3 to_border = glm::min(cell + 1, count - cell);
    const int clearance = std::min({to_border.x, to_border.y, to_border.z});
    air.cells.push_back({origin + cell_m * glm::vec3(cell), static_cast<std::uint32_t>(clearance)});
  }
  return air;
}

OpenAir air_near_surfaces(const Scene& scene) {
  const Occupancy grid = find_occupancy(scene);
  const SurfaceDistance distance = find_surface_distance(grid);
  const Box box = bounds(scene);
  OpenAir result{.cell_m = grid.cell_m, .diagonal_m = glm::length(box.max - box.min)};
  for (const std::size_t i : choose(scene, grid, distance)) {
    result.cells.push_back({grid.origin + grid.cell_m * glm::vec3(grid.cell(i)), distance.steps[i]});
  }
  return result;
}

}  // namespace

OpenAir find_open_air(const Scene& scene) {
  if (scene.captured) return find_open_air(*scene.captured);
  OpenAir air = scene.placement.box ? air_in(*scene.placement.box) : air_near_surfaces(scene);
  air.placement = scene.placement;
  return air;
}

}  // namespace lamp::app
