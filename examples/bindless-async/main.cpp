// Lights that the GPU makes and counts, culled on a queue of its own while the graphics queue draws depth; then forward
// shading with materials in an array of textures. Where the device has no queue for compute alone, all runs on one.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/vulkan.h>  // lamplight

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t MAKE_LIGHTS[] = {
#include "make_lights.comp.inc"
};
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
constexpr std::uint32_t PARTICLES = 750;  // of which the GPU makes some lights
constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat DEPTH = VK_FORMAT_D32_SFLOAT;

// lamplight {
template <class T>
T value_of(lamp::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(result.value());
}
// }

/// Hands buffers from one queue to the other: record it on the first when it is done with them, then on the second
/// before it begins. Queues of one family need no such thing.
void hand_over(VkCommandBuffer commands, std::span<const VkBuffer> buffers, const Queue& from, const Queue& to) {
  if (from.family == to.family) return;
  std::vector<VkBufferMemoryBarrier2> barriers;
  for (const VkBuffer buffer : buffers)
    barriers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT,
                        .srcQueueFamilyIndex = from.family,
                        .dstQueueFamilyIndex = to.family,
                        .buffer = buffer,
                        .size = VK_WHOLE_SIZE});
  const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                              .bufferMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                              .pBufferMemoryBarriers = barriers.data()};
  vkCmdPipelineBarrier2(commands, &info);
}

/// Textures of 8 x 8 texels, one a material: stripes and checks of its colour.
std::vector<VkImageView> make_materials(Gpu& gpu) {
  constexpr VkExtent2D TEXELS{8, 8};
  std::vector<VkImageView> views;
  for (std::uint32_t material = 0; material < 5; ++material) {
    const Buffer texels = gpu.make_buffer(4 * TEXELS.width * TEXELS.height, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    for (std::uint32_t i = 0; i < TEXELS.width * TEXELS.height; ++i) {
      const bool dark = ((i % 8 >> material / 2) + (i / 8 >> material % 2 * 2)) % 2 != 0;
      for (std::uint32_t channel = 0; channel < 4; ++channel)
        texels.as<std::uint8_t>()[4 * i + channel] = dark ? 60 : material % 4 == channel ? 240 : 160;
    }
    const Image image = gpu.make_image(
        {TEXELS, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    gpu.submit(gpu.graphics, [&](VkCommandBuffer commands) {
      transition(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
      const VkBufferImageCopy all{.imageSubresource = {image.aspect, 0, 0, 1}, .imageExtent = {8, 8, 1}};
      vkCmdCopyBufferToImage(commands, texels.handle, image.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &all);
      transition(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    views.push_back(image.view);
  }
  return views;
}

bool run(const Options& options) {
  Gpu gpu(options.validate);
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(vkGetInstanceProcAddr, gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, gpu.physical)) throw std::runtime_error(lack->text());
  lamp::vulkan::RequiredFeatures features;
  // }
  features.vulkan12.descriptorIndexing = VK_TRUE;
  features.vulkan12.runtimeDescriptorArray = VK_TRUE;
  features.vulkan12.shaderSampledImageArrayNonUniformIndexing = VK_TRUE;
  gpu.make_device(features.base);
  std::printf("culls on %s\n", gpu.compute.family == gpu.graphics.family ? "the graphics queue" : "a queue of its own");
  const double aspect = double{SIZE.width} / SIZE.height;
  const glm::dmat4 clip_from_view = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  const glm::mat4 clip_from_world = clip_from_view * view_from_world();

  // lamplight {
  const auto device = value_of(lamp::vulkan::make_device(instance, gpu.physical, gpu.device));
  const auto view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, view_from_world()));
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width,
               .height = SIZE.height,
               .light_capacity = PARTICLES,
               .method = "lamplight",
               .options = {"depth=none", "tile=32"},
               .light_layout = lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, position)),
               .readers = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT}));  // its queue knows no fragment shaders
  const lamp::vulkan::BoundLookUp lookup = culler.lookup();
  if (lookup.name != "cell_lists") throw std::runtime_error("forward.frag includes another look-up");
  // }

  const std::vector<Box> boxes = make_boxes();
  const auto box_count = static_cast<std::uint32_t>(boxes.size());
  const Buffer box_buffer = gpu.make_buffer(boxes.size() * sizeof(Box));
  std::ranges::copy(boxes, box_buffer.as<Box>().begin());
  const Buffer light_buffer = gpu.make_buffer(PARTICLES * sizeof(HostLight));
  const Buffer count_buffer =
      gpu.make_buffer(sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                 VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Buffer culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Buffer brute = gpu.make_buffer(culled.bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Image color =
      gpu.make_image({SIZE, COLOR, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  const Image depth = gpu.make_image({SIZE, DEPTH, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});

  const Pipeline make_lights =
      gpu.make_pipeline({.shaders = {{VK_SHADER_STAGE_COMPUTE_BIT, MAKE_LIGHTS}},
                         .descriptors = {{0, count_buffer.handle, {}}, {1, light_buffer.handle, {}}}});
  const Pipeline draw_depth = gpu.make_pipeline(
      {.shaders = {{VK_SHADER_STAGE_VERTEX_BIT, BOXES}}, .descriptors = {{0, box_buffer.handle, {}}}, .depth = DEPTH});
  PipelineInfo info{.shaders = {{VK_SHADER_STAGE_VERTEX_BIT, BOXES}, {VK_SHADER_STAGE_FRAGMENT_BIT, BRUTE_FORCE}},
                    .descriptors = {{0, box_buffer.handle, {}},
                                    {1, light_buffer.handle, {}},
                                    {2, count_buffer.handle, {}},
                                    {3, VK_NULL_HANDLE, make_materials(gpu)}},
                    .colors = {COLOR},
                    .depth = DEPTH,
                    .depth_compare = VK_COMPARE_OP_EQUAL};
  const Pipeline brute_force = gpu.make_pipeline(info);
  info.shaders[1].spirv = FORWARD;
  std::vector<VkBuffer> handed_over{light_buffer.handle, count_buffer.handle};
  // lamplight {
  for (const auto& bound : lookup.resources) handed_over.push_back(bound.resource.buffer);
  const lamp::vulkan::DescriptorWrites writes = lookup.writes();
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_FRAGMENT_BIT);
  info.writes = writes.writes;
  info.constants = constants.info();
  // }
  const Pipeline forward = gpu.make_pipeline(info);
  const VkSemaphore culling_done = gpu.make_semaphore();

  bool same = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    gpu.submit(
        gpu.compute,
        [&](VkCommandBuffer commands) {
          vkCmdFillBuffer(commands, count_buffer.handle, 0, VK_WHOLE_SIZE, 0);
          barrier(commands);
          bind(commands, make_lights, glm::uvec2(PARTICLES, frame));
          vkCmdDispatch(commands, (PARTICLES + 63) / 64, 1, 1);
          barrier(commands);
          // lamplight {
          value_of(culler.record(
              commands, {.view = &view, .lights = light_buffer.handle, .light_count_buffer = count_buffer.handle}));
          // }
          hand_over(commands, handed_over, gpu.compute, gpu.graphics);
        },
        VK_NULL_HANDLE, culling_done);
    gpu.submit(gpu.graphics, [&](VkCommandBuffer commands) {  // at the same time
      transition(commands, depth, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
      begin_rendering(commands, {.depth = depth});
      bind(commands, draw_depth, clip_from_world);
      vkCmdDraw(commands, 36, box_count, 0, 0);
      vkCmdEndRendering(commands);
    });
    gpu.submit(
        gpu.graphics,
        [&](VkCommandBuffer commands) {
          hand_over(commands, handed_over, gpu.compute, gpu.graphics);
          for (const auto& [pipeline, picture] : {std::pair(forward, culled), std::pair(brute_force, brute)}) {
            transition(commands, color, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
            begin_rendering(commands, {.colors = {color}, .depth = depth, .depth_load = VK_ATTACHMENT_LOAD_OP_LOAD});
            bind(commands, pipeline, clip_from_world);
            vkCmdDraw(commands, 36, box_count, 0, 0);
            vkCmdEndRendering(commands);
            read_back(commands, color, picture);
          }
        },
        culling_done);
    // The next frame's lights may be made once this one has read its own. Frames that overlap take a Culler each.
    gpu.wait();
    same = compare(culled.as<glm::vec4>(), brute.as<glm::vec4>(), 1e-4F) && same;
  }
  write_picture(options, SIZE.width, culled.as<glm::vec4>());
  return same && gpu.quiet();
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
