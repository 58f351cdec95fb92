// A frame whose record on the GPU counts other lights than the host dispatches for: more than there is room for, of
// which shaders take as many as fit, so that nothing is read or written beyond; or fewer.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/engine_frame.h"
#include "lamplight/shared/slices.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t CAPACITY = 32;  ///< half the lights of the frame: those beyond are the second word of a mask

/// That two blocks of the sort have room for: with few lights the second one is empty.
constexpr std::uint32_t TWO_BLOCKS = shared::SORT_BLOCK + 1;

struct CountCase {
  const Method* method = nullptr;
  std::vector<std::string> settings;

  /// Which of the lists that share too little room find some differs from run to run, and so what is walked for others.
  [[nodiscard]] bool lists_vary() const {
    if (settings.empty()) return false;
    const bool appends = method->name == "lamplight" || settings.front() == "order=type";
    return appends && settings.back().starts_with("mean_");
  }
};

/// Every row; and lists that are too short, where the look-up walks all lights.
std::vector<CountCase> candidates() {
  std::vector<CountCase> all;
  for (const Method& method : methods()) all.push_back({&method, {}});
  for (const auto& [name, settings] : {std::pair<const char*, std::vector<std::string>>{"tiled", {"capacity=1"}},
                                       {"tiled", {"order=type", "mean_capacity=1"}},
                                       {"clustered", {"mean_capacity=1"}},
                                       {"lamplight", {"cells=bits", "mean_capacity=1"}},
                                       {"lamplight", {"cells=list", "mean_cells=0", "mean_capacity=1"}},
                                       {"lamplight", {"cells=list", "container=bits", "mean_cells=0"}},
                                       {"drobot-zbin", {"sort=cpu"}}})
    all.push_back({take(find_method(name)), settings});
  return all;
}

class LightCount : public GpuTest {
 protected:
  /// What the look-up names where the GPU's record counts `count` lights, and the host `dispatched` of them.
  Masks masks(vulkan::PlanRunner& runner, Passes which, std::uint32_t count, std::uint32_t dispatched) {
    const std::uint32_t capacity = runner.plan().light_capacity;
    const shared::Frame honest = frame_.view.frame(dispatched, capacity);
    const vulkan::Buffer record = host_buffer_of("frame", std::vector{frame_.view.frame(count, capacity)});
    const vulkan::PlanInputs inputs{.frame = record.handle(),
                                    .lights = frame_.light_buffer.handle(),
                                    .spheres = frame_.sphere_buffer.handle(),
                                    .depth = frame_.depth_image.sampled(),
                                    .host_lights = host_lights_,
                                    .host_frame = &honest};
    const vulkan::BoundLookUp lookup = runner.lookup(inputs, which);
    const glm::uvec2 group_px = which == Passes::fused
                                    ? glm::uvec2(runner.plan().fused->group_width, runner.plan().fused->group_height)
                                    : glm::uvec2(8);
    const MaskPass pass(lookup, frame_, group_px);
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::AccessTracker tracker;
      tracker.assume(inputs.depth);
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      static_cast<void>(take(runner.record(recorder, inputs, which)));
      recorder.barrier(lookup.uses);
      pass.record(commands, lookup);
      MaskPass::record_to_host(commands);
    });
    return pass.masks();
  }

  /// Its buffers hold all lights, its truth those that there is room for.
  EngineFrame frame_ = [] {
    EngineFrame frame = engine_frame();
    frame.lights.resize(CAPACITY);
    return frame;
  }();
  /// For host passes, as many as any plan has room for.
  std::vector<shared::Light> host_lights_ = [this] {
    std::vector<shared::Light> lights = frame_.lights;
    lights.resize(TWO_BLOCKS);
    return lights;
  }();
};

vulkan::PlanRunner make_runner(const CountCase& one, std::uint32_t capacity) {
  const Plan plan = take(make_plan(*one.method, {.width = ENGINE_WIDTH,
                                                 .height = ENGINE_HEIGHT,
                                                 .light_capacity = capacity,
                                                 .options = take(resolve_options(*one.method, one.settings)),
                                                 .traits = test_context().device().traits}));
  return take(vulkan::PlanRunner::create(test_context().device(), plan));
}

TEST_F(LightCount, BeyondTheCapacityIsCutInEveryShader) {
  for (const CountCase& one : candidates()) {
    const auto& [method, settings] = one;
    SCOPED_TRACE(fmt::format("{} {}", method->name, fmt::join(settings, " ")));
    vulkan::PlanRunner runner = make_runner(one, CAPACITY);
    for (const Passes which : {Passes::separate, Passes::fused}) {
      if (which == Passes::fused && !runner.plan().fused) continue;
      SCOPED_TRACE(which == Passes::fused ? "fused" : "separate");
      const Masks expected = masks(runner, which, CAPACITY, CAPACITY);
      EXPECT_GT(walked(expected), 0);
      for (const std::uint32_t count : {CAPACITY, 2 * CAPACITY, ~0U}) {
        SCOPED_TRACE(count);
        const Masks found = masks(runner, which, count, CAPACITY);
        EXPECT_TRUE(one.lists_vary() || found == expected);
        if (!method->approximate) expect_no_miss(frame_, found);
        EXPECT_TRUE(std::ranges::all_of(found, [](glm::uvec2 mask) { return mask.y == 0; }));
      }
    }
  }
}

// What a frame whose lights the GPU counts is recorded as: dispatched for all that there is room for.
TEST_F(LightCount, FewerThanDispatched) {
  for (const CountCase& one : candidates()) {
    if (one.lists_vary() || (!one.settings.empty() && one.settings.front() == "sort=cpu")) continue;
    SCOPED_TRACE(fmt::format("{} {}", one.method->name, fmt::join(one.settings, " ")));
    vulkan::PlanRunner runner = make_runner(one, TWO_BLOCKS);
    for (const Passes which : {Passes::separate, Passes::fused}) {
      if (which == Passes::fused && !runner.plan().fused) continue;
      SCOPED_TRACE(which == Passes::fused ? "fused" : "separate");
      for (const std::uint32_t count : {CAPACITY, 1U, 0U}) {
        SCOPED_TRACE(count);
        EXPECT_EQ(masks(runner, which, count, TWO_BLOCKS), masks(runner, which, count, count));
      }
    }
  }
}

}  // namespace
}  // namespace lamp::app
