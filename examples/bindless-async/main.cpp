// Lights that the GPU makes and counts, culled on a queue of its own while the graphics queue draws depth; then forward
// shading with materials in an array of textures. Where the device has no queue for compute alone, all runs on one.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/value_of.h>  // lamplight
#include <lamplight/vulkan.h>    // lamplight

#include <cstdio>
#include <stdexcept>
#include <string>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t MAKE_LIGHTS[] = {
#include "make_lights.comp.inc"
};
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
constexpr std::uint32_t PARTICLES = 750;  // of which the GPU makes some lights

/// Of queues for compute alone; if there is none, that of the graphics queue.
std::uint32_t compute_family(const Gpu& gpu) {
  constexpr vk::QueueFlags BOTH = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
  const std::vector<vk::QueueFamilyProperties> families = gpu.physical.getQueueFamilyProperties();
  for (std::uint32_t family = 0; family < families.size(); ++family)
    if ((families[family].queueFlags & BOTH) == vk::QueueFlagBits::eCompute) return family;
  return gpu.graphics;
}

/// Hands buffers from one queue to the other: record it on the first when it is done with them, then on the second
/// before it begins. Queues of one family need no such thing.
void hand_over(const Commands& commands, std::span<const vk::Buffer> buffers, std::uint32_t from, std::uint32_t to) {
  if (from == to) return;
  std::vector<vk::BufferMemoryBarrier> barriers;
  for (const vk::Buffer buffer : buffers)
    barriers.push_back({.srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
                        .dstAccessMask = vk::AccessFlagBits::eMemoryRead,
                        .srcQueueFamilyIndex = from,
                        .dstQueueFamilyIndex = to,
                        .buffer = buffer,
                        .size = VK_WHOLE_SIZE});
  constexpr auto ALL = vk::PipelineStageFlagBits::eAllCommands;
  commands.pipelineBarrier(ALL, ALL, {}, {}, barriers, {});
}

/// Textures of 8 x 8 texels, one a material: stripes and checks of its colour.
std::vector<Image> make_materials(Gpu& gpu) {
  constexpr vk::Extent2D TEXELS{8, 8};
  std::vector<Image> materials;
  for (std::uint32_t material = 0; material < 5; ++material) {
    const Buffer texels = gpu.make_buffer(sizeof(glm::vec4) * TEXELS.width * TEXELS.height);
    for (std::uint32_t i = 0; i < TEXELS.width * TEXELS.height; ++i) {
      const bool dark = ((i % 8 >> material / 2) + (i / 8 >> material % 2 * 2)) % 2 != 0;
      for (std::uint32_t channel = 0; channel < 4; ++channel)
        texels.as<float>()[4 * i + channel] = dark ? 0.2F : material % 4 == channel ? 0.9F : 0.6F;
    }
    const Image& image = materials.emplace_back(gpu.make_image(COLOR, TEXELS));
    gpu.submit(gpu.graphics, [&](const Commands& commands) {
      const vk::BufferImageCopy all{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                    .imageExtent = {8, 8, 1}};
      commands.copyBufferToImage(texels.handle, *image.handle, vk::ImageLayout::eGeneral, all);
    });
    gpu.wait();
  }
  return materials;
}

bool run(const std::string& file) {
  Gpu gpu;
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(gpu.context.getDispatcher()->vkGetInstanceProcAddr,
                                                             *gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, *gpu.physical)) throw std::runtime_error(lack->text());
  lamp::vulkan::RequiredFeatures features;
  // }
  features.vulkan12.descriptorIndexing = VK_TRUE;
  features.vulkan12.runtimeDescriptorArray = VK_TRUE;
  features.vulkan12.shaderSampledImageArrayNonUniformIndexing = VK_TRUE;
  gpu.make_device(features.base);
  const std::uint32_t compute = compute_family(gpu);
  std::printf("culls on %s\n", compute == gpu.graphics ? "the graphics queue" : "a queue of its own");
  const double aspect = double{SIZE.width} / SIZE.height;
  const glm::dmat4 clip_from_view = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  const glm::mat4 clip_from_world = clip_from_view * view_from_world();

  // lamplight {
  const auto device = value_of(lamp::vulkan::make_device(instance, *gpu.physical, *gpu.device));
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

  const Buffer light_buffer = gpu.make_buffer(PARTICLES * sizeof(HostLight));
  const Buffer count_buffer = gpu.make_buffer(sizeof(std::uint32_t));
  const Buffer culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height);
  const Buffer brute = gpu.make_buffer(culled.bytes.size());
  const Image color = gpu.make_image(COLOR, SIZE);
  const Image depth = gpu.make_image(DEPTH, SIZE);

  const std::vector<vk::DescriptorBufferInfo> lights_and_count{{light_buffer.handle, 0, VK_WHOLE_SIZE},
                                                               {count_buffer.handle, 0, VK_WHOLE_SIZE}};
  const Pipeline make_lights = gpu.make_pipeline({.compute = MAKE_LIGHTS, .buffers = lights_and_count});
  const Pipeline draw_depth = gpu.make_pipeline({.vertex = BOX_SHADER});
  const std::vector<Image> materials = make_materials(gpu);
  PipelineInfo info{.vertex = BOX_SHADER,
                    .fragment = BRUTE_FORCE,
                    .buffers = lights_and_count,
                    .depth_compare = vk::CompareOp::eEqual};
  for (const Image& material : materials) info.images.push_back({{}, *material.view, vk::ImageLayout::eGeneral});
  const Pipeline brute_force = gpu.make_pipeline(info);
  info.fragment = FORWARD;
  std::vector<vk::Buffer> handed_over{light_buffer.handle, count_buffer.handle};
  // lamplight {
  for (const auto& bound : lookup.resources) handed_over.emplace_back(bound.resource.buffer);
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_FRAGMENT_BIT);
  info.constants = constants.info();
  // }
  const Pipeline forward = gpu.make_pipeline(info);
  lookup.write_to(device, *forward.set);  // lamplight
  const vk::raii::Semaphore culling_done(gpu.device, vk::SemaphoreCreateInfo{});
  constexpr vk::PipelineStageFlags WAITING = vk::PipelineStageFlagBits::eAllCommands;

  bool same = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    gpu.submit(
        compute,
        [&](const Commands& commands) {
          commands.fillBuffer(count_buffer.handle, 0, VK_WHOLE_SIZE, 0);
          barrier(commands);
          bind(commands, make_lights, glm::uvec2(PARTICLES, frame));
          commands.dispatch((PARTICLES + 63) / 64, 1, 1);
          barrier(commands);
          // lamplight {
          value_of(culler.record(
              *commands, {.view = &view, .lights = light_buffer.handle, .light_count_buffer = count_buffer.handle}));
          // }
          hand_over(commands, handed_over, compute, gpu.graphics);
        },
        vk::SubmitInfo{}.setSignalSemaphores(*culling_done));
    gpu.submit(gpu.graphics, [&](const Commands& commands) {  // at the same time
      begin_rendering(commands, {.color = &color, .depth = depth, .clear_depth = 0.0F});
      bind(commands, draw_depth, clip_from_world);
      commands.draw(BOX_VERTICES, BOXES, 0, 0);
      commands.endRendering();
    });
    gpu.submit(
        gpu.graphics,
        [&](const Commands& commands) {
          hand_over(commands, handed_over, compute, gpu.graphics);
          for (const auto& [pipeline, to] : {std::pair(&forward, &culled), std::pair(&brute_force, &brute)}) {
            begin_rendering(commands, {.color = &color, .depth = depth});
            bind(commands, *pipeline, clip_from_world);
            commands.draw(BOX_VERTICES, BOXES, 0, 0);
            commands.endRendering();
            read_back(commands, color, *to);
          }
        },
        vk::SubmitInfo{}.setWaitSemaphores(*culling_done).setWaitDstStageMask(WAITING));
    // The next frame's lights may be made once this one has read its own. Frames that overlap take a Culler each.
    gpu.wait();
    same = compare(culled.as<glm::vec4>(), brute.as<glm::vec4>(), file, SIZE.width) && same;
  }
  return same;
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
