// The oracle, sooner: blocks of pixels hand down the entities whose sphere touches the box of their positions.
// Based on: brute_force_truth (reference.cpp), whose answer it repeats exactly; three levels of blocks.
// Promise: a discarded entity is outside, boundary band included, for every pixel of the block.
// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <limits>
#include <vector>

#include "oracle/reference.h"

namespace lamp {
namespace {

// Pixels a side of the blocks, coarse to fine. Chosen by time at 640x360 and 1920x1080 with 8192 lights.
constexpr std::array<std::uint32_t, 3> BLOCK_SIDES{64, 16, 4};
constexpr std::uint32_t ROOT_SIDE = BLOCK_SIDES[0];

// Beyond this share of its range a light is outside and not in the boundary band.
constexpr double SURELY_OUTSIDE = 1.0 + 4.0 * BOUNDARY_BAND;

// Pixels [x0, x1) x [y0, y1) of the picture.
struct Block {
  std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return min.x > max.x; }
};

struct Sphere {
  glm::dvec3 center{0.0};
  double radius_squared = 0.0;
};

bool touches(const Sphere& sphere, const Bounds& box) {
  const glm::dvec3 gap = glm::max(glm::max(box.min - sphere.center, sphere.center - box.max), glm::dvec3(0.0));
  return glm::dot(gap, gap) <= sphere.radius_squared;
}

// A root block under work: its positions, and the lights found so far, in the order of the visits.
class BlockTruth {
 public:
  BlockTruth(const TruthQuery& query, const std::vector<Sphere>& spheres, const Block& root)
      : query_(query), spheres_(spheres), root_(root) {}

  void run(const std::vector<std::uint32_t>& lights) {
    spans_.resize(ROOT_SIDE * ROOT_SIDE);
    positions_.resize(ROOT_SIDE * ROOT_SIDE);
    for (std::uint32_t y = root_.y0; y < root_.y1; ++y) {
      for (std::uint32_t x = root_.x0; x < root_.x1; ++x) {
        if (!is_sky(x, y)) positions_[local(x, y)] = query_.view.world_position(x, y, depth_at(x, y));
      }
    }
    descend(root_, 0, lights);
    positions_ = {};
  }

  [[nodiscard]] std::span<const std::uint32_t> lights_of(std::uint32_t x, std::uint32_t y) const {
    const Span& span = spans_[local(x, y)];
    return std::span(lights_).subspan(span.first, span.count);
  }
  [[nodiscard]] std::uint64_t boundary_pairs() const { return boundary_pairs_; }

 private:
  struct Span {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  [[nodiscard]] std::size_t local(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y - root_.y0} * ROOT_SIDE + (x - root_.x0);
  }
  [[nodiscard]] double depth_at(std::uint32_t x, std::uint32_t y) const {
    return query_.depth[std::size_t{y} * query_.view.width() + x];
  }

  [[nodiscard]] bool is_sky(std::uint32_t x, std::uint32_t y) const {
    return depth_at(x, y) == query_.view.sky_depth();
  }

  [[nodiscard]] Bounds bounds_of(const Block& block) const {
    Bounds bounds;
    for (std::uint32_t y = block.y0; y < block.y1; ++y) {
      for (std::uint32_t x = block.x0; x < block.x1; ++x) {
        if (is_sky(x, y)) continue;
        bounds.min = glm::min(bounds.min, positions_[local(x, y)]);
        bounds.max = glm::max(bounds.max, positions_[local(x, y)]);
      }
    }
    return bounds;
  }

  void descend(const Block& block, std::size_t level, const std::vector<std::uint32_t>& candidates) {
    const Bounds bounds = bounds_of(block);
    if (bounds.empty()) return;
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t light : candidates) {
      if (touches(spheres_[light], bounds)) kept.push_back(light);
    }
    if (level + 1 == BLOCK_SIDES.size()) return answer(block, kept);
    const std::uint32_t side = BLOCK_SIDES[level + 1];
    for (std::uint32_t y = block.y0; y < block.y1; y += side) {
      for (std::uint32_t x = block.x0; x < block.x1; x += side) {
        descend({x, y, std::min(x + side, block.x1), std::min(y + side, block.y1)}, level + 1, kept);
      }
    }
  }

  void answer(const Block& block, const std::vector<std::uint32_t>& candidates) {
    for (std::uint32_t y = block.y0; y < block.y1; ++y) {
      for (std::uint32_t x = block.x0; x < block.x1; ++x) {
        if (is_sky(x, y)) continue;
        const std::size_t first = lights_.size();
        for (const std::uint32_t light : candidates) {
          const Reach answer = reach_of(light, positions_[local(x, y)]);
          if (answer == Reach::inside) lights_.push_back(query_.first_id + light);
          if (answer == Reach::boundary) ++boundary_pairs_;
        }
        spans_[local(x, y)] = {first, lights_.size() - first};
      }
    }
  }

  /// Boxes are numbered behind the lights.
  [[nodiscard]] Reach reach_of(std::uint32_t entity, const glm::dvec3& position) const {
    const std::size_t lights = query_.lights.size();
    return entity < lights ? reach(query_.lights[entity], position)
                           : reach(query_.boxes[entity - lights], shape_of(query_, entity - lights), position);
  }

  const TruthQuery& query_;
  const std::vector<Sphere>& spheres_;
  Block root_;
  std::vector<glm::dvec3> positions_;
  std::vector<Span> spans_;
  std::vector<std::uint32_t> lights_;
  std::uint64_t boundary_pairs_ = 0;
};

// Calls `visit(x, y)` for every pixel of the rows asked for, in the order of Truth.
template <class Visit>
void for_each_pixel(const TruthQuery& query, Visit visit) {
  for (std::uint32_t y = query.first_row; y < query.first_row + query.rows; ++y) {
    for (std::uint32_t x = 0; x < query.view.width(); ++x) visit(x, y);
  }
}

// Puts the blocks' answers into the order of Truth.
Truth gather(const TruthQuery& query, const std::vector<BlockTruth>& blocks, std::uint32_t columns) {
  Truth truth{.first_row = query.first_row, .rows = query.rows, .offsets = {0}};
  const auto lights_of = [&](std::uint32_t x, std::uint32_t y) {
    const std::size_t row = (y - query.first_row) / ROOT_SIDE;
    return blocks[row * columns + x / ROOT_SIDE].lights_of(x, y);
  };
  std::uint64_t total = 0;
  truth.offsets.reserve(std::size_t{query.rows} * query.view.width() + 1);
  for_each_pixel(query, [&](std::uint32_t x, std::uint32_t y) {
    total += lights_of(x, y).size();
    truth.offsets.push_back(static_cast<std::uint32_t>(total));
  });
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    assert(false && "too many pairs: ask for fewer rows");
    std::abort();
  }
  truth.lights.reserve(total);
  for_each_pixel(query, [&](std::uint32_t x, std::uint32_t y) {
    const auto lights = lights_of(x, y);
    truth.lights.insert(truth.lights.end(), lights.begin(), lights.end());
  });
  for (const BlockTruth& block : blocks) truth.boundary_pairs += block.boundary_pairs();
  return truth;
}

}  // namespace

Truth truth(const TruthQuery& query) {
  const View& view = query.view;
  assert(query.depth.size() == std::size_t{view.width()} * view.height() && "depth must cover the whole picture");
  assert(query.first_row <= view.height() && query.rows <= view.height() - query.first_row &&
         "rows beyond the picture");

  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t i = 0; i < query.lights.size(); ++i) {
    const double radius = query.lights[i].range >= shared::INFINITE_RADIUS ? std::numeric_limits<double>::infinity()
                                                                           : query.lights[i].range * SURELY_OUTSIDE;
    spheres.push_back({glm::dvec3(query.lights[i].position), radius * radius});
    if (radius > 0.0) candidates.push_back(i);
  }
  for (const shared::OrientedBox& box : query.boxes) {
    // The axes are unit within 32-bit rounding, far less than the factor.
    const double radius = glm::length(glm::dvec3(box.half_extents)) * SURELY_OUTSIDE;
    candidates.push_back(static_cast<std::uint32_t>(spheres.size()));
    spheres.push_back({glm::dvec3(box.center), radius * radius});
  }

  std::vector<BlockTruth> blocks;
  const std::uint32_t columns = (view.width() + ROOT_SIDE - 1) / ROOT_SIDE;
  const std::uint32_t end_row = query.first_row + query.rows;
  for (std::uint32_t y = query.first_row; y < end_row; y += ROOT_SIDE) {
    for (std::uint32_t x = 0; x < view.width(); x += ROOT_SIDE) {
      blocks.emplace_back(query, spheres,
                          Block{x, y, std::min(x + ROOT_SIDE, view.width()), std::min(y + ROOT_SIDE, end_row)});
    }
  }
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) { blocks[i].run(candidates); });
  return gather(query, blocks, columns);
}

}  // namespace lamp
