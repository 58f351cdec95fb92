// The Culler as an engine uses it: its own command buffer, depth image, light buffer and shader.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <bit>

#include "gpu/dispatch.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/pass_uses.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 85;
constexpr std::uint32_t HEIGHT = 51;
constexpr std::uint32_t CAPACITY = 64;  ///< one bit a light in walk.comp

/// What an engine has of a frame.
struct EngineFrame {
  View view;
  std::vector<shared::Light> lights;
  std::vector<float> depth;
  GpuImage depth_image;
  vulkan::Buffer light_buffer;
  vulkan::Buffer sphere_buffer;
};

EngineFrame make_frame(std::string_view projection, std::uint32_t lights) {
  const TestScene& scene = builtin_test_scene("corridor");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, projection);
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, CAPACITY);
  const LitCase lit = make_case(renderer, view, test_lights(scene.air, view, {.count = lights}));
  std::vector<shared::Light> padded = lit.lights;
  padded.resize(CAPACITY);
  return {view,
          lit.lights,
          lit.depth,
          depth_image(WIDTH, HEIGHT, lit.depth),
          host_buffer_of("engine lights", padded),
          host_buffer_of("engine spheres", bounding_spheres(padded))};
}

vulkan::Pipeline walk_pipeline(const vulkan::BoundLookUp& lookup) {
  vulkan::PipelineInfo info{
      .name = "walk", .constants = lookup.constants, .bindings = {{0}, {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}, {2}}};
  info.constants.push_back({0, 8});
  info.constants.push_back({1, 8});
  for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
  return take(
      vulkan::Pipeline::compute(test_context().device(), info, test_shader("walk@" + std::string(lookup.name))));
}

/// Culls and walks in one command buffer. The engine orders nothing between the two: the Culler has done so.
std::vector<glm::uvec2> cull_and_walk(vulkan::Culler& culler, const EngineFrame& frame) {
  const vulkan::Device& device = test_context().device();
  const vulkan::BoundLookUp lookup = culler.lookup();
  const vulkan::Pipeline walk = walk_pipeline(lookup);
  const vulkan::Buffer frames =
      host_buffer_of("engine frame", std::vector{frame.view.frame(static_cast<std::uint32_t>(frame.lights.size()))});
  const vulkan::Buffer masks = host_buffer("masks", WIDTH * HEIGHT * sizeof(glm::uvec2));
  std::vector<vulkan::Bound> bound = lookup.resources;
  bound.push_back({0, vulkan::Resource::storage(frames.handle())});
  bound.push_back({1, frame.depth_image.sampled()});
  bound.push_back({2, vulkan::Resource::storage(masks.handle())});
  test_context().submit([&](VkCommandBuffer commands) {
    culler.record(commands, {.view = &frame.view,
                             .lights = frame.light_buffer.handle(),
                             .spheres = frame.sphere_buffer.handle(),  // read if the Culler was told so
                             .light_count = static_cast<std::uint32_t>(frame.lights.size()),
                             .host_lights = frame.lights,
                             .depth_image = frame.depth_image.handle(),
                             .depth_view = frame.depth_image.view(),
                             .depth_layout = frame.depth_image.sampled().layout});
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(device, commands, tracker);
    recorder.bind(walk, bound);
    vkCmdDispatch(commands, (WIDTH + 7) / 8, (HEIGHT + 7) / 8, 1);
    const VkMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                   .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                   .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                   .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
    vkCmdPipelineBarrier2(commands, &dependency);
  });
  return contents<glm::uvec2>(masks);
}

void expect_no_miss(const EngineFrame& frame, const std::vector<glm::uvec2>& masks) {
  const Truth lit =
      truth({.view = frame.view, .depth = frame.depth, .lights = frame.lights, .rows = frame.view.height()});
  ASSERT_GT(lit.lights.size(), 100);
  for (std::size_t pixel = 0; pixel < masks.size(); ++pixel) {
    for (std::uint32_t i = lit.offsets[pixel]; i < lit.offsets[pixel + 1]; ++i) {
      const std::uint32_t light = lit.lights[i];
      ASSERT_NE(masks[pixel][static_cast<int>(light / 32)] >> (light % 32) & 1, 0)
          << "pixel " << pixel << " light " << light;
    }
  }
}

std::uint64_t walked(const std::vector<glm::uvec2>& masks) {
  std::uint64_t sum = 0;
  for (const glm::uvec2 mask : masks) sum += std::popcount(mask.x) + std::popcount(mask.y);
  return sum;
}

Result<vulkan::Culler> make_culler(std::string method, std::vector<std::string> options = {},
                                   bool brings_spheres = false) {
  return vulkan::Culler::create(test_context().device(), {.width = WIDTH,
                                                          .height = HEIGHT,
                                                          .light_capacity = CAPACITY,
                                                          .method = std::move(method),
                                                          .options = std::move(options),
                                                          .brings_spheres = brings_spheres});
}

class CullerTest : public GpuTest {};

TEST_F(CullerTest, EveryMethodCullsFrameAfterFrame) {
  const EngineFrame frames[] = {make_frame("infinite", 64), make_frame("orthographic", 33),
                                make_frame("off-centre", 64)};
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    vulkan::Culler culler = take(make_culler(std::string(method.name)));
    EXPECT_EQ(culler.bytes() > 0, &method != &brute_force());
    std::uint64_t sum = 0;
    for (const EngineFrame& frame : frames) {
      const std::vector<glm::uvec2> masks = cull_and_walk(culler, frame);
      if (!method.approximate) expect_no_miss(frame, masks);
      sum += walked(masks);
    }
    EXPECT_GT(sum, 0);
    if (&method != &brute_force()) {
      EXPECT_LT(sum, std::uint64_t{WIDTH} * HEIGHT * (64 + 33 + 64));
    }
    EXPECT_EQ(culler.counters().overflowed_cells, 0);
  }
}

TEST_F(CullerTest, SpheresOfTheEngineOrOfItsOwn) {
  const EngineFrame frame = make_frame("infinite", 64);
  for (const char* method : {"lamplight", "tiled", "clustered"}) {
    SCOPED_TRACE(method);
    vulkan::Culler own = take(make_culler(method));
    vulkan::Culler brought = take(make_culler(method, {}, /* brings_spheres= */ true));
    const std::vector<glm::uvec2> masks = cull_and_walk(brought, frame);
    expect_no_miss(frame, masks);
    EXPECT_GT(walked(masks), 0);
    EXPECT_NEAR(static_cast<double>(walked(masks)), static_cast<double>(walked(cull_and_walk(own, frame))),
                1e-3 * static_cast<double>(walked(masks)));
  }
}

// What `lamplight` does with few lights in small pictures where subgroups are large: a work group is a tile.
TEST_F(CullerTest, FewLightsInTilesOrInCells) {
  const EngineFrame frame = make_frame("infinite", 64);
  vulkan::Device large_subgroups = test_context().device();
  large_subgroups.traits.subgroup_size = 32;  // of plans alone: shaders ask the device
  for (const std::string container : {"container=list", "container=bits"}) {
    for (const std::string prune : {"prune=none", "prune=pixel"}) {
      SCOPED_TRACE(fmt::format("{} {}", container, prune));
      const auto culler_on = [&](const vulkan::Device& device, std::string cells) {
        return take(vulkan::Culler::create(device, {.width = WIDTH,
                                                    .height = HEIGHT,
                                                    .light_capacity = CAPACITY,
                                                    .method = "lamplight",
                                                    .options = {container, prune, std::move(cells)}}));
      };
      vulkan::Culler tiles = culler_on(large_subgroups, "cells=gather");
      vulkan::Culler cells = culler_on(test_context().device(), "cells=gather");
      vulkan::Culler lights = culler_on(test_context().device(), "cells=bits");
      const std::vector<glm::uvec2> masks = cull_and_walk(tiles, frame);
      expect_no_miss(frame, masks);
      EXPECT_EQ(masks, cull_and_walk(cells, frame));
      EXPECT_EQ(masks, cull_and_walk(lights, frame));
    }
  }
}

TEST_F(CullerTest, HostPassesGetTheEnginesLights) {
  const EngineFrame frame = make_frame("infinite", 64);
  vulkan::Culler gpu = take(make_culler("drobot-zbin"));
  vulkan::Culler cpu = take(make_culler("drobot-zbin", {"sort=cpu"}));
  const std::vector<glm::uvec2> masks = cull_and_walk(cpu, frame);
  expect_no_miss(frame, masks);
  EXPECT_EQ(masks, cull_and_walk(gpu, frame));
}

TEST_F(CullerTest, CountsWhatDoesNotFit) {
  const EngineFrame frame = make_frame("infinite", 64);
  for (const auto& [method, option] :
       {std::pair("tiled", "capacity=1"), {"primal", "mean_capacity=1"}, {"clustered", "mean_capacity=1"}}) {
    SCOPED_TRACE(method);
    vulkan::Culler fits = take(make_culler(method));
    vulkan::Culler full = take(make_culler(method, {option}));
    EXPECT_EQ(full.counters().overflowed_cells, 0) << "before the first frame";
    const std::uint64_t least = walked(cull_and_walk(fits, frame));
    const std::vector<glm::uvec2> masks = cull_and_walk(full, frame);
    expect_no_miss(frame, masks);
    EXPECT_GT(walked(masks), least);
    EXPECT_GT(full.counters().overflowed_cells, 0);
  }
}

TEST_F(CullerTest, GrowsForTheNextFrame) {
  const EngineFrame frame = make_frame("infinite", 64);
  struct Case {
    std::string method;
    std::vector<std::string> options;
    vulkan::Growth growth;
  };
  for (const auto& [method, options, growth] :
       {Case{"tiled", {"capacity=1"}, vulkan::Growth::constants},
        Case{"primal", {"mean_capacity=1"}, vulkan::Growth::buffers},
        Case{"clustered", {"mean_capacity=1"}, vulkan::Growth::constants},
        Case{"lamplight", {"mean_capacity=1", "cells=bits"}, vulkan::Growth::buffers}}) {
    SCOPED_TRACE(method);
    vulkan::Culler fits = take(make_culler(method));
    vulkan::Culler full = take(make_culler(method, options));
    const std::uint64_t least = walked(cull_and_walk(fits, frame));
    EXPECT_EQ(take(fits.finish(1)), vulkan::Growth::none);
    expect_no_miss(frame, cull_and_walk(full, frame));
    const std::uint64_t bytes = full.bytes();
    EXPECT_GT(full.counters().overflowed_cells, 0);
    EXPECT_EQ(take(full.finish(1)), growth);
    EXPECT_GT(full.bytes(), bytes);
    const std::vector<glm::uvec2> masks = cull_and_walk(full, frame);
    expect_no_miss(frame, masks);
    EXPECT_EQ(walked(masks), least);
    EXPECT_EQ(full.counters().overflowed_cells, 0);
    EXPECT_EQ(take(full.finish(2)), vulkan::Growth::none);
  }
}

TEST_F(CullerTest, FramesUnderWayKeepTheirBuffers) {
  const EngineFrame frame = make_frame("infinite", 64);
  vulkan::Culler culler = take(make_culler("clustered", {"mean_capacity=1"}));
  const std::vector<vulkan::Bound> first = culler.lookup().resources;
  static_cast<void>(cull_and_walk(culler, frame));
  static_cast<void>(cull_and_walk(culler, frame));
  EXPECT_EQ(take(culler.finish(1)), vulkan::Growth::constants);
  EXPECT_NE(culler.lookup().resources.back().resource.buffer, first.back().resource.buffer);
  EXPECT_EQ(take(culler.finish(2)), vulkan::Growth::none) << "it was recorded before the Culler grew";
  for (std::uint64_t number = 3; number < 9; ++number) {
    expect_no_miss(frame, cull_and_walk(culler, frame));
    EXPECT_EQ(take(culler.finish(number)), vulkan::Growth::none);
    EXPECT_EQ(culler.counters().overflowed_cells, 0);
  }
}

void expect_error(const vulkan::CullerInfo& info, std::initializer_list<const char*> parts) {
  const auto culler = vulkan::Culler::create(test_context().device(), info);
  ASSERT_FALSE(culler.ok());
  for (const char* part : parts)
    EXPECT_NE(culler.error().text().find(part), std::string::npos) << part << " in: " << culler.error().text();
}

TEST_F(CullerTest, ErrorsNameWhatIsWrong) {
  const vulkan::CullerInfo good{.width = WIDTH, .height = HEIGHT, .light_capacity = CAPACITY, .method = "tiled"};
  EXPECT_TRUE(vulkan::Culler::create(test_context().device(), good).ok());
  vulkan::CullerInfo info = good;
  info.method = "tield";
  expect_error(info, {"tield", "tiled"});
  info = good;
  info.options = {"tyle=16"};
  expect_error(info, {"tyle", "tile"});
  info.options = {"tile=17"};
  expect_error(info, {"tile", "17", "16"});
  info = good;
  info.width = 0;
  expect_error(info, {"0x51", "expected 1 to"});
  info.width = 1U << 20;
  expect_error(info, {"1048576x51", "expected 1 to"});
  info = good;
  info.light_capacity = MAX_LIGHTS + 1;
  expect_error(info, {"light capacity", std::to_string(MAX_LIGHTS).c_str()});
}

}  // namespace
}  // namespace lamp::app
