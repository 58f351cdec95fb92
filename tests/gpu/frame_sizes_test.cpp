// Frames of any size up to a plan's, one after the other, as engines with dynamic resolution have them: each is what a
// plan for that size makes of it, for every method; and a Culler loses no light of a smaller frame.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/engine_frame.h"
#include "gpu/made_up_frame.h"
#include "gpu/over_depth.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;
using Settings = std::vector<std::string>;

constexpr std::uint32_t LIGHTS = 100;
constexpr glm::uvec2 LARGEST(149, 83);
// Larger and smaller in turns: what a frame leaves behind must not be seen by the next one.
constexpr glm::uvec2 SIZES[] = {LARGEST, {75, 42}, {1, 1}, {149, 9}, {17, 83}, {128, 64}, LARGEST};

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

void expect_same_as_own_plans(vulkan::PlanRunner& runner, const Method& method, const Settings& settings,
                              std::span<const glm::uvec2> sizes) {
  for (const glm::uvec2 size : sizes) {
    SCOPED_TRACE(fmt::format("{}x{}", size.x, size.y));
    const View view = made_up_view(size);
    OverDepth frame(view, made_up_depths(size), scattered_lights(view, LIGHTS));
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

void expect_same_as_own_plans(const Method& method, const Settings& settings, std::span<const glm::uvec2> sizes) {
  SCOPED_TRACE(fmt::format("{} {}", method.name, fmt::join(settings, " ")));
  vulkan::PlanRunner runner = runner_of(method, settings, LARGEST);
  expect_same_as_own_plans(runner, method, settings, sizes);
}

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

/// Cells go by the size of the picture: a plan that is told so takes those that a plan for that size would have.
TEST_F(FrameSizes, HaveCellsOfTheirOwn) {
  constexpr glm::uvec2 LARGE(872, 705);
  constexpr glm::uvec2 MORE_SIZES[] = {LARGE, {405, 298}, {33, 700}, {871, 703}};
  const Method& method = *take(find_method("lamplight"));
  for (const char* kept : {"cells=bits", "cells=list"})
    for (const char* container : {"container=list", "container=bits"})
      for (const char* depth : {"depth=buffer", "depth=none"}) {
        const Settings settings{kept, container, depth, "tile=8"};
        SCOPED_TRACE(fmt::format("{}", fmt::join(settings, " ")));
        Problem problem = problem_of(method, settings, LARGE);
        problem.smaller_frames = true;
        vulkan::PlanRunner runner =
            take(vulkan::PlanRunner::create(test_context().device(), take(make_plan(method, problem))));
        EXPECT_EQ(runner.plan().cell_shift(LARGE.x, LARGE.y), 0U);
        EXPECT_EQ(runner.plan().cell_shift(405, 298), 1U);
        expect_same_as_own_plans(runner, method, settings, MORE_SIZES);
      }
}

TEST_F(FrameSizes, OfACullerMayBeSmaller) {
  const EngineFrame frame = engine_frame();
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    vulkan::Culler culler = take(vulkan::Culler::create(test_context().device(), {.width = LARGEST.x,
                                                                                  .height = LARGEST.y,
                                                                                  .light_capacity = ENGINE_LIGHTS,
                                                                                  .method = std::string(method.name)}));
    vulkan::Culler own = take(engine_culler(method.name));
    const Masks masks = cull_and_walk(culler, frame);
    EXPECT_EQ(masks, cull_and_walk(own, frame));
    if (!method.approximate) expect_no_miss(frame, masks);
  }
}

}  // namespace
}  // namespace lamp::app
