// A frame whose record counts more lights than there is room for: shaders take as many as fit, and nothing is read or
// written beyond.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/engine_frame.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t CAPACITY = 32;  ///< half the lights of the frame: those beyond are the second word of a mask

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
  /// What the look-up names where the GPU's record counts `count` lights, and the host CAPACITY of them.
  Masks masks(vulkan::PlanRunner& runner, Passes which, std::uint32_t count) {
    const shared::Frame honest = frame_.view.frame(CAPACITY, CAPACITY);
    const vulkan::Buffer record = host_buffer_of("frame", std::vector{frame_.view.frame(count, CAPACITY)});
    const vulkan::PlanInputs inputs{.frame = record.handle(),
                                    .lights = frame_.light_buffer.handle(),
                                    .spheres = frame_.sphere_buffer.handle(),
                                    .depth = frame_.depth_image.sampled(),
                                    .host_lights = frame_.lights,
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
};

TEST_F(LightCount, BeyondTheCapacityIsCutInEveryShader) {
  for (const CountCase& one : candidates()) {
    const auto& [method, settings] = one;
    SCOPED_TRACE(fmt::format("{} {}", method->name, fmt::join(settings, " ")));
    const Plan plan = take(make_plan(*method, {.width = ENGINE_WIDTH,
                                               .height = ENGINE_HEIGHT,
                                               .light_capacity = CAPACITY,
                                               .options = take(resolve_options(*method, settings)),
                                               .traits = test_context().device().traits}));
    vulkan::PlanRunner runner = take(vulkan::PlanRunner::create(test_context().device(), plan));
    for (const Passes which : {Passes::separate, Passes::fused}) {
      if (which == Passes::fused && !runner.plan().fused) continue;
      SCOPED_TRACE(which == Passes::fused ? "fused" : "separate");
      const Masks expected = masks(runner, which, CAPACITY);
      EXPECT_GT(walked(expected), 0);
      for (const std::uint32_t count : {CAPACITY, 2 * CAPACITY, ~0U}) {
        SCOPED_TRACE(count);
        const Masks found = masks(runner, which, count);
        EXPECT_TRUE(one.lists_vary() || found == expected);
        if (!method->approximate) expect_no_miss(frame_, found);
        EXPECT_TRUE(std::ranges::all_of(found, [](glm::uvec2 mask) { return mask.y == 0; }));
      }
    }
  }
}

}  // namespace
}  // namespace lamp::app
