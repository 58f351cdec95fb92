// Splits boxes by the surface area heuristic, in bins along each axis.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "render/bvh.h"

namespace lamp::app {
namespace {

constexpr int BINS = 16;  // Wald: from 16 on, more gain nothing

/// What holds nothing yet.
Box empty_box() {
  constexpr float FAR = std::numeric_limits<float>::max();
  return {glm::vec3(FAR), glm::vec3(-FAR)};
}

glm::vec3 middle(const Box& box) { return box.min * 0.5F + box.max * 0.5F; }

/// Half the surface; 0 of an empty box.
double area(const Box& box) {
  const glm::dvec3 size = glm::max(glm::dvec3(box.max) - glm::dvec3(box.min), glm::dvec3(0.0));
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// Levels below which so many leaves fit.
std::uint32_t levels_of(std::size_t boxes, std::uint32_t leaf) {
  return static_cast<std::uint32_t>(std::bit_width((boxes + leaf - 1) / leaf - 1));
}

/// Those of the first side before the others, each in their order; returns how many. The same with every library.
template <class IsFirst>
std::size_t partition(std::span<std::uint32_t> part, IsFirst is_first) {
  std::vector<std::uint32_t> others;
  std::size_t count = 0;
  for (const std::uint32_t i : part)
    if (is_first(i))
      part[count++] = i;
    else
      others.push_back(i);
  std::ranges::copy(others, part.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

struct Split {
  int axis = -1;  ///< none
  int bin = 0;    ///< the first of the second side
  double cost = std::numeric_limits<double>::infinity();
};

class Builder {
 public:
  Builder(std::span<const Box> boxes, const BoxTreeInfo& info) : boxes_(boxes), info_(info) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
    info_.max_depth = std::max(info_.max_depth, boxes.empty() ? 0 : levels_of(boxes.size(), info_.leaf));
  }

  BoxTree build() {
    if (!boxes_.empty()) tree_.root = build(tree_.order, 0, 0);
    return std::move(tree_);
  }

 private:
  [[nodiscard]] Box around(std::span<const std::uint32_t> part) const {
    Box box = empty_box();
    for (const std::uint32_t i : part) box = joined(box, boxes_[i]);
    return box;
  }

  /// Which bin a box's middle is in.
  struct Bins {
    float low = 0.0F;
    float scale = 0.0F;
    [[nodiscard]] int of(float at) const { return std::clamp(static_cast<int>((at - low) * scale), 0, BINS - 1); }
  };

  [[nodiscard]] static Bins bins_of(const Box& middles, int axis) {
    const float size = middles.max[axis] - middles.min[axis];
    return {.low = middles.min[axis], .scale = static_cast<float>(BINS) / size};
  }

  void try_axis(std::span<const std::uint32_t> part, const Box& middles, int axis, Split& best) const {
    const Bins bins = bins_of(middles, axis);
    if (!std::isfinite(bins.scale)) return;  // all in one place
    std::array<Box, BINS> box{};
    box.fill(empty_box());
    std::array<double, BINS> count{};
    for (const std::uint32_t i : part) {
      const auto bin = static_cast<std::size_t>(bins.of(middle(boxes_[i])[axis]));
      box[bin] = joined(box[bin], boxes_[i]);
      count[bin] += 1.0;
    }
    std::array<double, BINS> before{};  // cost of all bins before
    Box sum = empty_box();
    double boxes = 0.0;
    for (std::size_t bin = 0; bin + 1 < BINS; ++bin) {
      sum = joined(sum, box[bin]);
      boxes += count[bin];
      before[bin + 1] = boxes == 0.0 ? std::numeric_limits<double>::infinity() : boxes * area(sum);
    }
    sum = empty_box();
    boxes = 0.0;
    for (std::size_t bin = BINS - 1; bin != 0; --bin) {
      sum = joined(sum, box[bin]);
      boxes += count[bin];
      const double cost = before[bin] + boxes * area(sum);
      if (boxes != 0.0 && cost < best.cost) best = {.axis = axis, .bin = static_cast<int>(bin), .cost = cost};
    }
  }

  /// How many of the part, whose order changes, go to the first side.
  std::size_t split(std::span<std::uint32_t> part, std::uint32_t depth) const {
    Box middles = empty_box();
    for (const std::uint32_t i : part) {
      const glm::vec3 at = middle(boxes_[i]);
      middles = joined(middles, {at, at});
    }
    Split best;
    if (levels_of(part.size(), info_.leaf) < info_.max_depth - depth)
      for (int axis = 0; axis < 3; ++axis) try_axis(part, middles, axis, best);
    if (best.axis < 0) return halve(part, middles);
    const Bins bins = bins_of(middles, best.axis);
    const std::size_t first =
        partition(part, [&](std::uint32_t i) { return bins.of(middle(boxes_[i])[best.axis]) < best.bin; });
    // A side deeper than there are levels for.
    const std::size_t larger = std::max(first, part.size() - first);
    return levels_of(larger, info_.leaf) < info_.max_depth - depth ? first : halve(part, middles);
  }

  std::size_t halve(std::span<std::uint32_t> part, const Box& middles) const {
    const glm::vec3 size = middles.max - middles.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::ranges::sort(part, {}, [&](std::uint32_t i) { return std::pair(middle(boxes_[i])[axis], i); });
    // Whole leaves to the first side, so that the second is no deeper.
    const std::size_t leaves = (part.size() + info_.leaf - 1) / info_.leaf;
    return (leaves + 1) / 2 * info_.leaf;
  }

  /// Returns the code of a tree over a part of the order that begins at `first`.
  std::uint32_t build(std::span<std::uint32_t> part, std::uint32_t first, std::uint32_t depth) {
    const auto count = static_cast<std::uint32_t>(part.size());
    if (count <= info_.leaf) return first * gpu::BVH_COUNTS + count;
    tree_.depth = std::max(tree_.depth, depth + 1);
    const auto node = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    const std::size_t left = split(part, depth);
    const Box box_first = around(part.first(left));
    const Box box_second = around(part.subspan(left));
    const std::uint32_t code_first = build(part.first(left), first, depth + 1);
    const std::uint32_t code_second = build(part.subspan(left), first + static_cast<std::uint32_t>(left), depth + 1);
    tree_.nodes[node] = {.min_first = Vec3(box_first.min),
                         .first = code_first,
                         .max_first = Vec3(box_first.max),
                         .second = code_second,
                         .min_second = Vec3(box_second.min),
                         .unused_a = 0,
                         .max_second = Vec3(box_second.max),
                         .unused_b = 0};
    return node * gpu::BVH_COUNTS;
  }

  std::span<const Box> boxes_;
  BoxTreeInfo info_;
  BoxTree tree_;
};

}  // namespace

BoxTree make_box_tree(std::span<const Box> boxes, const BoxTreeInfo& info) { return Builder(boxes, info).build(); }

}  // namespace lamp::app
