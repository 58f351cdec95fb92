// Forward shading with four samples a pixel, behind a pass that draws depth. Depth is standard: near 0, sky 1. Lights
// are culled from the host's own record, of which Lamplight reads position, range, direction and angle. No extension of
// the device is enabled, so descriptors lie in sets. Vulkan's functions are loaded by hand, as volk does.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/vulkan.h>  // lamplight

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t BOXES[] = {
#include "boxes.vert.inc"
};
constexpr std::uint32_t FORWARD[] = {
#include "forward.frag.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.frag.inc"
};

constexpr VkExtent2D SIZE{320, 180};
constexpr std::uint32_t LIGHTS = 500;
constexpr VkSampleCountFlagBits SAMPLES = VK_SAMPLE_COUNT_4_BIT;
constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat DEPTH = VK_FORMAT_D32_SFLOAT;
constexpr float SKY = 1.0F;

/// Push constants, as in brute_force.frag.
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
// }

/// Standard depth is one less the reversed one.
glm::dmat4 standard_projection(double aspect) {
  glm::dmat4 m = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  for (int column = 0; column < 4; ++column) m[column][2] = m[column][3] - m[column][2];
  return m;
}

bool run(const Options& options) {
  Gpu gpu(options.validate);
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(vkGetInstanceProcAddr, gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, gpu.physical)) throw std::runtime_error(lack->text());
  const lamp::vulkan::RequiredFeatures features;
  gpu.make_device(features.base);
  // }
  const glm::dmat4 clip_from_view = standard_projection(double{SIZE.width} / SIZE.height);
  const Push push{glm::mat4(clip_from_view * view_from_world()), LIGHTS};

  // lamplight {
  const auto device = value_of(lamp::vulkan::make_device(instance, gpu.physical, gpu.device));
  const auto view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, view_from_world()));
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width,
               .height = SIZE.height,
               .light_capacity = LIGHTS,
               .method = "tiled",
               .light_layout = lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, position),
                                                              offsetof(HostLight, direction)),
               .depth_samples = SAMPLES}));
  // }

  const std::vector<Box> boxes = make_boxes();
  const auto box_count = static_cast<std::uint32_t>(boxes.size());
  const Buffer box_buffer = gpu.make_buffer(boxes.size() * sizeof(Box));
  std::ranges::copy(boxes, box_buffer.as<Box>().begin());
  const Buffer light_buffer = gpu.make_buffer(LIGHTS * sizeof(HostLight));
  const Buffer culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Buffer brute = gpu.make_buffer(culled.bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Image color = gpu.make_image({SIZE, COLOR, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, SAMPLES});
  const Image resolved =
      gpu.make_image({SIZE, COLOR, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  const Image depth =
      gpu.make_image({SIZE, DEPTH, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, SAMPLES});

  const Pipeline draw_depth = gpu.make_pipeline({.shaders = {{VK_SHADER_STAGE_VERTEX_BIT, BOXES}},
                                                 .descriptors = {{0, box_buffer.handle, {}}},
                                                 .depth = DEPTH,
                                                 .depth_compare = VK_COMPARE_OP_LESS,
                                                 .samples = SAMPLES});
  PipelineInfo info{.shaders = {{VK_SHADER_STAGE_VERTEX_BIT, BOXES}, {VK_SHADER_STAGE_FRAGMENT_BIT, BRUTE_FORCE}},
                    .descriptors = {{0, box_buffer.handle, {}}, {1, light_buffer.handle, {}}},
                    .colors = {COLOR},
                    .depth = DEPTH,
                    .depth_compare = VK_COMPARE_OP_EQUAL,
                    .samples = SAMPLES};
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
    std::ranges::copy(make_lights(LIGHTS, frame), light_buffer.as<HostLight>().begin());
    gpu.submit(gpu.graphics, [&](VkCommandBuffer commands) {
      transition(commands, depth, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
      begin_rendering(commands, {.depth = depth, .clear_depth = SKY});
      bind(commands, draw_depth, push);
      vkCmdDraw(commands, 36, box_count, 0, 0);
      vkCmdEndRendering(commands);
      transition(commands, depth, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
      // lamplight {
      value_of(culler.record(commands, {.view = &view,
                                        .lights = light_buffer.handle,
                                        .cones = light_buffer.handle,
                                        .light_count = LIGHTS,
                                        .depth_image = depth.handle,
                                        .depth_view = depth.view}));
      // }
      transition(commands, depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
      for (const auto& [pipeline, picture] : {std::pair(forward, culled), std::pair(brute_force, brute)}) {
        for (const Image& image : {color, resolved})
          transition(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
        begin_rendering(
            commands,
            {.colors = {color}, .resolve = resolved.view, .depth = depth, .depth_load = VK_ATTACHMENT_LOAD_OP_LOAD});
        bind(commands, pipeline, push);
        vkCmdDraw(commands, 36, box_count, 0, 0);
        vkCmdEndRendering(commands);
        read_back(commands, resolved, picture);
      }
    });
    gpu.wait();
    same = compare(culled.as<glm::vec4>(), brute.as<glm::vec4>(), 1e-4F) && same;
  }
  write_picture(options, SIZE.width, culled.as<glm::vec4>());
  return same && gpu.quiet();
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
