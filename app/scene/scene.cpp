// What every source of scenes shares: the bounds of a scene, and those of its lights.
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace lamp::app {

Box bounds(const Scene& scene) {
  constexpr float INFINITE = std::numeric_limits<float>::infinity();
  Box box{glm::vec3(INFINITE), glm::vec3(-INFINITE)};
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t i = 0; i < mesh.index_count; ++i) {
      const std::uint32_t index = mesh.vertex_offset + scene.indices[mesh.first_index + i];
      const glm::vec3 position(instance.world_from_object * glm::vec4(scene.vertices[index].position, 1.0F));
      box.min = glm::min(box.min, position);
      box.max = glm::max(box.max, position);
    }
  }
  if (!(box.min.x <= box.max.x)) return {glm::vec3(-0.5F), glm::vec3(0.5F)};
  return box;
}

std::optional<lamp::Error> check_shown_lights(std::span<const Light> lights) {
  if (auto error = check_lights(lights)) return error;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const glm::vec3 power = glm::vec3(lights[i].color) * lights[i].intensity;
    const float most = std::max({power.r, power.g, power.b});
    if (most > LARGEST_INTENSITY)
      return lamp::Error{
          fmt::format("light {}", i),
          fmt::format("color times intensity must be at most {:g} candela, got {:g}", LARGEST_INTENSITY, most)};
  }
  return std::nullopt;
}

}  // namespace lamp::app
