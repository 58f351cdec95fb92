// Makes frames, culls them and walks their look-ups.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/engine_frame.h"

#include <bit>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/antialias.h"
#include "render/host_depth.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

vulkan::Pipeline walk_pipeline(const vulkan::BoundLookUp& lookup, glm::uvec2 group_px, std::uint32_t view) {
  vulkan::PipelineInfo info{
      .name = "walk", .constants = lookup.constants, .bindings = {{0}, {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}, {2}}};
  info.constants.push_back({0, group_px.x});
  info.constants.push_back({1, group_px.y});
  info.constants.push_back({2, view});
  for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
  return take(
      vulkan::Pipeline::compute(test_context().device(), info, test_shader("walk@" + std::string(lookup.name))));
}

float device_depth(const View& view, double z_view) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(0.0, 0.0, -z_view, 1.0);
  return static_cast<float>(clip.z / clip.w);
}

}  // namespace

EngineFrame engine_frame(const EngineFrameInfo& info) {
  const TestScene& scene = builtin_test_scene("corridor");
  const View centred = view_of(find_camera(scene.scene, ""), ENGINE_WIDTH, ENGINE_HEIGHT, info.projection);
  const View drawn = shifted(centred, info.at - 0.5);
  Renderer renderer(test_context(), shader_library(), scene.gpu, ENGINE_WIDTH, ENGINE_HEIGHT, ENGINE_LIGHTS);
  const LitCase lit =
      make_case(renderer, drawn, test_lights(scene.air, centred, {.count = info.lights, .seed = info.seed}));
  std::vector<shared::Light> padded = lit.lights;
  padded.resize(ENGINE_LIGHTS);
  const View view = info.reversed_depth ? drawn : with_standard_depth(drawn);
  std::vector<float> depth = lit.depth;
  if (!info.reversed_depth)
    for (float& one : depth) one = one == 0.0F ? 1.0F : device_depth(view, drawn.z_view(one));
  GpuImage image = depth_image(ENGINE_WIDTH, ENGINE_HEIGHT, depth);
  return {view,
          lit.lights,
          std::move(depth),
          std::move(image),
          host_buffer_of("engine lights", padded),
          host_buffer_of("engine spheres", bounding_spheres(padded))};
}

vulkan::CullerFrame culler_frame(const EngineFrame& frame) {
  return {.view = &frame.view,
          .lights = frame.light_buffer.handle(),
          .spheres = frame.sphere_buffer.handle(),
          .light_count = static_cast<std::uint32_t>(frame.lights.size()),
          .host_lights = frame.lights,
          .depth_image = frame.depth_image.handle(),
          .depth_view = frame.depth_image.view(),
          .depth_layout = frame.depth_image.sampled().layout};
}

vulkan::CullerInfo engine_culler_info(std::string_view method, std::vector<std::string> options) {
  return {.width = ENGINE_WIDTH,
          .height = ENGINE_HEIGHT,
          .light_capacity = ENGINE_LIGHTS,
          .method = std::string(method),
          .options = std::move(options)};
}

Result<vulkan::Culler> engine_culler(std::string_view method, std::vector<std::string> options, bool brings_spheres) {
  vulkan::CullerInfo info = engine_culler_info(method, std::move(options));
  info.brings_spheres = brings_spheres;
  return vulkan::Culler::create(test_context().device(), info);
}

MaskPass::MaskPass(const vulkan::BoundLookUp& lookup, const EngineFrame& frame, glm::uvec2 group_px, std::uint32_t view)
    : frame_(frame),
      group_px_(group_px),
      pipeline_(walk_pipeline(lookup, group_px, view)),
      frames_(host_buffer_of("engine frame", std::vector{frame.view.frame(
                                                 static_cast<std::uint32_t>(frame.lights.size()), ENGINE_LIGHTS)})),
      masks_(host_buffer("masks", frame.depth.size() * sizeof(glm::uvec2))),
      sets_(std::make_unique<vulkan::DescriptorSets>(test_context().device())) {}

void MaskPass::record(VkCommandBuffer commands, const vulkan::BoundLookUp& lookup) const {
  std::vector<vulkan::Bound> bound = lookup.resources;
  bound.push_back({0, vulkan::Resource::storage(frames_.handle())});
  bound.push_back({1, frame_.depth_image.sampled()});
  bound.push_back({2, vulkan::Resource::storage(masks_.handle())});
  vulkan::AccessTracker tracker;
  vulkan::Device device = test_context().device();
  device.sets = sets_.get();
  vulkan::Recorder recorder(device, commands, tracker);
  recorder.bind(pipeline_, bound);
  const glm::uvec2 groups = (glm::uvec2(ENGINE_WIDTH, ENGINE_HEIGHT) + group_px_ - 1U) / group_px_;
  vkCmdDispatch(commands, groups.x, groups.y, 1);
}

void MaskPass::record_to_host(VkCommandBuffer commands) {
  const VkMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                 .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                 .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                 .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                 .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
  vkCmdPipelineBarrier2(commands, &dependency);
}

Masks cull_and_walk(vulkan::Culler& culler, const EngineFrame& frame) {
  return cull_and_walk(culler, frame, culler_frame(frame));
}

Masks cull_and_walk(vulkan::Culler& culler, const EngineFrame& frame, const vulkan::CullerFrame& told) {
  const MaskPass pass(culler.lookup(), frame);
  test_context().submit([&](VkCommandBuffer commands) {
    static_cast<void>(take(culler.record(commands, told)));
    pass.record(commands, culler.lookup());
    MaskPass::record_to_host(commands);
  });
  return pass.masks();
}

void expect_no_miss(const EngineFrame& frame, const Masks& masks) {
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

std::uint64_t walked(const Masks& masks) {
  std::uint64_t sum = 0;
  for (const glm::uvec2 mask : masks) sum += std::popcount(mask.x) + std::popcount(mask.y);
  return sum;
}

}  // namespace lamp::app
