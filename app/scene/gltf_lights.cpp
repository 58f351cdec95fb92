// The lights that nodes of a glTF file carry.
// Based on: Khronos, KHR_lights_punctual.
// Promise: every light passes check_shown_lights.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>

#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

/// The light's place in the file's list, or nothing if the node has none.
std::optional<std::size_t> light_index(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  if (found == node.extensions.end()) return std::nullopt;
  return static_cast<std::size_t>(found->second.Get("light").GetNumberAsInt());
}

/// Whether a scale of 0 hides the light or leaves it no direction (-Z).
bool is_left_out(const tinygltf::Light& light, const PlacedNode& placed) {
  return light.type == "point" ? is_hidden(placed) : !axis_of(placed, 2);
}

glm::vec3 color_of(const tinygltf::Light& from) {
  return from.color.empty() ? glm::vec3(1.0F) : glm::vec3(from.color[0], from.color[1], from.color[2]);
}

/// Candela, or lux.
glm::vec3 power_of(const tinygltf::Light& from, const std::string& file, const std::string& element) {
  const glm::vec3 power = color_of(from) * static_cast<float>(from.intensity);
  const float most = std::max({power.r, power.g, power.b});  // infinite, it may be, of two finite numbers
  if (!(most <= LARGEST_INTENSITY)) {
    gltf_fail(file, element,
              fmt::format("color times intensity is {:g}, expected at most {:g}", most, LARGEST_INTENSITY));
  }
  return power;
}

void set_cone(const tinygltf::SpotLight& from, const std::string& file, const std::string& element, Light& light) {
  light.inner_angle = static_cast<float>(from.innerConeAngle);
  light.outer_angle = static_cast<float>(from.outerConeAngle);
  // Compared as floats: exporters write pi/2 rounded up.
  if (light.outer_angle > glm::half_pi<float>()) {
    gltf_fail(file, element, fmt::format("outerConeAngle is {}, expected 0 .. pi/2 radians", from.outerConeAngle));
  }
  if (light.inner_angle > light.outer_angle) {
    gltf_fail(file, element,
              fmt::format("innerConeAngle is {}, expected at most outerConeAngle, {}", from.innerConeAngle,
                          from.outerConeAngle));
  }
}

}  // namespace

GltfLights read_lights(GltfDocument& document, std::span<const PlacedNode> nodes) {
  GltfLights result;
  std::size_t hidden = 0;
  for (const PlacedNode& placed : nodes) {
    const auto index = light_index(document.model.nodes[static_cast<std::size_t>(placed.node)]);
    if (!index) continue;
    const tinygltf::Light& from = document.model.lights[*index];
    const std::string element = fmt::format("light {}", *index);
    const glm::vec3 power = power_of(from, document.origin.file, element);
    if (is_left_out(from, placed)) {
      ++hidden;
      continue;
    }
    const glm::vec3 forward(-axis_of(placed, 2).value_or(glm::dvec3(0.0)));
    if (from.type == "directional") {
      result.directional_lights.push_back({forward, power});
      continue;
    }
    Light light;
    light.type = from.type == "spot" ? LightType::spot : LightType::point;
    light.position = glm::vec3(placed.world_from_node[3]);
    light.color = color_of(from);
    light.intensity = static_cast<float>(from.intensity);
    // tinygltf says 0 where the file says nothing; the check refuses a 0 that is in the file.
    light.range = from.range > 0.0 ? static_cast<float>(from.range) : std::numeric_limits<float>::infinity();
    if (light.type == LightType::spot) {
      light.direction = forward;
      set_cone(from.spot, document.origin.file, element, light);
    }
    result.lights.push_back(light);
  }
  note_hidden(hidden, "lights", document.notes);
  return result;
}

}  // namespace lamp::app
