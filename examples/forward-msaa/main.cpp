// Forward shading with four samples a pixel, behind a pass that draws depth. Depth is standard: near 0, sky 1. Lights
// are culled from the host's own record, of which Lamplight reads position, range, direction and angle. No extension of
// the device is enabled, so descriptors lie in sets. volk loads Vulkan's functions.
// SPDX-License-Identifier: Apache-2.0
#define VOLK_IMPLEMENTATION
#include <volk.h>

#include <lamplight/value_of.h>  // lamplight
#include <lamplight/vulkan.h>    // lamplight

#include <algorithm>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t BOX_SHADER[] = {
#include "boxes.vert.inc"
};
constexpr std::uint32_t FORWARD[] = {
#include "forward.frag.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.frag.inc"
};

constexpr vk::Extent2D SIZE{320, 180};
constexpr std::uint32_t LIGHTS = 500;
constexpr vk::SampleCountFlagBits SAMPLES = vk::SampleCountFlagBits::e4;
constexpr float SKY = 1.0F;

/// Push constants, as in brute_force.frag.
struct Push {
  glm::mat4 clip_from_world;
  std::uint32_t light_count;
};

/// Standard depth is one less the reversed one.
glm::dmat4 standard_projection(double aspect) {
  glm::dmat4 m = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  for (int column = 0; column < 4; ++column) m[column][2] = m[column][3] - m[column][2];
  return m;
}

/// Averages the samples.
void resolve(const Commands& commands, const Image& from, const Image& to) {
  barrier(commands);
  constexpr VkImageSubresourceLayers COLORS{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  const VkImageResolve all{.srcSubresource = COLORS, .dstSubresource = COLORS, .extent = {SIZE.width, SIZE.height, 1}};
  constexpr VkImageLayout LAYOUT = VK_IMAGE_LAYOUT_GENERAL;
  vkCmdResolveImage(*commands, *from.handle, LAYOUT, *to.handle, LAYOUT, 1, &all);
}

bool run(const std::string& file) {
  Gpu gpu;
  if (volkInitialize() != VK_SUCCESS) throw std::runtime_error("volk finds no Vulkan loader");
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(vkGetInstanceProcAddr, *gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, *gpu.physical)) throw std::runtime_error(lack->text());
  const lamp::vulkan::RequiredFeatures features;
  gpu.make_device(features.base);
  // }
  volkLoadInstanceOnly(*gpu.instance);
  volkLoadDevice(*gpu.device);
  const glm::dmat4 clip_from_view = standard_projection(double{SIZE.width} / SIZE.height);
  const Push push{glm::mat4(clip_from_view * view_from_world()), LIGHTS};

  // lamplight {
  const auto device = value_of(lamp::vulkan::make_device(instance, *gpu.physical, *gpu.device));
  const auto view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, view_from_world()));
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width,
               .height = SIZE.height,
               .light_capacity = LIGHTS,
               .method = "tiled",
               .light_layout = lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, position),
                                                              offsetof(HostLight, direction)),
               .depth_samples = VK_SAMPLE_COUNT_4_BIT}));
  // }

  const Buffer light_buffer = gpu.make_buffer(LIGHTS * sizeof(HostLight));
  const Buffer culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height);
  const Buffer brute = gpu.make_buffer(culled.bytes.size());
  const Image color = gpu.make_image(COLOR, SIZE, SAMPLES);
  const Image resolved = gpu.make_image(COLOR, SIZE);
  const Image depth = gpu.make_image(DEPTH, SIZE, SAMPLES);

  const Pipeline draw_depth =
      gpu.make_pipeline({.vertex = BOX_SHADER, .depth_compare = vk::CompareOp::eLess, .samples = SAMPLES});
  PipelineInfo info{.vertex = BOX_SHADER,
                    .fragment = BRUTE_FORCE,
                    .buffers = {{light_buffer.handle, 0, VK_WHOLE_SIZE}},
                    .depth_compare = vk::CompareOp::eEqual,
                    .samples = SAMPLES};
  const Pipeline brute_force = gpu.make_pipeline(info);
  info.fragment = FORWARD;
  // lamplight {
  const lamp::vulkan::BoundLookUp lookup = culler.lookup();
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_FRAGMENT_BIT);
  info.constants = constants.info();
  // }
  const Pipeline forward = gpu.make_pipeline(info);
  lookup.write_to(device, *forward.set);  // lamplight

  bool same = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    std::ranges::copy(make_lights(LIGHTS, frame), light_buffer.as<HostLight>().begin());
    gpu.submit(gpu.graphics, [&](const Commands& commands) {
      begin_rendering(commands, {.color = &color, .depth = depth, .clear_depth = SKY});
      bind(commands, draw_depth, push);
      vkCmdDraw(*commands, BOX_VERTICES, BOXES, 0, 0);
      vkCmdEndRendering(*commands);
      barrier(commands);
      // lamplight {
      value_of(culler.record(*commands, {.view = &view,
                                         .lights = light_buffer.handle,
                                         .cones = light_buffer.handle,
                                         .light_count = LIGHTS,
                                         .depth_image = *depth.handle,
                                         .depth_view = *depth.view,
                                         .depth_layout = VK_IMAGE_LAYOUT_GENERAL}));
      // }
      for (const auto& [pipeline, to] : {std::pair(&forward, &culled), std::pair(&brute_force, &brute)}) {
        begin_rendering(commands, {.color = &color, .depth = depth});
        bind(commands, *pipeline, push);
        vkCmdDraw(*commands, BOX_VERTICES, BOXES, 0, 0);
        vkCmdEndRendering(*commands);
        resolve(commands, color, resolved);
        read_back(commands, resolved, *to);
      }
    });
    gpu.wait();
    same = compare(culled.as<glm::vec4>(), brute.as<glm::vec4>(), file, SIZE.width) && same;
  }
  return same;
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
