// Z-binning on the CPU: radix sort by depth, then a segment tree over the bins, so that long lights cost no more.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), Z-binning; Bentley's
// segment tree (1977). Promise: the same ranks as the GPU's passes, but for rounding. SPDX-License-Identifier:
// Apache-2.0
#include "zbin_host.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

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

/// A node holds the ranks of lights that cover all bins below it.
void mark(std::vector<BinRanks>& tree, std::uint32_t node, std::uint32_t rank) {
  tree[node].least = std::min(tree[node].least, rank);
  tree[node].greatest = std::max(tree[node].greatest, rank);
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
  const std::uint32_t leaves = std::bit_ceil(scale.bins);
  std::vector<BinRanks> tree(std::size_t{2} * leaves);
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
    const DepthSpan& span = spans[order[rank]];
    if (span.far < span.near) break;  // the rest reach nothing
    const double near = span.near - shared::SLICE_ROUNDING * std::abs(span.near);
    const double far = span.far + shared::SLICE_ROUNDING * std::abs(span.far);
    std::uint32_t left = bin_of(scale, near) + leaves;
    std::uint32_t right = bin_of(scale, far) + leaves + 1;
    for (; left < right; left /= 2, right /= 2) {
      if ((left & 1U) != 0) mark(tree, left++, rank);
      if ((right & 1U) != 0) mark(tree, --right, rank);
    }
  }
  for (std::uint32_t node = 2; node < tree.size(); ++node) {
    const BinRanks& above = tree[node / 2];
    tree[node] = {std::min(tree[node].least, above.least), std::max(tree[node].greatest, above.greatest)};
  }
  tree.erase(tree.begin(), tree.begin() + leaves);
  tree.resize(scale.bins);
  return tree;
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
