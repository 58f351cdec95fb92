// Z-binning on the CPU: a radix sort by depth, and in that order the first light that reaches into a bin is its least;
// backwards, its greatest. Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances
// (2017), Z-binning. Promise: the same ranks as the GPU's passes, but for rounding; time O(lights + bins), however many
// bins a light reaches.
// SPDX-License-Identifier: Apache-2.0
#include "zbin_host.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/shared/entity.h"
#include "lamplight/shared/slices.h"

namespace lamp {
namespace {

constexpr std::uint32_t DIGIT_BITS = 11;  // their counts stay in the first cache
constexpr std::uint32_t DIGITS = 3;

/// Which depths a light reaches, metres ahead. far < near: none.
struct DepthSpan {
  float middle, near, far;
};
constexpr DepthSpan REACHES_NOTHING{.middle = 0.0F, .near = 1.0F, .far = -1.0F};

/// What depths of all lights need of the frame.
struct Eye {
  glm::vec3 position;  ///< world
  float distance;      ///< of it to the world's origin
  glm::vec3 ahead;     ///< world, of unit length but for what the view stretches
  float offset;        ///< depth of the world's origin
  float of_radius;     ///< how long a span is to either side, for each metre of a radius
};

Eye eye_of(const shared::Frame& frame) {
  const glm::mat4 m = frame.view_from_world;
  const glm::vec3 position = frame.eye_world;
  return {.position = position,
          .distance = glm::length(position),
          .ahead = {-m[0].z, -m[1].z, -m[2].z},
          .offset = -m[3].z,
          .of_radius = 1.0F + shared::ROUND_RADIUS + 2.0F * shared::ROUND_POSITION + frame.stretch};
}

/// How far a box's record reaches ahead of its centre by its shape (shared/entity.h), m, of a sphere that reaches
/// `reach`. As much too far as depth_span() in common/box_tests.glsl has it.
float shape_reach(const Eye& eye, const shared::Light& record, float reach) {
  constexpr float LARGEST_BOX = 1e9F;  // m; as there
  if (record.sin_outer == shared::SHAPE_UNKNOWN || !(record.range < LARGEST_BOX)) return reach;
  const glm::vec3 turn = record.direction;
  const glm::mat3 axes = glm::mat3_cast(glm::quat(record.outer_angle, turn.x, turn.y, turn.z));
  const glm::vec3 along =
      glm::abs(glm::vec3(record.inner_angle, record.cos_outer, record.spot_scale) * (eye.ahead * axes));
  const float of_shape = record.sin_outer == shared::SHAPE_ELLIPSOID ? glm::length(along) : along.x + along.y + along.z;
  return std::min(reach, of_shape + 4.0F * (reach - record.range));
}

/// Of the light's bounding sphere, as much too long as view_bounds() in common/light_bounds.glsl makes it. The view is
/// rigid enough for a distance to the eye to be measured in the world.
DepthSpan depth_span(const Eye& eye, const shared::Light& light, bool has_shape) {
  const shared::LightSphere sphere = bounding_sphere(light);
  const glm::vec3 center = sphere.center;
  const float radius = sphere.radius;
  if (radius < 0.0F) return REACHES_NOTHING;
  const float middle = (eye.ahead.x * center.x + eye.ahead.y * center.y) + (eye.ahead.z * center.z + eye.offset);
  float reach = radius * eye.of_radius +
                shared::ROUND_POSITION * (glm::length(center - eye.position) + glm::length(center) + eye.distance);
  if (has_shape) reach = shape_reach(eye, light, reach);
  return {.middle = middle, .near = middle - reach, .far = middle + reach};
}

/// Where depth is cut, as common/slices.glsl does it. In 32 bits, which is far better than SLICE_ROUNDING.
class Bins {
 public:
  explicit Bins(std::span<const std::uint32_t> constants)
      : last_(static_cast<float>(constants[0] - 1)), linear_(constants[1] == shared::SLICES_LINEAR) {
    const double inner = std::max(1U, constants[0] - std::min(constants[0], 2U));
    const double near_m = constants[2] * 1e-3;
    const double far_m = constants[3];
    const double begin = linear_ ? near_m : std::log2(near_m);
    const double end = linear_ ? far_m : std::log2(far_m);
    bins_a_unit_ = static_cast<float>(inner / (end - begin));
    begin_ = static_cast<float>(begin);
    least_m_ = static_cast<float>(0.5 * near_m);
  }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(last_) + 1; }
  /// Bin 0 for whatever is nearer than the near end.
  [[nodiscard]] std::uint16_t at(float z_view) const {
    const float along = linear_ ? z_view : std::log2(std::max(z_view, least_m_));
    return static_cast<std::uint16_t>(std::min(std::max(0.0F, 1.0F + (along - begin_) * bins_a_unit_), last_));
  }

 private:
  float last_;
  bool linear_;
  float begin_;  ///< of bin 1: metres, or their logarithm
  float bins_a_unit_;
  float least_m_;  ///< in bin 0, and has a logarithm
};

/// Bins that a light reaches into. first > last: none.
struct BinRange {
  std::uint16_t first = 1, last = 0;
  [[nodiscard]] bool empty() const { return first > last; }
};

/// A little wider than the span, as slices_of() in common/slices.glsl.
BinRange bin_range(const Bins& bins, const DepthSpan& span) {
  if (span.far < span.near) return {};
  return {.first = bins.at(span.near - shared::SLICE_ROUNDING * std::abs(span.near)),
          .last = bins.at(span.far + shared::SLICE_ROUNDING * std::abs(span.far))};
}

struct Entry {
  std::uint32_t key, light;
};

/// Ascends with the middle; what reaches nothing comes last.
std::uint32_t sort_key(const DepthSpan& span) {
  if (span.far < span.near) return ~0U;
  const auto bits = std::bit_cast<std::uint32_t>(span.middle);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

std::uint32_t digit_of(std::uint32_t key, std::uint32_t digit) {
  return key >> (digit * DIGIT_BITS) & ((1U << DIGIT_BITS) - 1);
}

using DigitCounts = std::array<std::array<std::uint32_t, 1U << DIGIT_BITS>, DIGITS>;

/// Least and greatest rank of the lights that reach into a bin; least > greatest: none.
struct BinRanks {
  std::uint32_t least = ~0U;
  std::uint32_t greatest = 0;
};

/// What a frame needs: 36 bytes a light, 16 a bin.
struct Scratch {
  std::vector<DepthSpan> spans;
  std::vector<BinRange> ranges;
  std::vector<Entry> entries, sorted;
  std::vector<std::uint32_t> order;  ///< lights by rank
  std::vector<BinRanks> ranks;
  std::vector<std::uint32_t> open;    ///< Cover's
  std::vector<std::uint32_t> packed;  ///< bins of one word
};

/// Two short loops and not one: then the processor has several lights under way at once.
void measure(Scratch& s, const HostContext& context, const Bins& bins, DigitCounts& counts) {
  const auto count = static_cast<std::uint32_t>(context.lights.size());
  s.spans.resize(count);
  s.ranges.resize(count);
  s.entries.resize(count);
  const Eye eye = eye_of(*context.frame);
  const std::uint32_t first_shape =
      context.constants[5] != 0 ? count - std::min(count, context.frame->box_count) : count;
  for (std::uint32_t i = 0; i < count; ++i) s.spans[i] = depth_span(eye, context.lights[i], i >= first_shape);
  for (std::uint32_t i = 0; i < count; ++i) {
    s.ranges[i] = bin_range(bins, s.spans[i]);
    s.entries[i] = {.key = sort_key(s.spans[i]), .light = i};
    for (std::uint32_t digit = 0; digit < DIGITS; ++digit) ++counts[digit][digit_of(s.entries[i].key, digit)];
  }
}

/// Least digit first; equal keys stay in the order of their lights.
void sort_by_depth(Scratch& s, DigitCounts& counts) {
  s.sorted.resize(s.entries.size());
  for (std::uint32_t digit = 0; digit < DIGITS; ++digit) {
    std::uint32_t before = 0;
    for (std::uint32_t& place : counts[digit]) before += std::exchange(place, before);
    for (const Entry& entry : s.entries) s.sorted[counts[digit][digit_of(entry.key, digit)]++] = entry;
    s.entries.swap(s.sorted);
  }
  s.order.resize(s.entries.size());
  std::ranges::transform(s.entries, s.order.begin(), &Entry::light);
}

/// Gives each bin to the first light that reaches into it. `open_` are the bins, ascending, that lights have passed but
/// none has reached into. Each lies before the beginning of a light, so before the middle of every later one, as
/// middles ascend: a later light takes those from its own beginning on, which are the last, and what no light has
/// passed yet.
class Cover {
 public:
  explicit Cover(std::vector<std::uint32_t>& open) : open_(open) {}
  template <typename Take>
  void add(std::uint32_t first, std::uint32_t last, Take take) {
    for (; passed_ < first; ++passed_) open_[count_++] = passed_;
    for (; count_ != 0 && open_[count_ - 1] >= first; --count_) take(open_[count_ - 1]);
    for (; passed_ <= last; ++passed_) take(passed_);
  }

 private:
  std::vector<std::uint32_t>& open_;
  std::uint32_t count_ = 0;   ///< of open bins
  std::uint32_t passed_ = 0;  ///< bins below are open or taken
};

/// Forwards for the least ranks, and backwards, with bins counted from the last, for the greatest.
void rank_bins(Scratch& s, const Bins& bins) {
  s.ranks.assign(bins.count(), {});
  s.open.resize(bins.count());
  Cover forwards(s.open);
  for (std::uint32_t rank = 0; rank < s.order.size(); ++rank) {
    const BinRange range = s.ranges[s.order[rank]];
    if (range.empty()) break;  // the rest reach nothing
    forwards.add(range.first, range.last, [&](std::uint32_t bin) { s.ranks[bin].least = rank; });
  }
  const std::uint32_t last = bins.count() - 1;
  Cover backwards(s.open);
  for (auto rank = static_cast<std::uint32_t>(s.order.size()); rank-- > 0;) {
    const BinRange range = s.ranges[s.order[rank]];
    if (range.empty()) continue;
    backwards.add(last - range.last, last - range.first,
                  [&](std::uint32_t bin) { s.ranks[last - bin].greatest = rank; });
  }
}

template <typename T>
void write(std::span<std::byte> to, const std::vector<T>& values) {
  assert(to.size() >= values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(to.data(), values.data(), values.size() * sizeof(T));
}

void write_bins(std::span<std::byte> to, Scratch& s, bool wide) {
  if (wide) return write(to, s.ranks);
  s.packed.resize(s.ranks.size());
  std::ranges::transform(s.ranks, s.packed.begin(), [](const BinRanks& ranks) {
    return ranks.least > ranks.greatest ? shared::EMPTY_BIN : ranks.least | ranks.greatest << 16U;
  });
  write(to, s.packed);
}

}  // namespace

void sort_into_bins(const HostContext& context) {
  assert(context.lights.size() == context.frame->light_count && "give the host the frame's lights");
  assert(context.constants[0] >= 1 && context.constants[0] <= static_cast<std::uint32_t>(shared::MOST_SLICES));
  // Memory alone is kept between frames, by each thread that records: fresh pages took a third of the time.
  thread_local Scratch scratch;
  const Bins bins(context.constants);
  DigitCounts counts{};
  measure(scratch, context, bins, counts);
  sort_by_depth(scratch, counts);
  rank_bins(scratch, bins);
  write(context.buffers[0], scratch.order);
  write_bins(context.buffers[1], scratch, context.constants[4] != 0);
}

}  // namespace lamp
