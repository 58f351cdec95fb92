// Points are halved along the longest side of their box, again and again; each half takes on the lights whose sphere
// touches its box.
// Promise: a discarded light is outside, boundary band included, for every point of the group.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/points.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace lamp {
namespace {

constexpr std::size_t GROUP = 16;                          // points that are not halved
constexpr double BEYOND_BAND = 1.0 + 4.0 * BOUNDARY_BAND;  // share of a range beyond which a light is outside

struct Answer {
  std::vector<std::uint32_t> lights;
  std::uint64_t boundary = 0;
};

struct PointBox {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};
};

class Halving {
 public:
  Halving(std::span<const glm::vec3> points, std::span<const shared::Light> lights)
      : points_(points), lights_(lights), answers_(points.size()) {}

  void run(std::span<std::uint32_t> group, const std::vector<std::uint32_t>& lights) {
    const PointBox box = box_of(group);
    std::vector<std::uint32_t> near;
    for (const std::uint32_t light : lights)
      if (touches(lights_[light], box)) near.push_back(light);
    if (group.size() <= GROUP) {
      for (const std::uint32_t point : group) answer(point, near);
      return;
    }
    const glm::dvec3 size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
    std::nth_element(group.begin(), middle, group.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    tbb::parallel_invoke([&] { run({group.begin(), middle}, near); }, [&] { run({middle, group.end()}, near); });
  }

  [[nodiscard]] std::span<const Answer> answers() const { return answers_; }

 private:
  [[nodiscard]] PointBox box_of(std::span<const std::uint32_t> group) const {
    PointBox box;
    for (const std::uint32_t point : group) {
      box.min = glm::min(box.min, glm::dvec3(points_[point]));
      box.max = glm::max(box.max, glm::dvec3(points_[point]));
    }
    return box;
  }

  [[nodiscard]] static bool touches(const shared::Light& light, const PointBox& box) {
    const glm::dvec3 center(light.position);
    const glm::dvec3 gap = glm::max(glm::max(box.min - center, center - box.max), glm::dvec3(0.0));
    const double radius = light.range * BEYOND_BAND;
    return light.range >= shared::INFINITE_RADIUS || glm::dot(gap, gap) <= radius * radius;
  }

  void answer(std::uint32_t point, const std::vector<std::uint32_t>& near) {
    for (const std::uint32_t light : near) {
      const Reach reached = reach(lights_[light], glm::dvec3(points_[point]));
      if (reached == Reach::inside) answers_[point].lights.push_back(light);
      if (reached == Reach::boundary) ++answers_[point].boundary;
    }
  }

  std::span<const glm::vec3> points_;
  std::span<const shared::Light> lights_;
  std::vector<Answer> answers_;
};

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

PointTruth truth_at(std::span<const glm::vec3> points, std::span<const shared::Light> lights) {
  PointTruth truth;
  if (points.empty()) return truth;
  Halving halving(points, lights);
  std::vector<std::uint32_t> group = numbers(points.size());
  halving.run(group, numbers(lights.size()));
  for (const Answer& answer : halving.answers()) {
    truth.lights.insert(truth.lights.end(), answer.lights.begin(), answer.lights.end());
    truth.offsets.push_back(truth.lights.size());
    truth.boundary_pairs += answer.boundary;
  }
  return truth;
}

PointTruth seen_at(const PointTruth& truth, std::span<const glm::vec3> points, std::span<const shared::Light> lights,
                   const Occluders& occluders) {
  std::vector<std::uint8_t> sees(truth.lights.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t point) {
    for (std::size_t i = truth.offsets[point]; i < truth.offsets[point + 1]; ++i) {
      const glm::dvec3 from(glm::vec3(lights[truth.lights[i]].position));
      sees[i] = occluders.any_hit({.from = from, .to = glm::dvec3(points[point]), .last = STOPS_BEFORE}) ? 0 : 1;
    }
  });
  PointTruth seen{.boundary_pairs = truth.boundary_pairs};
  for (std::size_t point = 0; point < points.size(); ++point) {
    for (std::size_t i = truth.offsets[point]; i < truth.offsets[point + 1]; ++i)
      if (sees[i] != 0) seen.lights.push_back(truth.lights[i]);
    seen.offsets.push_back(seen.lights.size());
  }
  return seen;
}

}  // namespace lamp
