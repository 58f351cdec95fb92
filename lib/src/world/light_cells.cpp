// Boxes against a light.
// Based on: Wronski, Cull That Cone! (2017), with the cube itself instead of the sphere around it.
// SPDX-License-Identifier: Apache-2.0
#include "light_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamp::world {
namespace {

glm::uvec3 child_of(std::uint32_t child) { return {child & 1U, child >> 1U & 1U, child >> 2U}; }

std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32U) & 0x1f00000000ffffULL;
  v = (v | v << 16U) & 0x1f0000ff0000ffULL;
  v = (v | v << 8U) & 0x100f00f00f00f00fULL;
  v = (v | v << 4U) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2U) & 0x1249249249249249ULL;
}

double sum_of(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

}  // namespace

std::uint64_t morton(const glm::uvec3& v) { return spread(v.x) | spread(v.y) << 1U | spread(v.z) << 2U; }

double TreeGrid::brick_m(std::uint32_t level) const {
  return std::ldexp(4.0 * cell_m, static_cast<int>(levels - level));
}

glm::dvec3 TreeGrid::corner(std::uint32_t level, const glm::uvec3& brick) const {
  return low * cell_m + glm::dvec3(brick) * brick_m(level);
}

double TreeGrid::slack_m() const {
  return 2.0 * double{shared::ROUND_POSITION} * (sum_of(low * cell_m) + 3.0 * side_m()) + eye_slack_m(eyes_m);
}

double eye_slack_m(double eyes_m) { return 6.0 * double{shared::ROUND_POSITION} * eyes_m; }

void LightCells::look(const shared::Light& light, const TreeGrid& grid, const StillOccluders* occluders) {
  grid_ = grid;
  light_ = light;
  center_ = glm::dvec3(glm::vec3(light.position));
  axis_ = glm::dvec3(glm::vec3(light.direction));
  if (light.type == shared::LIGHT_SPOT) axis_ = glm::normalize(axis_);
  slack_ = grid.slack_m() + 2.0 * double{shared::ROUND_POSITION} * sum_of(center_);
  const bool is_spot = light.type == shared::LIGHT_SPOT;
  range_ = double{light.range} * (1.0 + double{shared::ROUND_RADIUS}) + slack_;
  if (light.range >= shared::INFINITE_RADIUS) range_ = std::numeric_limits<double>::infinity();
  if (!(light.range > 0.0F) || (is_spot && !(light.outer_angle > 0.0F))) range_ = -1.0;
  has_map_ = occluders != nullptr && range_ > 0.0;
  if (has_map_) map_.look(*occluders, light.position, static_cast<float>(range_));
  has_map_ = has_map_ && map_.hides_anything();
}

/// Each test finds a plane, or the sphere, between the light's volume and the cube.
LightCells::Lit LightCells::reach(const Cube& cube) const {
  if (range_ < 0.0) return Lit::none;
  const glm::dvec3 low = cube.low - center_;
  const glm::dvec3 high = low + cube.side;
  const glm::dvec3 gap = glm::max(glm::max(low, -high), glm::dvec3(0.0));
  if (glm::dot(gap, gap) > range_ * range_) return Lit::none;
  const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
  const double reach = range_ - 4.0 * slack_;
  const bool is_inside = reach > 0.0 && glm::dot(far, far) < reach * reach;
  if (light_.type != shared::LIGHT_SPOT) return is_inside ? Lit::all : Lit::partly;
  const glm::dvec3 middle = 0.5 * (low + high);
  const double half = 0.5 * cube.side;
  const double room = slack_ + 4.0 * double{shared::ROUND_RADIUS} * sum_of(far);
  const double along = glm::dot(middle, axis_);
  if (along + half * sum_of(axis_) < -room) return Lit::none;  // behind the tip
  const glm::dvec3 aside = middle - along * axis_;
  const double off_axis = glm::length(aside);
  const double diagonal = std::sqrt(3.0) * half;
  const double sine = double{light_.sin_outer};
  const double cosine = double{light_.cos_outer};
  // The plane that touches the cone where it comes nearest to the cube's middle.
  if (off_axis > 0.0) {
    const glm::dvec3 normal = cosine * (aside / off_axis) - sine * axis_;
    if (glm::dot(normal, middle) - half * sum_of(normal) > room) return Lit::none;
  }
  const bool is_in_cone = cosine * off_axis - sine * along < -diagonal - room;
  return is_inside && is_in_cone ? Lit::all : Lit::partly;
}

LightCells::Lit LightCells::lit(const Cube& cube) const {
  const Lit reached = reach(cube);
  if (reached == Lit::none || !has_map_) return reached;
  const glm::dvec3 low = cube.low - slack_;
  const glm::dvec3 high = cube.low + cube.side + slack_;
  if (map_.hides(DVec3(low), DVec3(high))) return Lit::none;
  return reached == Lit::all && map_.surely_sees(DVec3(low), DVec3(high)) ? Lit::all : Lit::partly;
}

std::uint64_t LightCells::cells(std::uint32_t level, const glm::uvec3& brick) const {
  const glm::dvec3 low = grid_.corner(level, brick);
  const double side = grid_.brick_m(level);
  std::uint64_t cells = 0;
  for (std::uint32_t o = 0; o < 8; ++o) {
    const glm::uvec3 octant = child_of(o);
    const Cube cube{.low = low + glm::dvec3(octant) * (0.5 * side), .side = 0.5 * side};
    const Lit found = lit(cube);
    if (found == Lit::none) continue;
    for (std::uint32_t c = 0; c < 8; ++c) {
      const glm::uvec3 cell = child_of(c);
      const Cube part{.low = cube.low + glm::dvec3(cell) * (0.25 * side), .side = 0.25 * side};
      const glm::uvec3 at = 2U * octant + cell;
      if (found == Lit::all || lit(part) != Lit::none) cells |= 1ULL << cell_bit(at.x, at.y, at.z);
    }
  }
  return cells;
}

void LightCells::descend(std::uint32_t level, const glm::uvec3& brick, std::uint32_t finest, std::uint32_t id,
                         std::vector<LitBrick>& to) const {
  const Lit found = lit({.low = grid_.corner(level, brick), .side = grid_.brick_m(level)});
  if (found == Lit::none) return;
  if (found == Lit::all || level == finest) {
    const std::uint64_t lit_cells = found == Lit::all ? ALL_CELLS : cells(level, brick);
    const std::uint32_t shift = grid_.levels - level;
    const glm::uvec3 corner(brick.x << shift, brick.y << shift, brick.z << shift);
    if (lit_cells != 0) to.push_back({.place = morton(corner), .cells = lit_cells, .level = level, .light = id});
    return;
  }
  for (std::uint32_t child = 0; child < 8; ++child) descend(level + 1, 2U * brick + child_of(child), finest, id, to);
}

void LightCells::add_bricks(std::uint32_t finest, std::uint32_t id, std::vector<LitBrick>& to) const {
  descend(0, glm::uvec3(0), finest, id, to);
}

bool LightCells::leaves_root() const {
  if (range_ < 0.0) return false;
  const glm::dvec3 low = grid_.corner(0, glm::uvec3(0)) - (center_ - range_);
  const glm::dvec3 high = center_ + range_ - (grid_.corner(0, glm::uvec3(0)) + grid_.side_m());
  const double room = -grid_.slack_m();
  return std::max({low.x, low.y, low.z, high.x, high.y, high.z}) >= room;
}

bool LightCells::reaches_brick(std::uint32_t level, const glm::uvec3& brick) const {
  return reach({.low = grid_.corner(level, brick), .side = grid_.brick_m(level)}) != Lit::none;
}

}  // namespace lamp::world
