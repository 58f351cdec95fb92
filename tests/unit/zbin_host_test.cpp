// The CPU's sort and bins of drobot-zbin, as its plan's host pass, against a search over all lights. Lights reach from
// the middle of one bin to the middle of another, so that no rounding can move them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <future>
#include <limits>
#include <numeric>
#include <random>

#include "lamplight/light.h"
#include "lamplight/method.h"
#include "lamplight/view.h"

namespace lamp {
namespace {

const DeviceTraits TRAITS{.max_storage_buffer_bytes = 0xFFFFFFFF,
                          .max_groups = {65535, 65535, 65535},
                          .max_group_invocations = 1024,
                          .shared_memory_bytes = 32768,
                          .max_image_size = 16384};

/// A light and the depths that its bounding sphere reaches.
struct Placed {
  shared::Light light;
  double near = 0.0, far = -1.0;  ///< far < near: none
  [[nodiscard]] double middle() const { return (near + far) / 2.0; }
};

View test_view() {
  const glm::dmat3 rotation(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
  glm::dmat4 view_from_world(rotation);
  view_from_world[3] = {3.0, -5.0, 7.0, 1.0};
  return View::create(8, 8, perspective(symmetric_window(1.0, 1.0), 0.1, INFINITE_FAR), view_from_world).value();
}

/// `depth` and `range` in metres. Spots look away from the eye; 0: a point, else the half-angle's cosine.
Placed place(const View& view, double depth, double range, double cosine) {
  Light light{.position = glm::vec3(glm::dmat4(view.world_from_view()) * glm::dvec4(1.5, -2.5, -depth, 1.0)),
              .range = static_cast<float>(range)};
  if (cosine != 0.0) {
    light.type = LightType::spot;
    light.outer_angle = static_cast<float>(std::acos(cosine));
    light.direction = glm::vec3(glm::dmat4(view.world_from_view()) * glm::dvec4(0.0, 0.0, -1.0, 0.0));
  }
  Placed placed{pack(light), depth - range, depth + range};
  if (cosine == 0.8) placed = {placed.light, depth, depth + 1.25 * range};  // through the apex and the rim
  if (cosine == 0.6) placed = {placed.light, depth - 0.2 * range, depth + 1.4 * range};
  if (cosine == 0.0) placed.light.direction = glm::vec3(std::nanf(""));  // nobody reads it
  if (cosine == 1.0 || range == 0.0) placed.far = placed.near - 1.0;
  return placed;
}

std::vector<Placed> random_lights(const View& view, std::uint32_t count, int depths) {
  std::mt19937 random(count + 1);
  const int behind = depths / 4;  // the eye
  std::vector<Placed> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double depth = static_cast<int>(random() % depths) - behind + 0.5;
    const double cosine = (std::array{0.0, 0.0, 0.6, 0.8})[random() % 4];
    const std::uint32_t rare = random() % 64;
    if (rare == 0) lights.push_back(place(view, depth, std::numeric_limits<double>::infinity(), 0.0));
    if (rare == 1) lights.push_back(place(view, depth, 0.0, cosine));
    if (rare == 2) lights.push_back(place(view, depth, 10.0, 1.0));
    if (rare <= 2) continue;
    // Wholes from 1.25, 0.2 and 1.4 times the range.
    const double unit = cosine == 0.8 ? 4.0 : cosine == 0.6 ? 5.0 : 1.0;
    lights.push_back(place(view, depth, unit * static_cast<double>(random() % 4 + 1), cosine));
  }
  return lights;
}

struct Sorted {
  std::vector<std::uint32_t> order, bins;
  bool operator==(const Sorted&) const = default;
};

Sorted sort_on_host(const View& view, const std::vector<Placed>& lights, std::vector<std::string> settings) {
  const Method& method = *find_method("drobot-zbin").value();
  settings.emplace_back("sort=cpu");
  const auto count = static_cast<std::uint32_t>(lights.size());
  const Plan plan = make_plan(method, {.width = 8,
                                       .height = 8,
                                       .light_capacity = count,
                                       .options = resolve_options(method, settings).value(),
                                       .traits = TRAITS})
                        .value();
  const Pass& pass = plan.passes[0];
  EXPECT_EQ(pass.kind, PassKind::host);
  std::vector<shared::Light> packed;
  for (const Placed& light : lights) packed.push_back(light.light);
  const auto words = [&](std::size_t binding) {
    return plan.buffers[pass.bindings[binding].resource - PLAN_BUFFER].bytes / 4;
  };
  Sorted sorted{std::vector<std::uint32_t>(words(0)), std::vector<std::uint32_t>(words(1))};
  const std::span<std::byte> buffers[] = {std::as_writable_bytes(std::span(sorted.order)),
                                          std::as_writable_bytes(std::span(sorted.bins))};
  const shared::Frame frame = view.frame(count, count);
  pass.host({.lights = packed, .frame = &frame, .buffers = buffers, .constants = pass.constants});
  sorted.order.resize(count);
  return sorted;
}

void expect_sorted(const std::vector<Placed>& lights, const std::vector<std::uint32_t>& order) {
  for (std::size_t rank = 1; rank < order.size(); ++rank) {
    const Placed& before = lights[order[rank - 1]];
    const Placed& light = lights[order[rank]];
    if (light.far < light.near) {
      ASSERT_TRUE(before.far >= before.near || order[rank - 1] < order[rank]) << "rank " << rank;
      continue;
    }
    ASSERT_GE(before.far, before.near) << "lights that reach nothing come last";
    if (std::isinf(before.far) || std::isinf(light.far)) continue;
    ASSERT_LE(before.middle(), light.middle() + 1e-3) << "rank " << rank;
    const bool equal = before.light.position == light.light.position && before.middle() == light.middle();
    ASSERT_TRUE(!equal || order[rank - 1] < order[rank]) << "rank " << rank;
  }
  std::vector<std::uint32_t> each = order;
  std::ranges::sort(each);
  for (std::uint32_t i = 0; i < each.size(); ++i) ASSERT_EQ(each[i], i) << "each light once";
}

/// `bin_of`: of a depth.
template <typename BinOf>
void expect_bins(const std::vector<Placed>& lights, const Sorted& sorted, std::uint32_t bins, BinOf bin_of) {
  const bool wide = lights.size() > 65535;
  ASSERT_EQ(sorted.bins.size(), wide ? 2 * bins : bins);
  std::vector<std::uint32_t> least(bins, wide ? ~0U : 0xffffU);
  std::vector<std::uint32_t> greatest(bins, 0);
  for (std::uint32_t rank = 0; rank < sorted.order.size(); ++rank) {
    const Placed& light = lights[sorted.order[rank]];
    if (light.far < light.near) continue;
    for (std::uint32_t bin = bin_of(light.near); bin <= bin_of(light.far); ++bin) {
      least[bin] = std::min(least[bin], rank);
      greatest[bin] = rank;
    }
  }
  for (std::uint32_t bin = 0; bin < bins; ++bin) {
    ASSERT_EQ(wide ? sorted.bins[2 * bin] : sorted.bins[bin] & 0xffffU, least[bin]) << "bin " << bin;
    ASSERT_EQ(wide ? sorted.bins[2 * bin + 1] : sorted.bins[bin] >> 16U, greatest[bin]) << "bin " << bin;
  }
}

/// Bins of one metre from 1 m on.
std::vector<std::string> metre_bins(std::uint32_t bins) {
  return {"bins=" + std::to_string(bins), "near_mm=1000", "far_m=" + std::to_string(std::max(2U, bins - 1))};
}

struct Case {
  std::uint32_t lights, bins;
  int depths;
};
constexpr Case CASES[] = {{0, 3, 10},        {1, 1, 10},         {5, 100, 80},    {40, 1000, 1200},
                          {300, 2, 20},      {300, 3, 20},       {1000, 50, 100}, {20000, 70, 90},
                          {70000, 100, 200}, {100, 65536, 4000}, {2000, 200, 40}, {64, 8096, 500}};

TEST(ZBinHost, BinsHoldTheLeastAndGreatestRankOfLightsThatReachThem) {
  const View view = test_view();
  for (const auto& [count, bins, depths] : CASES) {
    SCOPED_TRACE(testing::Message() << count << " lights, " << bins << " bins");
    const std::vector<Placed> lights = random_lights(view, count, depths);
    const Sorted sorted = sort_on_host(view, lights, metre_bins(bins));
    expect_sorted(lights, sorted.order);
    expect_bins(lights, sorted, bins, [last = bins - 1.0](double depth) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(depth), 0.0, last));
    });
    if (HasFatalFailure()) return;
  }
}

TEST(ZBinHost, BinsOfAConstantFactor) {
  const View view = test_view();
  std::mt19937 random(3);
  std::vector<Placed> lights;
  for (int i = 0; i < 500; ++i) {
    const double near = std::ldexp(1.5, static_cast<int>(random() % 12) - 3);
    const double far = std::ldexp(1.5, static_cast<int>(random() % 12) - 3);
    if (near < far) lights.push_back(place(view, (near + far) / 2.0, (far - near) / 2.0, 0.0));
    if (i % 50 == 0) lights.push_back(place(view, -10.0, i == 100 ? 13.0 : 5.0, 0.0));
  }
  const Sorted sorted = sort_on_host(view, lights, {"bins=11", "near_mm=500", "far_m=256", "bin_scale=log2"});
  expect_sorted(lights, sorted.order);
  expect_bins(lights, sorted, 11, [](double depth) {  // inner bins double
    if (depth < 0.5) return 0U;
    return std::min(10U, 1U + static_cast<std::uint32_t>(std::floor(std::log2(depth / 0.5))));
  });
}

// A thread keeps its memory between frames, but nothing that is in it.
TEST(ZBinHost, FramesDoNotDependOnThoseBeforeThemNorOnOtherThreads) {
  const View view = test_view();
  const std::vector<Placed> few = random_lights(view, 50, 60);
  const std::vector<Placed> many = random_lights(view, 70000, 60);
  const auto run = [&] {
    std::vector<Sorted> frames;
    for (int i = 0; i < 3; ++i) {
      frames.push_back(sort_on_host(view, few, metre_bins(100)));
      frames.push_back(sort_on_host(view, many, metre_bins(30)));
      frames.push_back(sort_on_host(view, {}, metre_bins(7)));
    }
    return frames;
  };
  auto other = std::async(std::launch::async, run);
  const std::vector<Sorted> frames = run();
  for (std::size_t i = 3; i < frames.size(); ++i) EXPECT_EQ(frames[i], frames[i - 3]);
  EXPECT_EQ(other.get(), frames);
}

}  // namespace
}  // namespace lamp
