// Writes what the loader reads, and reads with the loader's own parts.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_light_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "error.h"
#include "files/read_json.h"
#include "scene/gltf_document.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_nodes.h"

namespace lamp::app {
namespace {

using nlohmann::json;

constexpr const char* EXTENSION = "KHR_lights_punctual";

/// What takes -Z to the direction.
glm::dquat rotation_to(const glm::dvec3& direction) {
  constexpr glm::dvec3 AHEAD(0.0, 0.0, -1.0);
  const glm::dvec3 unit = glm::normalize(direction);
  // Half the way of a turn is its quaternion; of half a turn there is no half way, and any axis across will do.
  const double real = 1.0 + glm::dot(AHEAD, unit);
  if (real < 1e-12) return {0.0, 0.0, 1.0, 0.0};
  return glm::normalize(glm::dquat(real, glm::cross(AHEAD, unit)));
}

/// Arrays that hold no object on one line each. Strings of JSON have no ends of lines: what they hold does no harm.
std::string with_short_arrays(std::string_view text) {
  std::string made;
  bool in_array = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (letter == '[') in_array = text.find_first_of("{[]", i + 1) == text.find(']', i + 1);
    if (letter == ']') in_array = false;
    if (!in_array || letter != '\n') {
      made += letter;
      continue;
    }
    while (i + 1 < text.size() && text[i + 1] == ' ') ++i;
    if (made.back() != '[' && text[i + 1] != ']') made += ' ';
  }
  return made;
}

json light_json(const Light& light, const std::string& name) {
  if (const std::string refused = gltf_refusal(light, name); !refused.empty()) throw Error(refused);
  const float above = std::max({1.0F, light.color.x, light.color.y, light.color.z});
  json made{{"name", name},
            {"type", light.type == LightType::spot ? "spot" : "point"},
            {"color", {light.color.x / above, light.color.y / above, light.color.z / above}},
            {"intensity", light.intensity * above}};
  if (light.range < shared::INFINITE_RADIUS) made["range"] = light.range;
  if (light.type != LightType::spot) return made;
  made["spot"] = {{"innerConeAngle", std::min(light.inner_angle, std::nextafter(light.outer_angle, 0.0F))},
                  {"outerConeAngle", std::min(double{light.outer_angle}, std::numbers::pi / 2.0)}};
  return made;
}

json node_json(const Light& light, std::size_t number, const std::string& name) {
  json made{{"name", name},
            {"translation", {light.position.x, light.position.y, light.position.z}},
            {"extensions", {{EXTENSION, {{"light", number}}}}}};
  if (light.type == LightType::spot) {
    const glm::dquat rotation = rotation_to(glm::dvec3(glm::vec3(light.direction)));
    made["rotation"] = {rotation.x, rotation.y, rotation.z, rotation.w};
  }
  return made;
}

}  // namespace

std::string gltf_refusal(const Light& light, const std::string& name) {
  if (light.range == 0.0F) return fmt::format("{}: range is 0, which glTF cannot say, expected one above 0 m", name);
  if (light.type == LightType::spot && light.outer_angle == 0.0F)
    return fmt::format("{}: its outer angle is 0, which glTF cannot say, expected one above 0", name);
  return "";
}

std::string gltf_text(std::span<const Light> lights, const std::string& name) {
  json made{{"asset", {{"version", "2.0"}, {"generator", "Lamplight"}}},
            {"extensionsUsed", {EXTENSION}},
            {"scene", 0},
            {"scenes", {{{"nodes", json::array()}}}},
            {"nodes", json::array()}};
  json& all = made["extensions"][EXTENSION]["lights"] = json::array();
  for (const Light& light : lights) {
    const std::size_t number = all.size();
    const std::string own = lights.size() == 1 ? name : fmt::format("{} {}", name, number);
    all.push_back(light_json(light, own));
    made["nodes"].push_back(node_json(light, number, own));
    made["scenes"][0]["nodes"].push_back(number);
  }
  return with_short_arrays(json_text(made, 2)) + "\n";
}

std::vector<Light> lights_of_gltf(std::string_view text, const std::string& name) {
  GltfDocument document = read_document(std::as_bytes(std::span(text)), {.file = name, .folder = {}});
  GltfLights found = read_lights(document, place_nodes(document));
  if (!found.directional_lights.empty())
    throw Error(fmt::format("{}: has a directional light, expected point and spot lights alone", name));
  if (const auto error = check_lights(found.lights)) throw Error(fmt::format("{}: {}", name, error->text()));
  return std::move(found.lights);
}

}  // namespace lamp::app
