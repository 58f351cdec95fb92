// Counts in the JSON, before anything is made of it.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "files/printable.h"
#include "scene/gltf_rules.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// Attributes whose names begin with _ are for applications; joints without a skin mean nothing.
bool is_left_out(std::string_view attribute) {
  constexpr auto READ =
      std::to_array<std::string_view>({"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"});
  return std::ranges::find(READ, attribute) == READ.end() && !attribute.starts_with("JOINTS_") &&
         !attribute.starts_with("WEIGHTS_") && !attribute.starts_with('_');
}

void note_primitives(const json& document, std::vector<std::string>& notes) {
  std::size_t morphed = 0;
  std::size_t more = 0;
  std::set<std::string> names;
  for (const json& mesh : gltf_array(document, "meshes"))
    for (const json& primitive : mesh["primitives"]) {
      if (primitive.contains("targets")) ++morphed;
      bool has_more = false;
      for (const auto& [name, accessor] : primitive["attributes"].items()) {
        if (!is_left_out(name)) continue;
        has_more = true;
        names.insert(name);
      }
      if (has_more) ++more;
    }
  if (morphed > 0) notes.push_back(fmt::format("morph targets of {} primitives left out", morphed));
  if (more > 0)
    notes.push_back(one_line(fmt::format("attributes of {} primitives left out: {}", more, fmt::join(names, ", "))));
}

bool any_above_one(const json& object, const char* numbers) {
  const auto found = object.find(numbers);
  return found != object.end() &&
         std::any_of(found->begin(), found->end(), [](const json& number) { return number.get<double>() > 1.0; });
}

/// Compared as floats, which is what becomes of them.
bool is_hard_cone(const json& light) {
  if (light["type"] != "spot") return false;
  const auto angle = [&light](const char* key, double missing) {
    return static_cast<float>(light["spot"].value(key, missing));
  };
  return angle("innerConeAngle", 0.0) == angle("outerConeAngle", glm::quarter_pi<double>());
}

/// Whether columns of the matrix are not at right angles, but for the digits of a file.
bool shears(const json& node) {
  const auto matrix = node.find("matrix");
  if (matrix == node.end()) return false;
  const auto column = [&](std::size_t i) {
    return glm::dvec3((*matrix)[4 * i].get<double>(), (*matrix)[4 * i + 1].get<double>(),
                      (*matrix)[4 * i + 2].get<double>());
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 a = column(i);
    const glm::dvec3 b = column((i + 1) % 3);
    if (std::abs(glm::dot(a, b)) > 1e-3 * glm::length(a) * glm::length(b)) return true;
  }
  return false;
}

/// Of those in buffers, which have no other name of a type.
bool lacks_type(const json& image) {
  const std::string type = image.value("mimeType", "");
  if (type.empty()) return image.contains("bufferView");
  return type != "image/png" && type != "image/jpeg";
}

/// Images of a type that an extension brings are no source of a texture by themselves.
std::size_t sources_without_type(const json& document) {
  std::set<std::size_t> images;
  for (const json& texture : gltf_array(document, "textures"))
    if (const auto source = texture.find("source"); source != texture.end()) images.insert(source->get<std::size_t>());
  const json& all = gltf_array(document, "images");
  return static_cast<std::size_t>(
      std::ranges::count_if(images, [&](std::size_t image) { return lacks_type(all[image]); }));
}

template <class Test>
std::size_t count_of(const json& array, const Test& test) {
  return static_cast<std::size_t>(std::count_if(array.begin(), array.end(), test));
}

}  // namespace

void note_left_out(const json& document, std::vector<std::string>& notes) {
  if (const std::size_t count = gltf_array(document, "animations").size(); count > 0)
    notes.push_back(fmt::format("{} animations left out: the scene stands still", count));
  if (const std::size_t count = gltf_array(document, "scenes").size(); count > 1)
    notes.push_back(fmt::format("{} scenes left out: scene {} is shown", count - 1, document.value("scene", 0)));
  note_primitives(document, notes);
}

void note_allowed(const json& document, std::vector<std::string>& notes) {
  const auto note = [&notes](std::size_t count, std::string_view what) {
    if (count > 0) notes.push_back(fmt::format("against glTF, but read: {} {}", count, what));
  };
  static const json NONE = json::array();
  const json::json_pointer punctual("/extensions/KHR_lights_punctual/lights");
  const json& lights = document.contains(punctual) ? document[punctual] : NONE;
  note(count_of(gltf_array(document, "materials"),
                [](const json& material) { return any_above_one(material, "emissiveFactor"); }),
       "materials with an emissiveFactor above 1");
  note(count_of(lights, [](const json& light) { return any_above_one(light, "color"); }),
       "lights with a color above 1");
  note(count_of(lights, is_hard_cone), "spots whose innerConeAngle is their outerConeAngle");
  note(count_of(gltf_array(document, "nodes"), shears), "nodes with a matrix that shears");
  note(sources_without_type(document), "images whose mimeType is missing or unknown");
}

}  // namespace lamp::app
