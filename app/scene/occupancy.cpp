// The occupancy grid: its size, and triangles drawn into it column by column.
// Based on: Schwarz and Seidel, Fast Parallel Surface and Solid Voxelization on GPUs, SIGGRAPH Asia 2010, section 4:
// a triangle touches a box if its plane does and if its projection does in each of the three axis planes.
// SPDX-License-Identifier: Apache-2.0
#include "scene/occupancy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>

#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr float CELLS = 1 << 20;               // wanted in the scene's bounds
constexpr float MAX_LONG_SIDE = 256.0F;        // cells
constexpr std::int32_t MIN_SIDE = 8;           // cells: a flat scene has air too
constexpr float NEAR_OF_HEIGHT = 0.25F;        // "near a surface", as a part of the scene's height
constexpr float NEAR_LEAST_OF_LENGTH = 0.02F;  // but not less than this part of its longest side
constexpr float NEAR_MOST_OF_LENGTH = 0.1F;    // and not more than this one
constexpr float NEAR_CELLS = 3.0F;             // nor less than this
constexpr float ROUNDING = 1e-4F;              // cells: more than 32-bit coordinates of 258 cells can be off

using Triangle = std::array<glm::vec3, 3>;  // in cells

// One of the three projections of a triangle: half-planes that a unit square with its low corner at p must touch.
struct Outline {
  std::array<glm::vec2, 3> normal{};
  std::array<float, 3> offset{};

  Outline(const Triangle& t, int u, int v, bool counter_clockwise) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec3 edge = t[(i + 1) % 3] - t[i];
      normal[i] = counter_clockwise ? glm::vec2(-edge[v], edge[u]) : glm::vec2(edge[v], -edge[u]);
      offset[i] = -glm::dot(normal[i], glm::vec2(t[i][u], t[i][v])) + std::max(normal[i].x, 0.0F) +
                  std::max(normal[i].y, 0.0F) + ROUNDING * (std::abs(normal[i].x) + std::abs(normal[i].y));
    }
  }

  [[nodiscard]] bool touches(const glm::vec2& p) const {
    return glm::dot(normal[0], p) + offset[0] >= 0.0F && glm::dot(normal[1], p) + offset[1] >= 0.0F &&
           glm::dot(normal[2], p) + offset[2] >= 0.0F;
  }
};

// Columns run along w, the axis that the triangle faces most; u, v, w keep the handedness of x, y, z.
struct Axes {
  int u, v, w;
};

Axes axes_of(const glm::vec3& normal) {
  const glm::vec3 size = glm::abs(normal);
  if (size.x >= size.y && size.x >= size.z) return {1, 2, 0};
  if (size.y >= size.z) return {2, 0, 1};
  return {0, 1, 2};
}

// Low and high end, along w, of the triangle's plane over the unit square at (u, v).
glm::vec2 plane_span(const Triangle& t, const glm::vec3& normal, const Axes& axes, const glm::vec2& low) {
  const glm::vec2 slope = -glm::vec2(normal[axes.u], normal[axes.v]) / normal[axes.w];
  const float at_low = t[0][axes.w] + glm::dot(slope, low - glm::vec2(t[0][axes.u], t[0][axes.v]));
  const float down = std::min(slope.x, 0.0F) + std::min(slope.y, 0.0F);
  const float up = std::max(slope.x, 0.0F) + std::max(slope.y, 0.0F);
  return {at_low + down - ROUNDING, at_low + up + ROUNDING};
}

void mark(Occupancy& grid, const glm::ivec3& cell, const glm::ivec3& facing) {
  const std::size_t i = grid.index(cell);
  std::atomic_ref(grid.solid[i]).store(1, std::memory_order_relaxed);
  for (int axis = 0; axis < 3; ++axis) {
    // Whole numbers, so that the sum does not depend on the order in which threads add to it.
    if (facing[axis] != 0) std::atomic_ref(grid.facing[i][axis]).fetch_add(facing[axis], std::memory_order_relaxed);
  }
}

enum class Sides : std::uint8_t { one, both };

glm::ivec3 facing_of(const glm::vec3& normal, Sides sides) {
  if (sides == Sides::both) return glm::ivec3(0);
  const glm::vec3 facing = FACING_UNIT / std::max(2.0F, glm::length(normal)) * normal;
  return {glm::round(facing)};
}

/// Of a triangle that is nearly a line, 32 bits keep little but what they round.
glm::vec3 normal_of(const Triangle& t) {
  const glm::vec3 a = t[1] - t[0];
  const glm::vec3 b = t[2] - t[0];
  const glm::vec3 normal = glm::cross(a, b);
  constexpr float NEARLY = 1e-3F;  // sine of the angle at a corner
  const bool is_nearly_a_line = glm::dot(normal, normal) <= NEARLY * NEARLY * glm::dot(a, a) * glm::dot(b, b);
  if (!is_nearly_a_line) return normal;
  const glm::dvec3 corner(t[0]);
  return glm::cross(glm::dvec3(t[1]) - corner, glm::dvec3(t[2]) - corner);
}

void draw(const Triangle& t, Sides sides, Occupancy& grid) {
  const glm::ivec3 first(1);
  const glm::ivec3 last = grid.size - 2;
  const glm::vec3 margin(ROUNDING);
  const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(glm::min(glm::min(t[0], t[1]), t[2]) - margin)), first, last);
  const glm::ivec3 high =
      glm::clamp(glm::ivec3(glm::floor(glm::max(glm::max(t[0], t[1]), t[2]) + margin)), first, last);
  const glm::vec3 normal = normal_of(t);
  const glm::ivec3 facing = facing_of(normal, sides);
  if (low == high) return mark(grid, low, facing);

  const Axes axes = axes_of(normal);
  const auto [u, v, w] = axes;
  const Outline uv(t, u, v, normal[w] >= 0.0F);
  const Outline vw(t, v, w, normal[u] >= 0.0F);
  const Outline wu(t, w, u, normal[v] >= 0.0F);
  glm::ivec3 cell;
  for (cell[v] = low[v]; cell[v] <= high[v]; ++cell[v]) {
    for (cell[u] = low[u]; cell[u] <= high[u]; ++cell[u]) {
      const glm::vec2 column(cell[u], cell[v]);
      if (!uv.touches(column)) continue;
      glm::vec2 span(low[w], high[w]);
      if (normal[w] != 0.0F) span = glm::clamp(glm::floor(plane_span(t, normal, axes, column)), span.x, span.y);
      for (cell[w] = static_cast<int>(span.x); cell[w] <= static_cast<int>(span.y); ++cell[w]) {
        if (vw.touches({cell[v], cell[w]}) && wu.touches({cell[w], cell[u]})) mark(grid, cell, facing);
      }
    }
  }
}

void draw(const Scene& scene, const Instance& instance, Occupancy& grid) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const auto position = [&](std::uint32_t corner) {
    const std::uint32_t vertex = scene.indices[mesh.first_index + corner] + mesh.vertex_offset;
    const glm::vec3 world(instance.world_from_object * glm::vec4(scene.vertices[vertex].position, 1.0F));
    return (world - grid.origin) / grid.cell_m;
  };
  // Fronts are counter-clockwise in the world, also of what a matrix mirrors, as they are drawn.
  const bool has_both = mesh.material < scene.materials.size() && scene.materials[mesh.material].double_sided;
  const Sides sides = has_both ? Sides::both : Sides::one;
  const tbb::blocked_range<std::uint32_t> triangles(0, mesh.index_count / 3, 1024);
  tbb::parallel_for(triangles, [&](const tbb::blocked_range<std::uint32_t>& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
      draw(Triangle{position(3 * i), position(3 * i + 1), position(3 * i + 2)}, sides, grid);
    }
  });
}

// Cells over the bounds; flat scenes grow sideways and, like all scenes, upwards, where lights can still be near them.
Occupancy empty_grid(const Box& box) {
  glm::vec3 extent = box.max - box.min;
  float length = std::max({extent.x, extent.y, extent.z});
  if (!(length > 0.0F)) length = 1.0F;
  extent = glm::max(extent, glm::vec3(length / MAX_LONG_SIDE));

  Occupancy grid;
  // Root by root: the product of three large extents need not fit 32 bits.
  grid.cell_m = std::cbrt(extent.x) * std::cbrt(extent.y) * std::cbrt(extent.z) / std::cbrt(CELLS);
  grid.cell_m = std::max(grid.cell_m, length / MAX_LONG_SIDE);
  grid.near_m = std::clamp(NEAR_OF_HEIGHT * extent.y, NEAR_LEAST_OF_LENGTH * length, NEAR_MOST_OF_LENGTH * length);
  grid.near_m = std::max(grid.near_m, NEAR_CELLS * grid.cell_m);

  // More cells than the bounds need, so that the scene's outermost surfaces lie inside of cells, not between them.
  glm::ivec3 cells = glm::ivec3(glm::floor(extent / grid.cell_m)) + 1;
  const glm::ivec3 sideways = glm::max(MIN_SIDE - cells, glm::ivec3(0)) * glm::ivec3(1, 0, 1);
  const glm::vec3 slack = 0.5F * (glm::vec3(cells) - (box.max - box.min) / grid.cell_m);
  grid.origin = box.min - grid.cell_m * (glm::vec3(sideways / 2) + 1.0F + slack);
  cells += sideways;
  cells.y += static_cast<std::int32_t>(std::ceil(grid.near_m / grid.cell_m));
  grid.size = glm::max(cells, glm::ivec3(MIN_SIDE)) + 2;
  const std::size_t count = static_cast<std::size_t>(grid.size.x) * grid.size.y * grid.size.z;
  grid.solid.assign(count, 0);
  grid.facing.assign(count, glm::ivec3(0));
  return grid;
}

}  // namespace

Occupancy find_occupancy(const Scene& scene) {
  Occupancy grid = empty_grid(bounds(scene));
  Progress progress;
  std::mutex shown;
  std::atomic<std::size_t> done = 0;
  tbb::parallel_for(std::size_t{0}, scene.instances.size(), [&](std::size_t i) {
    draw(scene, scene.instances[i], grid);
    const std::size_t so_far = ++done;
    if (so_far % 256 == 0 && shown.try_lock()) {
      const std::lock_guard lock(shown, std::adopt_lock);
      progress.show("looking for open air", static_cast<double>(so_far) / static_cast<double>(scene.instances.size()));
    }
  });
  progress.clear();
  return grid;
}

}  // namespace lamp::app
