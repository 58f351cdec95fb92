// Forward shading in HLSL, with Lamplight's 64-byte light records and a method that needs no depth: the least that an
// engine with HLSL shaders has to do. Three frames of moving lights, each compared with a picture from all lights.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/vulkan.h>  // lamplight

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t BOXES[] = {
#include "boxes.vert.hlsl.inc"
};
constexpr std::uint32_t FORWARD[] = {
#include "forward.frag.hlsl.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.frag.hlsl.inc"
};

constexpr VkExtent2D SIZE{320, 180};
constexpr std::uint32_t LIGHTS = 500;
constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat DEPTH = VK_FORMAT_D32_SFLOAT;

/// Push constants, as in boxes.vert.hlsl and brute_force.frag.hlsl.
struct Push {
  glm::mat4 clip_from_world;
  std::uint32_t light_count;
};

// lamplight {
template <class T>
T value_of(lamp::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(result.value());
}

using Record = lamp::shared::Light;  // 64 bytes

std::vector<Record> pack(const std::vector<HostLight>& lights) {
  std::vector<lamp::Light> described;
  for (const HostLight& light : lights)
    described.push_back({.type = light.outer_angle < 0 ? lamp::LightType::point : lamp::LightType::spot,
                         .position = light.position,
                         .range = light.range,
                         .color = light.color,
                         .direction = light.direction,
                         .outer_angle = std::max(light.outer_angle, 0.0F)});
  return lamp::pack(described);
}
// }

/// Draws the scene and copies the picture to `to`.
void draw(VkCommandBuffer commands, const Pipeline& pipeline, const Push& push, std::uint32_t boxes, const Image& color,
          const Image& depth, const Buffer& to) {
  transition(commands, color, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
  transition(commands, depth, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
  begin_rendering(commands, {.colors = {color}, .depth = depth});
  bind(commands, pipeline, push);
  vkCmdDraw(commands, 36, boxes, 0, 0);
  vkCmdEndRendering(commands);
  read_back(commands, color, to);
}

bool run(const Options& options) {
  Gpu gpu(options.validate);
  const double aspect = double{SIZE.width} / SIZE.height;
  const glm::dmat4 clip_from_view = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  // The method is `clustered`, since none is named. mean_capacity=1 is little room, to show how it grows; by default
  // there is enough.
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(vkGetInstanceProcAddr, gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, gpu.physical)) throw std::runtime_error(lack->text());
  const lamp::vulkan::RequiredFeatures features;
  gpu.make_device(features.base, lamp::vulkan::useful_extensions(instance, gpu.physical));
  const auto device = value_of(lamp::vulkan::make_device(instance, gpu.physical, gpu.device));
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width, .height = SIZE.height, .light_capacity = LIGHTS, .options = {"mean_capacity=1"}}));
  const lamp::View view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, view_from_world()));
  // }

  const Push push{glm::mat4(clip_from_view * view_from_world()), LIGHTS};

  const std::vector<Box> boxes = make_boxes();
  const Buffer box_buffer = gpu.make_buffer(boxes.size() * sizeof(Box));
  std::ranges::copy(boxes, box_buffer.as<Box>().begin());
  const Buffer light_buffer = gpu.make_buffer(LIGHTS * sizeof(Record));
  const Buffer culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Buffer brute = gpu.make_buffer(culled.bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Image color =
      gpu.make_image({SIZE, COLOR, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  const Image depth = gpu.make_image({SIZE, DEPTH, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});

  PipelineInfo info{
      .shaders = {{VK_SHADER_STAGE_VERTEX_BIT, BOXES}, {VK_SHADER_STAGE_FRAGMENT_BIT, BRUTE_FORCE}},
      .descriptors = {{.binding = 0, .buffer = box_buffer.handle}, {.binding = 1, .buffer = light_buffer.handle}},
      .colors = {COLOR},
      .depth = DEPTH};
  const Pipeline brute_force = gpu.make_pipeline(info);
  info.shaders[1].spirv = FORWARD;
  // lamplight {
  const lamp::vulkan::BoundLookUp lookup = culler.lookup();
  const lamp::vulkan::DescriptorWrites writes = lookup.writes();
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_FRAGMENT_BIT);
  info.writes = writes.writes;
  info.constants = constants.info();
  // }
  const Pipeline forward = gpu.make_pipeline(info);

  bool same = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    std::ranges::copy(pack(make_lights(LIGHTS, frame)), light_buffer.as<Record>().begin());
    std::uint64_t number = 0;
    gpu.submit(gpu.graphics, [&](VkCommandBuffer commands) {
      // lamplight {
      number = value_of(culler.record(commands, {.view = &view, .lights = light_buffer.handle, .light_count = LIGHTS}));
      // }
      draw(commands, forward, push, static_cast<std::uint32_t>(boxes.size()), color, depth, culled);
      draw(commands, brute_force, push, static_cast<std::uint32_t>(boxes.size()), color, depth, brute);
    });
    gpu.wait();
    // lamplight {
    if (value_of(culler.finish(number)) != lamp::vulkan::Growth::none) culler.lookup().write_to(device, forward.set);
    // }
    same = compare(culled.as<glm::vec4>(), brute.as<glm::vec4>(), 1e-4F) && same;
  }
  write_picture(options, SIZE.width, culled.as<glm::vec4>());
  return same && gpu.quiet();
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
