// The Culler as an engine uses it: its own command buffer, depth image, light buffer and shader.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/engine_frame.h"
#include "gpu/method_check.h"

namespace lamp::app {
namespace {

class CullerTest : public GpuTest {};

TEST_F(CullerTest, EveryMethodCullsFrameAfterFrame) {
  const EngineFrame frames[] = {engine_frame(), engine_frame({.projection = "orthographic", .lights = 33}),
                                engine_frame({.projection = "off-centre"})};
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    vulkan::Culler culler = take(engine_culler(method.name));
    EXPECT_EQ(culler.bytes() > 0, &method != &brute_force() && !method.still);
    std::uint64_t sum = 0;
    for (const EngineFrame& frame : frames) {
      const Masks masks = cull_and_walk(culler, frame);
      if (!method.approximate) expect_no_miss(frame, masks);
      sum += walked(masks);
    }
    EXPECT_GT(sum, 0);
    if (&method != &brute_force()) {
      EXPECT_LT(sum, std::uint64_t{ENGINE_WIDTH} * ENGINE_HEIGHT * (64 + 33 + 64));
    }
    EXPECT_EQ(culler.counters().overflowed_cells, 0);
  }
}

TEST_F(CullerTest, SpheresOfTheEngineOrOfItsOwn) {
  const EngineFrame frame = engine_frame();
  for (const char* method : {"lamplight", "tiled", "clustered"}) {
    SCOPED_TRACE(method);
    vulkan::Culler own = take(engine_culler(method));
    vulkan::Culler brought = take(engine_culler(method, {}, /* brings_spheres= */ true));
    const Masks masks = cull_and_walk(brought, frame);
    expect_no_miss(frame, masks);
    EXPECT_GT(walked(masks), 0);
    EXPECT_NEAR(static_cast<double>(walked(masks)), static_cast<double>(walked(cull_and_walk(own, frame))),
                1e-3 * static_cast<double>(walked(masks)));
  }
}

// What `lamplight` does with few lights in small pictures where subgroups are large: a work group is a tile.
TEST_F(CullerTest, FewLightsInTilesOrInCells) {
  const EngineFrame frame = engine_frame();
  vulkan::Device large_subgroups = test_context().device();
  large_subgroups.traits.subgroup_size = 32;  // of plans alone: shaders ask the device
  for (const std::string container : {"container=list", "container=bits"}) {
    for (const std::string prune : {"prune=none", "prune=pixel"}) {
      SCOPED_TRACE(fmt::format("{} {}", container, prune));
      const auto culler_on = [&](const vulkan::Device& device, std::string cells) {
        return take(vulkan::Culler::create(device, {.width = ENGINE_WIDTH,
                                                    .height = ENGINE_HEIGHT,
                                                    .light_capacity = ENGINE_LIGHTS,
                                                    .method = "lamplight",
                                                    .options = {container, prune, std::move(cells)}}));
      };
      vulkan::Culler tiles = culler_on(large_subgroups, "cells=gather");
      vulkan::Culler cells = culler_on(test_context().device(), "cells=gather");
      vulkan::Culler lights = culler_on(test_context().device(), "cells=bits");
      const Masks masks = cull_and_walk(tiles, frame);
      expect_no_miss(frame, masks);
      EXPECT_EQ(masks, cull_and_walk(cells, frame));
      EXPECT_EQ(masks, cull_and_walk(lights, frame));
    }
  }
}

TEST_F(CullerTest, HostPassesGetTheEnginesLights) {
  const EngineFrame frame = engine_frame();
  vulkan::Culler gpu = take(engine_culler("drobot-zbin"));
  vulkan::Culler cpu = take(engine_culler("drobot-zbin", {"sort=cpu"}));
  const Masks masks = cull_and_walk(cpu, frame);
  expect_no_miss(frame, masks);
  EXPECT_EQ(masks, cull_and_walk(gpu, frame));
}

TEST_F(CullerTest, CountsWhatDoesNotFit) {
  const EngineFrame frame = engine_frame();
  for (const auto& [method, option] :
       {std::pair("tiled", "capacity=1"), {"primal", "mean_capacity=1"}, {"clustered", "mean_capacity=1"}}) {
    SCOPED_TRACE(method);
    vulkan::Culler fits = take(engine_culler(method));
    vulkan::Culler full = take(engine_culler(method, {option}));
    EXPECT_EQ(full.counters().overflowed_cells, 0) << "before the first frame";
    const std::uint64_t least = walked(cull_and_walk(fits, frame));
    const Masks masks = cull_and_walk(full, frame);
    expect_no_miss(frame, masks);
    EXPECT_GT(walked(masks), least);
    EXPECT_GT(full.counters().overflowed_cells, 0);
  }
}

TEST_F(CullerTest, GrowsForTheNextFrame) {
  const EngineFrame frame = engine_frame();
  struct Case {
    std::string method;
    std::vector<std::string> options;
    vulkan::Growth growth;
  };
  for (const auto& [method, options, growth] :
       {Case{"tiled", {"capacity=1"}, vulkan::Growth::constants},
        Case{"primal", {"mean_capacity=1"}, vulkan::Growth::buffers},
        Case{"clustered", {"mean_capacity=1"}, vulkan::Growth::buffers},
        Case{"lamplight", {"mean_capacity=1", "cells=bits"}, vulkan::Growth::buffers}}) {
    SCOPED_TRACE(method);
    vulkan::Culler fits = take(engine_culler(method));
    vulkan::Culler full = take(engine_culler(method, options));
    const std::uint64_t least = walked(cull_and_walk(fits, frame));
    EXPECT_EQ(take(fits.finish(1)), vulkan::Growth::none);
    expect_no_miss(frame, cull_and_walk(full, frame));
    const std::uint64_t bytes = full.bytes();
    EXPECT_GT(full.counters().overflowed_cells, 0);
    EXPECT_EQ(take(full.finish(1)), growth);
    EXPECT_GT(full.bytes(), bytes);
    const Masks masks = cull_and_walk(full, frame);
    expect_no_miss(frame, masks);
    EXPECT_EQ(walked(masks), least);
    EXPECT_EQ(full.counters().overflowed_cells, 0);
    EXPECT_EQ(take(full.finish(2)), vulkan::Growth::none);
  }
}

TEST_F(CullerTest, FramesUnderWayKeepTheirBuffers) {
  const EngineFrame frame = engine_frame();
  vulkan::Culler culler = take(engine_culler("clustered", {"mean_capacity=1"}));
  const std::vector<vulkan::Bound> first = culler.lookup().resources;
  static_cast<void>(cull_and_walk(culler, frame));
  static_cast<void>(cull_and_walk(culler, frame));
  EXPECT_EQ(take(culler.finish(1)), vulkan::Growth::buffers);
  EXPECT_NE(culler.lookup().resources.back().resource.buffer, first.back().resource.buffer);
  EXPECT_EQ(take(culler.finish(2)), vulkan::Growth::none) << "it was recorded before the Culler grew";
  for (std::uint64_t number = 3; number < 9; ++number) {
    expect_no_miss(frame, cull_and_walk(culler, frame));
    EXPECT_EQ(take(culler.finish(number)), vulkan::Growth::none);
    EXPECT_EQ(culler.counters().overflowed_cells, 0);
  }
}

}  // namespace
}  // namespace lamp::app
