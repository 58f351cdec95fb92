// Z-binning's sort and bins, made on the GPU and on the CPU, against a search over all lights.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "gpu/plan_harness.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t SIZE = 16;  // pixels: one tile, so that any number of lights fits

struct Case {
  std::uint32_t count;
  std::vector<std::string> settings;
};

std::vector<Light> random_lights(std::uint32_t count) {
  std::mt19937 random(count);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    const float distance = 400.0F * unit(random) * unit(random);
    light.position = {distance * (unit(random) - 0.5F), distance * (unit(random) - 0.5F), 100.0F - distance};
    light.range = unit(random) < 0.03F ? 0.0F : 20.0F * unit(random) * unit(random);
    if (unit(random) < 0.001F) light.range = std::numeric_limits<float>::infinity();
    if (unit(random) < 0.5F) continue;
    light.type = LightType::spot;
    light.outer_angle = 1.5F * unit(random);
    light.direction = {unit(random) - 0.5F, unit(random) - 0.5F, unit(random) + 0.01F};
  }
  for (std::uint32_t i = 7; i < count; i += 7) lights[i].position.z = lights[i - 7].position.z;  // equal keys
  return lights;
}

/// What the passes wrote, by the names of their buffers.
class Result {
 public:
  Result(const Method& method, const Case& wanted, const View& view) {
    const Plan plan = take(make_plan(method, {.width = SIZE,
                                              .height = SIZE,
                                              .light_capacity = wanted.count,
                                              .options = take(resolve_options(method, wanted.settings)),
                                              .traits = test_context().device().traits}));
    for (const BufferDesc& buffer : plan.buffers) names_.push_back(buffer.name);
    PlanHarness harness(plan, random_lights(wanted.count), vulkan::embedded_shaders);
    harness.set_view(view);
    words_ = harness.run();
    EXPECT_EQ(words_, harness.run()) << "a second frame differs";
  }
  [[nodiscard]] const std::vector<std::uint32_t>& words(std::string_view name) const {
    return words_[static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin())];
  }
  [[nodiscard]] std::vector<shared::LightBounds> bounds(const char* name, std::uint32_t count) const {
    std::vector<shared::LightBounds> bounds(count);
    if (count != 0) std::memcpy(bounds.data(), words(name).data(), count * sizeof(bounds[0]));
    return bounds;
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<std::uint32_t>> words_;
};

void expect_sorted(const Result& result, std::uint32_t count, bool exactly) {
  std::vector<std::uint32_t> order = result.words("light order");
  order.resize(count);
  const auto bounds = result.bounds("light bounds", count);
  const auto sorted = result.bounds("sorted bounds", count);
  for (std::uint32_t rank = 0; rank < count; ++rank) ASSERT_EQ(sorted[rank].center, bounds[order[rank]].center);
  for (std::uint32_t rank = 1; rank < count; ++rank) {
    const auto& [before, light] = std::pair(bounds[order[rank - 1]], bounds[order[rank]]);
    if (light.radius < 0.0F) continue;
    ASSERT_GE(before.radius, 0.0F) << "lights that reach nothing come last";
    const float slack = exactly ? 0.0F : 1e-4F * (1.0F + std::abs(light.center.z));
    ASSERT_LE(-before.center.z, -light.center.z + slack) << "rank " << rank;
    const bool equal = before.center.z == light.center.z && exactly;
    ASSERT_TRUE(!equal || order[rank - 1] < order[rank]) << "rank " << rank;
  }
  std::ranges::sort(order);
  for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i) << "each light once";
}

/// The depths at which a bin begins, and the first one's end; written down again, apart from the shaders.
double bin_begin(const Options& options, std::uint32_t bin) {
  const double near_m = options.integer("near_mm") * 1e-3;
  const double far_m = options.integer("far_m");
  const double inner = std::max(1, static_cast<int>(options.integer("bins")) - 2);
  if (bin == 0) return -1e30;
  const double share = (bin - 1) / inner;
  return options.word("bin_scale") == "uniform" ? near_m + (far_m - near_m) * share
                                                : near_m * std::pow(far_m / near_m, share);
}

void expect_bins(const Result& result, std::uint32_t count, const Options& options) {
  const std::uint32_t bins = options.integer("bins");
  const std::vector<std::uint32_t>& words = result.words("bins");
  const bool wide = count > 65535;
  ASSERT_EQ(words.size(), wide ? 2 * bins : bins);
  const auto sorted = result.bounds("sorted bounds", count);
  for (std::uint32_t bin = 0; bin < bins; bin += 1 + bins / 97) {
    const double begin = bin_begin(options, bin);
    const double end = bin + 1 == bins ? 1e30 : bin_begin(options, bin + 1);
    const std::uint32_t least = wide ? words[2 * bin] : words[bin] & 0xffffU;
    const std::uint32_t greatest = wide ? words[2 * bin + 1] : words[bin] >> 16U;
    const double slack = 3e-4;  // slices are widened by 1e-4 of a depth
    bool least_reaches = least > greatest;
    bool greatest_reaches = least > greatest;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
      if (sorted[rank].radius < 0.0F) continue;
      const double z = -sorted[rank].center.z;
      const double low = z - sorted[rank].radius;
      const double high = z + sorted[rank].radius;
      if (low < end && high >= begin) {
        ASSERT_LE(least, rank) << "bin " << bin;
        ASSERT_GE(greatest, rank) << "bin " << bin;
      }
      const bool about =
          low - slack * std::abs(low) <= end * (1 + slack) && high + slack * std::abs(high) >= begin * (1 - slack);
      least_reaches = least_reaches || (rank == least && about);
      greatest_reaches = greatest_reaches || (rank == greatest && about);
    }
    ASSERT_TRUE(least_reaches && greatest_reaches) << "bin " << bin << ": " << least << " .. " << greatest;
  }
}

class ZBins : public GpuTest {};

TEST_F(ZBins, HoldTheLeastAndGreatestLightOfTheirDepthsInTheOrderOfDepth) {
  const Method& method = *take(find_method("drobot-zbin"));
  const View view = view_of(find_camera(builtin_test_scene("plane").scene, ""), SIZE, SIZE, "infinite");
  const Case cases[] = {{0, {}},
                        {1, {"bins=1"}},
                        {33, {"bins=2"}},
                        {1024, {"bin_scale=log2"}},
                        {1025, {"bins=100", "near_mm=1", "far_m=2"}},
                        {5000, {"bins=3", "bin_scale=log2"}},
                        {65535, {"bins=65536"}},
                        {70000, {"far_m=100"}}};
  for (const Case& wanted : cases) {
    for (const char* sort : {"sort=gpu", "sort=cpu"}) {
      Case with_sort = wanted;
      with_sort.settings.emplace_back(sort);
      SCOPED_TRACE(fmt::format("{} lights, {}", wanted.count, fmt::join(with_sort.settings, " ")));
      const Result result(method, with_sort, view);
      expect_sorted(result, wanted.count, /*exactly=*/sort == std::string_view("sort=gpu"));
      expect_bins(result, wanted.count, take(resolve_options(method, with_sort.settings)));
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace lamp::app
