// Two eyes of a headset: both are drawn at once, by multiview, into layers of one image, and culled together, each with
// the depth of its layer. A compute shader shades an eye, and tells the look-up which.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/value_of.h>  // lamplight
#include <lamplight/vulkan.h>    // lamplight

#include <algorithm>
#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t BOX_SHADER[] = {
#include "boxes.vert.inc"
};
constexpr std::uint32_t SURFACE[] = {
#include "surface.frag.inc"
};
constexpr std::uint32_t SHADE[] = {
#include "shade.comp.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.comp.inc"
};

constexpr vk::Extent2D SIZE{200, 180};  // of an eye
constexpr std::uint32_t LIGHTS = 500;
constexpr std::uint32_t EYES = 2;
constexpr std::uint32_t BOTH_EYES = 0b11;

/// Push constants, as in eye.glsl.
struct ShadePush {
  glm::mat4 world_from_clip;
  glm::uvec2 size_px;
  std::uint32_t light_count;
  std::uint32_t eye;
};

struct Eye {
  glm::dmat4 clip_from_eye, eye_from_world;
  Buffer culled, brute_force;  ///< pictures
  Pipeline shade, shade_all;
};

/// One of each layer.
std::vector<vk::raii::ImageView> views_of_layers(const vk::raii::Device& device, const Image& image,
                                                 vk::Format format) {
  const auto aspect = format == DEPTH ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
  vk::ImageViewCreateInfo info{.image = *image.handle, .viewType = vk::ImageViewType::e2D, .format = format};
  std::vector<vk::raii::ImageView> views;
  for (std::uint32_t layer = 0; layer < EYES; ++layer)
    views.emplace_back(device, info.setSubresourceRange({aspect, 0, 1, layer, 1}));
  return views;
}

/// An eye sees more on its outer side. `side`: -1 the left, 1 the right one.
Eye make_eye(double side) {
  return {.clip_from_eye = reversed_projection(-0.6 + 0.1 * side, 0.6 + 0.1 * side, -0.55, 0.5),
          .eye_from_world = glm::translate(glm::dmat4(1.0), {-0.032 * side, 0, 0}) * view_from_world()};
}

void shade(const Commands& commands, const Pipeline& pipeline, const Eye& eye, std::uint32_t index) {
  const glm::mat4 world_from_clip = glm::inverse(eye.clip_from_eye * eye.eye_from_world);
  bind(commands, pipeline, ShadePush{world_from_clip, {SIZE.width, SIZE.height}, LIGHTS, index});
  commands.dispatch((SIZE.width + 7) / 8, (SIZE.height + 7) / 8, 1);
}

bool run(const std::string& file) {
  Gpu gpu;
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(gpu.context.getDispatcher()->vkGetInstanceProcAddr,
                                                             *gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, *gpu.physical)) throw std::runtime_error(lack->text());
  lamp::vulkan::RequiredFeatures features;
  // }
  VkPhysicalDeviceMultiviewFeatures multiview{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES,
                                              .pNext = features.base.pNext,
                                              .multiview = VK_TRUE};
  features.base.pNext = &multiview;
  gpu.make_device(features.base);

  const Buffer light_buffer = gpu.make_buffer(LIGHTS * sizeof(HostLight));
  const Image surfaces = gpu.make_image(COLOR, SIZE, vk::SampleCountFlagBits::e1, EYES);
  const Image depths = gpu.make_image(DEPTH, SIZE, vk::SampleCountFlagBits::e1, EYES);
  const auto surface_views = views_of_layers(gpu.device, surfaces, COLOR);
  const auto depth_views = views_of_layers(gpu.device, depths, DEPTH);
  const Pipeline draw = gpu.make_pipeline({.vertex = BOX_SHADER, .fragment = SURFACE, .view_mask = BOTH_EYES});

  // lamplight {
  auto device = value_of(lamp::vulkan::make_device(instance, *gpu.physical, *gpu.device));
  lamp::vulkan::PipelineStore store;
  device.pipelines = &store;
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width,
               .height = SIZE.height,
               .views = EYES,
               .light_capacity = LIGHTS,
               .method = "tight",
               .light_layout = lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, position),
                                                              offsetof(HostLight, direction))}));
  const lamp::vulkan::BoundLookUp lookup = culler.lookup();
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  std::vector<lamp::View> cameras;
  std::vector<lamp::vulkan::CullerView> views;
  // }
  constexpr auto GENERAL = vk::ImageLayout::eGeneral;
  std::array eyes{make_eye(-1), make_eye(1)};
  for (std::uint32_t i = 0; i < EYES; ++i) {
    Eye& eye = eyes[i];
    eye.culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height);
    eye.brute_force = gpu.make_buffer(eye.culled.bytes.size());
    PipelineInfo info{.compute = BRUTE_FORCE,
                      .images = {{{}, *surface_views[i], GENERAL}, {{}, *depth_views[i], GENERAL}},
                      .buffers = {{light_buffer.handle, 0, VK_WHOLE_SIZE}, {eye.brute_force.handle, 0, VK_WHOLE_SIZE}}};
    eye.shade_all = gpu.make_pipeline(info);
    info.compute = SHADE;
    info.buffers[1].buffer = eye.culled.handle;
    // lamplight {
    cameras.push_back(value_of(lamp::View::create(SIZE.width, SIZE.height, eye.clip_from_eye, eye.eye_from_world)));
    info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_COMPUTE_BIT);
    info.constants = constants.info();
    // }
    eye.shade = gpu.make_pipeline(info);
    lookup.write_to(device, *eye.shade.set);  // lamplight
  }
  // lamplight {
  for (std::uint32_t i = 0; i < EYES; ++i)
    views.push_back({&cameras[i], *depths.handle, *depth_views[i], VK_IMAGE_LAYOUT_GENERAL});
  // }
  const std::array<glm::mat4, EYES> clip_from_world{eyes[0].clip_from_eye * eyes[0].eye_from_world,
                                                    eyes[1].clip_from_eye * eyes[1].eye_from_world};

  bool same = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    std::ranges::copy(make_lights(LIGHTS, frame), light_buffer.as<HostLight>().begin());
    gpu.submit(gpu.graphics, [&](const Commands& commands) {
      begin_rendering(commands, {.color = &surfaces, .depth = depths, .clear_depth = 0.0F, .view_mask = BOTH_EYES});
      bind(commands, draw, clip_from_world);
      commands.draw(BOX_VERTICES, BOXES + 1, 0, 0);
      commands.endRendering();
      barrier(commands);
      // lamplight {
      value_of(culler.record(
          *commands,
          {.lights = light_buffer.handle, .cones = light_buffer.handle, .light_count = LIGHTS, .views = views}));
      // }
      for (std::uint32_t i = 0; i < EYES; ++i) {
        shade(commands, eyes[i].shade, eyes[i], i);
        shade(commands, eyes[i].shade_all, eyes[i], i);
      }
    });
    gpu.wait();
    for (const Eye& eye : eyes)
      same = compare(eye.culled.as<glm::vec4>(), eye.brute_force.as<glm::vec4>(), file, SIZE.width) && same;
  }
  return same;
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
