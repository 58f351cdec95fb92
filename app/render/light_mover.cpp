// One dispatch over the lights.
// SPDX-License-Identifier: Apache-2.0
#include "render/light_mover.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "lamplight/light.h"
#include "render/pass_uses.h"
#include "render/shaders/light_path_data.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP = 64;
constexpr std::uint32_t MOST_GROUPS = 65535;  // what every device has
constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

/// A light's sphere lies where it does around a light at the origin, shifted: one rounded sum, there and here.
gpu::LightPathData packed(const LightPath& path, shared::Light light) {
  light.position = {};
  const shared::LightSphere sphere = bounding_sphere(light);
  const bool stays = sphere.radius < 0.0F || light.range >= shared::INFINITE_RADIUS;
  const glm::uvec3 waves = path.waves - 1U;
  return {.middle = path.middle,
          .waves = waves.x | waves.y << 2U | waves.z << 4U | (stays ? gpu::PATH_SPHERE_STAYS : 0U),
          .amplitude = path.amplitude,
          .sine = path.sine,
          .cosine = path.cosine,
          .to_center = sphere.center};
}

std::vector<gpu::LightPathData> packed(std::span<const shared::Light> lights, std::span<const LightPath> paths,
                                       std::uint32_t first) {
  assert(first + paths.size() <= lights.size() && "a light for each path");
  std::vector<gpu::LightPathData> all(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) all[i] = packed(paths[i], lights[first + i]);
  return all;
}

}  // namespace

LightMover::LightMover(Context& context, const ShaderLibrary& shaders, std::span<const shared::Light> lights,
                       std::span<const LightPath> paths, std::uint32_t first)
    : first_(first),
      count_(static_cast<std::uint32_t>(paths.size())),
      paths_(upload_buffer(context, "light paths", bytes_of(packed(lights, paths, first)),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)),
      pipeline_(take(vulkan::Pipeline::compute(
          context.device(),
          {.name = "move_lights", .bindings = {{0}, {1}, {2}}, .push_constant_bytes = sizeof(gpu::MoveLights)},
          shaders.spirv("move_lights")))) {}

void LightMover::record(vulkan::Recorder& recorder, const FrameData& data, const PathTime& time) const {
  if (count_ == 0) return;
  const vulkan::Resource paths = vulkan::Resource::storage(paths_.handle());
  const auto writes = [](const vulkan::Resource& resource) {
    return vulkan::Use{.resource = resource, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
  };
  recorder.begin_pass("move lights", {reads(paths, COMPUTE), writes(data.lights()), writes(data.spheres())});
  recorder.bind(pipeline_, std::to_array<vulkan::Bound>({{0, paths}, {1, data.lights()}, {2, data.spheres()}}));
  const gpu::MoveLights moves{.sine = time.sine, .cosine = time.cosine, .first = first_, .count = count_};
  vkCmdPushConstants(recorder.commands(), pipeline_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(moves), &moves);
  vkCmdDispatch(recorder.commands(), std::min((count_ + GROUP - 1) / GROUP, MOST_GROUPS), 1, 1);
  recorder.end_pass();
}

}  // namespace lamp::app
