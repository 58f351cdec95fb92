// Frames of any size up to a plan's, one after the other, as engines with dynamic resolution have them: each is what a
// plan for that size makes of it, for every method; and a Culler loses no light of any.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <random>

#include "gpu/engine_frame.h"
#include "gpu/gpu_test.h"
#include "gpu/over_depth.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;
using Settings = std::vector<std::string>;

constexpr std::uint32_t LIGHTS = 100;
constexpr double NEAR_M = 0.1;
constexpr glm::uvec2 LARGEST(149, 83);
// Larger and smaller in turns: what a frame leaves behind must not be seen by the next one.
constexpr glm::uvec2 SIZES[] = {LARGEST, {75, 42}, {1, 1}, {149, 9}, {17, 83}, {128, 64}, LARGEST};

View view_of_size(glm::uvec2 size) {
  const glm::dmat4 projection =
      perspective(symmetric_window(1.0, static_cast<double>(size.x) / size.y), NEAR_M, INFINITE_FAR);
  return View::create(size.x, size.y, projection, glm::dmat4(1.0)).value();
}

/// Blocks of surfaces 4 m to 7 m ahead, with some sky.
std::vector<float> surfaces(glm::uvec2 size) {
  std::vector<float> depth;
  for (std::uint32_t y = 0; y < size.y; ++y)
    for (std::uint32_t x = 0; x < size.x; ++x) {
      const std::uint32_t block = x / 5 * 31 + y / 3 * 17;
      depth.push_back(block % 11 == 0 ? 0.0F : static_cast<float>(NEAR_M / (4.0 + (block % 23) / 8.0)));
    }
  return depth;
}

/// Small, in front of the surfaces, among them and behind them.
std::vector<shared::Light> scattered_lights(const View& view) {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Light> lights(LIGHTS);
  for (Light& light : lights) {
    light.position =
        glm::vec3(view.view_position({unit() * view.width(), unit() * view.height()}, 0.5 + 12.0 * unit()));
    light.range = static_cast<float>(0.2 + unit());
    if (unit() < 0.7) continue;
    light.type = LightType::spot;
    light.direction = {unit() - 0.5, unit() - 0.5, -unit()};
    light.outer_angle = static_cast<float>(0.1 + unit());
  }
  return pack(lights);
}

Problem problem_of(const Method& method, const Settings& settings, glm::uvec2 size) {
  return {.width = size.x,
          .height = size.y,
          .light_capacity = LIGHTS,
          .options = take(resolve_options(method, settings)),
          .traits = test_context().device().traits};
}

vulkan::PlanRunner runner_of(const Method& method, const Settings& settings, glm::uvec2 size) {
  Plan plan = take(make_plan(method, problem_of(method, settings, size)));
  return take(vulkan::PlanRunner::create(test_context().device(), std::move(plan), shader_library().source()));
}

void expect_same_as_own_plans(const Method& method, const Settings& settings, std::span<const glm::uvec2> sizes) {
  SCOPED_TRACE(fmt::format("{} {}", method.name, fmt::join(settings, " ")));
  vulkan::PlanRunner runner = runner_of(method, settings, LARGEST);
  for (const glm::uvec2 size : sizes) {
    SCOPED_TRACE(fmt::format("{}x{}", size.x, size.y));
    const View view = view_of_size(size);
    OverDepth frame(view, surfaces(size), scattered_lights(view));
    vulkan::PlanRunner own = runner_of(method, settings, size);
    for (const Passes which : {Passes::separate, Passes::fused}) {
      if (which == Passes::fused && !own.plan().fused) continue;
      EXPECT_EQ(frame.per_pixel("count_everywhere", runner, which), frame.per_pixel("count_everywhere", own, which))
          << (which == Passes::fused ? "fused" : "separate");
      runner.finish(runner.records());  // so that what is kept is kept
    }
  }
}

class FrameSizes : public GpuTest {};

TEST_F(FrameSizes, AreWhatAPlanOfThatSizeMakesOfThem) {
  for (const Method& method : methods()) expect_same_as_own_plans(method, {}, SIZES);
}

TEST_F(FrameSizes, HoldForEveryWayToKeepWhatWasFound) {
  const auto check = [](std::string_view method, Settings settings) {
    expect_same_as_own_plans(*take(find_method(method)), settings, std::span(SIZES).first(2));
  };
  check("tiled", {"frusta=cached", "reduce=parallel"});
  check("tiled", {"order=type", "bounds=modified-half"});
  check("tiled", {"container=bits", "prune=pixel"});
  check("clustered", {"container=bits"});
  check("drobot-raster-tile", {"depth=stencil", "raster=full"});
  check("drobot-raster-cluster", {"early=on", "raster=quarter-msaa"});
  for (const char* cells : {"gather", "bits", "list"})
    check("lamplight", {fmt::format("cells={}", cells), "tile=8", "prune=pixel"});
  for (const char* cells : {"bits", "list"})
    check("lamplight", {fmt::format("cells={}", cells), "depth=none", "container=bits"});
}

}  // namespace
}  // namespace lamp::app
