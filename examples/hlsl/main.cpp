// Forward shading in HLSL, with Lamplight's 64-byte light records and a method that needs no depth: the least that an
// engine with HLSL shaders has to do. Three frames of moving lights, each compared with a picture from all lights.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/value_of.h>  // lamplight
#include <lamplight/vulkan.h>    // lamplight

#include <algorithm>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t BOX_SHADER[] = {
#include "boxes.vert.hlsl.inc"
};
constexpr std::uint32_t FORWARD[] = {
#include "forward.frag.hlsl.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.frag.hlsl.inc"
};

constexpr vk::Extent2D SIZE{320, 180};
constexpr std::uint32_t LIGHTS = 500;

/// Push constants, as in boxes.vert.hlsl and brute_force.frag.hlsl.
struct Push {
  glm::mat4 clip_from_world;
  std::uint32_t light_count;
};

// lamplight {
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
void draw(const Commands& commands, const Pipeline& pipeline, const Push& push, const Image& color, const Image& depth,
          const Buffer& to) {
  begin_rendering(commands, {.color = &color, .depth = depth, .clear_depth = 0.0F});
  bind(commands, pipeline, push);
  commands.draw(BOX_VERTICES, BOXES, 0, 0);
  commands.endRendering();
  read_back(commands, color, to);
}

bool run(const std::string& file) {
  Gpu gpu;
  const double aspect = double{SIZE.width} / SIZE.height;
  const glm::dmat4 clip_from_view = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  // The method is `clustered`, since none is named. mean_capacity=1 is little room, to show how it grows; by default
  // there is enough.
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(gpu.context.getDispatcher()->vkGetInstanceProcAddr,
                                                             *gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, *gpu.physical)) throw std::runtime_error(lack->text());
  const lamp::vulkan::RequiredFeatures features;
  gpu.make_device(features.base, lamp::vulkan::useful_extensions(instance, *gpu.physical));
  const auto device = value_of(lamp::vulkan::make_device(instance, *gpu.physical, *gpu.device));
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width, .height = SIZE.height, .light_capacity = LIGHTS, .options = {"mean_capacity=1"}}));
  const lamp::View view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, view_from_world()));
  // }

  const Push push{glm::mat4(clip_from_view * view_from_world()), LIGHTS};

  const Buffer light_buffer = gpu.make_buffer(LIGHTS * sizeof(Record));
  const Buffer culled = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height);
  const Buffer brute = gpu.make_buffer(culled.bytes.size());
  const Image color = gpu.make_image(COLOR, SIZE);
  const Image depth = gpu.make_image(DEPTH, SIZE);

  PipelineInfo info{
      .vertex = BOX_SHADER, .fragment = BRUTE_FORCE, .buffers = {{light_buffer.handle, 0, VK_WHOLE_SIZE}}};
  const Pipeline brute_force = gpu.make_pipeline(info);
  info.fragment = FORWARD;
  // lamplight {
  const lamp::vulkan::BoundLookUp lookup = culler.lookup();
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_FRAGMENT_BIT);
  info.constants = constants.info();
  // }
  const Pipeline forward = gpu.make_pipeline(info);
  // lamplight {
  lookup.write_to(device, *forward.set);
  // }

  bool same = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    std::ranges::copy(pack(make_lights(LIGHTS, frame)), light_buffer.as<Record>().begin());
    std::uint64_t number = 0;
    gpu.submit(gpu.graphics, [&](const Commands& commands) {
      // lamplight {
      number =
          value_of(culler.record(*commands, {.view = &view, .lights = light_buffer.handle, .light_count = LIGHTS}));
      // }
      draw(commands, forward, push, color, depth, culled);
      draw(commands, brute_force, push, color, depth, brute);
    });
    gpu.wait();
    // lamplight {
    if (value_of(culler.finish(number)) != lamp::vulkan::Growth::none) culler.lookup().write_to(device, *forward.set);
    // }
    same = compare(culled.as<glm::vec4>(), brute.as<glm::vec4>(), file, SIZE.width) && same;
  }
  return same;
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
