// The air of a captured frame: what lies between its eye and its surfaces, close before these.
// Promise: deterministic; no cell holds a sampled surface unless all do; the result is never empty.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/open_air.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t SAMPLES_A_SIDE = 256;  // pixels looked at, along the longer side
constexpr double NEARER_PART = 0.95;           // the furthest pixels, a skyline, would make all cells large
constexpr double REACH = 0.1;                  // of the diagonal of what is seen: how far before surfaces is near them
constexpr int REACH_CELLS = 8;
constexpr double NEAREST = 0.05;  // of a surface's distance: no nearer to the eye than this

using Cell = std::array<double, 3>;  // whole numbers, from the eye: far surfaces do not overflow them

struct Sample {
  glm::dvec2 pixel;
  double z_view;
};

std::vector<Sample> nearer_samples(const CapturedFrame& frame) {
  const View& view = frame.view;
  const std::uint32_t stride = (std::max(view.width(), view.height()) + SAMPLES_A_SIDE - 1) / SAMPLES_A_SIDE;
  std::vector<Sample> samples;
  for (std::uint32_t y = 0; y < view.height(); y += stride) {
    for (std::uint32_t x = 0; x < view.width(); x += stride) {
      const float depth = frame.depth[std::size_t{y} * view.width() + x];
      if (depth > 0.0F) samples.push_back({{x + 0.5, y + 0.5}, view.z_view(depth)});
    }
  }
  const auto kept = static_cast<std::size_t>(std::ceil(NEARER_PART * static_cast<double>(samples.size())));
  std::ranges::nth_element(samples, samples.begin() + static_cast<std::ptrdiff_t>(kept), {}, &Sample::z_view);
  samples.resize(kept);
  return samples;
}

glm::dvec3 world_position(const View& view, const Sample& sample) {
  return {glm::dmat4(view.world_from_view()) *
          glm::dvec4(glm::dvec3(view.view_position(sample.pixel, sample.z_view)), 1.0)};
}

double diagonal_of(const View& view, const std::vector<Sample>& samples) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-std::numeric_limits<double>::infinity());
  for (const Sample& sample : samples) {
    low = glm::min(low, world_position(view, sample));
    high = glm::max(high, world_position(view, sample));
  }
  const double diagonal = samples.empty() ? 0.0 : glm::length(high - low);
  return diagonal > 0.0 && std::isfinite(diagonal) ? diagonal : 1.0;
}

struct Cells {
  const View& view;
  double cell_m;

  [[nodiscard]] Cell at(const Sample& sample) const {
    const glm::dvec3 place =
        glm::floor((world_position(view, sample) - glm::dvec3(glm::dmat4(view.world_from_view())[3])) / cell_m);
    return {place.x, place.y, place.z};
  }

  /// Before surfaces, sorted.
  [[nodiscard]] std::vector<Cell> air_of(const std::vector<Sample>& samples) const {
    std::vector<Cell> air;
    for (const Sample& sample : samples) {
      for (int step = 1; step <= REACH_CELLS; ++step) {
        const double z_view = sample.z_view - step * cell_m;
        if (!view.orthographic() && z_view <= NEAREST * sample.z_view) break;
        air.push_back(at({sample.pixel, z_view}));
      }
    }
    return sorted(std::move(air));
  }

  [[nodiscard]] std::vector<Cell> solid_of(const std::vector<Sample>& samples) const {
    std::vector<Cell> solid;
    solid.reserve(samples.size());
    for (const Sample& sample : samples) solid.push_back(at(sample));
    return sorted(std::move(solid));
  }

  static std::vector<Cell> sorted(std::vector<Cell> cells) {
    std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
    return cells;
  }
};

}  // namespace

OpenAir find_open_air(const CapturedFrame& frame) {
  const std::vector<Sample> samples = nearer_samples(frame);
  const double diagonal_m = diagonal_of(frame.view, samples);
  const Cells cells{frame.view, REACH * diagonal_m / REACH_CELLS};
  const std::vector<Cell> air = cells.air_of(samples);
  std::vector<Cell> chosen;
  std::ranges::set_difference(air, cells.solid_of(samples), std::back_inserter(chosen));
  if (chosen.empty()) chosen = air;
  if (chosen.empty()) chosen.push_back({});  // around the eye: nothing is known of elsewhere

  OpenAir result{.cell_m = static_cast<float>(cells.cell_m), .diagonal_m = static_cast<float>(diagonal_m)};
  const glm::dvec3 eye(glm::dmat4(frame.view.world_from_view())[3]);
  for (const Cell& cell : chosen)
    result.cells.push_back({.min = glm::vec3(eye + cells.cell_m * glm::dvec3(cell[0], cell[1], cell[2]))});
  return result;
}

}  // namespace lamp::app
