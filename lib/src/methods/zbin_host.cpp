// Z-binning on the CPU: radix sort by depth, then a light marks two runs of bins, however many it reaches, and long
// runs are cut in halves. Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances
// (2017), Z-binning; Bender, Farach-Colton, The LCA Problem Revisited (2000), whose sparse table this turns around.
// Promise: the same ranks as the GPU's passes, but for rounding. SPDX-License-Identifier: Apache-2.0
#include "zbin_host.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "lamplight/shared/slices.h"

namespace lamp {
namespace {

constexpr float INFINITE_RADIUS = 1e18F;  // as in common/light_bounds.glsl, and so are the two below
constexpr float ROUND_RADIUS = 4e-6F;
constexpr float ROUND_POSITION = 1e-6F;
constexpr float COS_45 = 0.70710678F;
constexpr std::uint32_t DIGIT_BITS = 11;  // three digits; their counts stay in the first cache

/// Centre in world space and radius of the sphere around what the light reaches.
struct Sphere {
  glm::vec3 center;
  float radius;
};

Sphere world_sphere(const shared::Light& light) {
  Sphere sphere{light.position, std::min(light.range, INFINITE_RADIUS)};
  if (light.type != shared::LIGHT_SPOT || sphere.radius >= INFINITE_RADIUS) return sphere;
  if (light.cos_outer >= COS_45) {
    sphere.radius /= 2.0F * light.cos_outer;
    sphere.center += light.direction * sphere.radius;
  } else {
    sphere.center += light.direction * (sphere.radius * light.cos_outer);
    sphere.radius *= std::sqrt(1.0F - light.cos_outer * light.cos_outer);
  }
  return sphere;
}

std::uint32_t sort_key(const DepthSpan& span) {
  if (span.far < span.near) return ~0U;
  const auto bits = std::bit_cast<std::uint32_t>(span.middle);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

/// Ranks of lights by runs of 2^level bins; a level without lights has no rows yet.
using Runs = std::vector<std::vector<BinRanks>>;

/// Ranks come in ascending order, so the first is the least and the last the greatest.
void mark(BinRanks& run, std::uint32_t rank) {
  run.least = std::min(run.least, rank);
  run.greatest = rank;
}

/// Two runs that may overlap cover a light's bins, however many they are.
Runs mark_runs(const BinScale& scale, std::span<const DepthSpan> spans, std::span<const std::uint32_t> order) {
  Runs runs(std::bit_width(scale.bins));
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
    const DepthSpan& span = spans[order[rank]];
    if (span.far < span.near) break;  // the rest reach nothing
    const std::uint32_t first = bin_of(scale, span.near - shared::SLICE_ROUNDING * std::abs(span.near));
    const std::uint32_t last = bin_of(scale, span.far + shared::SLICE_ROUNDING * std::abs(span.far));
    const std::uint32_t level = std::bit_width(last - first + 1) - 1;
    std::vector<BinRanks>& row = runs[level];
    if (row.empty()) row.resize(scale.bins);
    mark(row[first], rank);
    mark(row[last + 1 - (1U << level)], rank);
  }
  return runs;
}

void merge(BinRanks& into, const BinRanks& ranks) {
  into.least = std::min(into.least, ranks.least);
  into.greatest = std::max(into.greatest, ranks.greatest);
}

}  // namespace

DepthSpan depth_span(const shared::Frame& frame, const shared::Light& light) {
  if (!(light.range > 0.0F) || (light.type == shared::LIGHT_SPOT && light.outer_angle <= 0.0F))
    return {.near = 1.0F, .far = -1.0F};
  const Sphere sphere = world_sphere(light);
  const glm::vec3 center = glm::vec3(frame.view_from_world * glm::vec4(sphere.center, 1.0F));
  const float reach =
      sphere.radius * (1.0F + ROUND_RADIUS) +
      ROUND_POSITION * (glm::length(center) + glm::length(light.position) + glm::length(frame.eye_world));
  return {.middle = -center.z, .near = -center.z - reach, .far = -center.z + reach};
}

std::vector<std::uint32_t> depth_order(std::span<const DepthSpan> spans) {
  struct Entry {
    std::uint32_t key, light;
  };
  std::vector<Entry> entries(spans.size());
  for (std::uint32_t i = 0; i < spans.size(); ++i) entries[i] = {sort_key(spans[i]), i};
  std::vector<Entry> other(spans.size());
  for (std::uint32_t shift = 0; shift < 32; shift += DIGIT_BITS) {
    std::array<std::uint32_t, 1U << DIGIT_BITS> places{};
    for (const Entry& entry : entries) ++places[entry.key >> shift & (places.size() - 1)];
    std::uint32_t before = 0;
    for (std::uint32_t& place : places) before += std::exchange(place, before);
    for (const Entry& entry : entries) other[places[entry.key >> shift & (places.size() - 1)]++] = entry;
    entries.swap(other);
  }
  std::vector<std::uint32_t> order(spans.size());
  std::ranges::transform(entries, order.begin(), &Entry::light);
  return order;
}

std::uint32_t bin_of(const BinScale& scale, double z_view) {
  const double near_m = scale.near_mm * 1e-3;
  const double far_m = scale.far_m;
  if (z_view < near_m) return 0;
  const double share = scale.scale == shared::SLICES_LINEAR ? (z_view - near_m) / (far_m - near_m)
                                                            : std::log2(z_view / near_m) / std::log2(far_m / near_m);
  const double inner = std::max(1U, scale.bins - std::min(scale.bins, 2U));
  const double most = shared::MOST_SLICES;
  return std::min(scale.bins - 1, 1U + static_cast<std::uint32_t>(std::clamp(share * inner, 0.0, most)));
}

std::vector<BinRanks> bin_ranks(const BinScale& scale, std::span<const DepthSpan> spans,
                                std::span<const std::uint32_t> order) {
  Runs runs = mark_runs(scale, spans, order);
  for (std::size_t level = runs.size(); --level > 0;) {
    if (runs[level].empty()) continue;  // and so are all longer ones
    std::vector<BinRanks>& shorter = runs[level - 1];
    shorter.resize(scale.bins);
    const std::size_t half = std::size_t{1} << (level - 1);
    for (std::size_t bin = 0; bin + 2 * half <= scale.bins; ++bin) {
      merge(shorter[bin], runs[level][bin]);
      merge(shorter[bin + half], runs[level][bin]);
    }
  }
  runs[0].resize(scale.bins);
  return std::move(runs[0]);
}

void sort_into_bins(const HostContext& context) {
  assert(context.lights.size() == context.frame->light_count && "give the host the frame's lights");
  std::vector<DepthSpan> spans;
  spans.reserve(context.lights.size());
  for (const shared::Light& light : context.lights) spans.push_back(depth_span(*context.frame, light));
  const std::vector<std::uint32_t> order = depth_order(spans);
  const BinScale scale{context.constants[0], context.constants[1], context.constants[2], context.constants[3]};
  const bool wide = context.constants[4] != 0;
  std::vector<std::uint32_t> words;
  words.reserve(scale.bins * (wide ? 2U : 1U));
  for (const auto& [least, greatest] : bin_ranks(scale, spans, order)) {
    if (wide)
      words.insert(words.end(), {least, greatest});
    else
      words.push_back(least > greatest ? shared::EMPTY_BIN : least | greatest << 16U);
  }
  if (!order.empty()) std::memcpy(context.buffers[0].data(), order.data(), order.size() * sizeof(order[0]));
  std::memcpy(context.buffers[1].data(), words.data(), words.size() * sizeof(words[0]));
}

}  // namespace lamp
