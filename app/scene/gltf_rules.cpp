// What a value of a glTF document must be, as data: one rule for each value that the loader reads.
// Based on: Khronos, glTF 2.0 specification and its JSON schemas; KHR_lights_punctual; KHR_texture_transform;
// KHR_materials_emissive_strength.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_rules.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "files/json_rules.h"
#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

using nlohmann::json;

// Bounds on elements: far above real scenes, low enough that `{},{},{}...` cannot exhaust memory.
constexpr std::size_t MANY = 1 << 18;
constexpr std::size_t SOME = 1 << 16;

constexpr std::size_t NAME_BYTES = 4096;  // a camera's may be taken by every node

constexpr double POSITIVE = std::numeric_limits<float>::min();
constexpr double BYTES_MAX = 9007199254740992.0;  // 2^53: sums of a few of these stay within 64 bits
constexpr double INT_LIMIT = std::numeric_limits<std::int32_t>::max();
constexpr double UINT_LIMIT = std::numeric_limits<std::uint32_t>::max();

constexpr std::string_view LIGHTS = "extensions/KHR_lights_punctual/lights";
constexpr std::string_view LIGHT = "extensions/KHR_lights_punctual/lights/*";
constexpr std::string_view PRIMITIVE = "meshes/*/primitives/*";
constexpr std::string_view PBR = "materials/*/pbrMetallicRoughness";

constexpr auto RULES = std::to_array<Rule>({
    {.key = "asset", .want = Want::object, .required = true},
    {.at = "asset", .key = "version", .want = Want::text, .required = true},
    {.at = "asset", .key = "minVersion", .want = Want::text, .words = "2.0"},
    {.key = "extensionsUsed", .want = Want::texts},
    {.key = "extensionsRequired", .want = Want::texts},
    {.key = "extensions", .want = Want::object},
    {.key = "accessors", .want = Want::objects, .size = MANY},
    {.key = "bufferViews", .want = Want::objects, .size = MANY},
    {.key = "buffers", .want = Want::objects, .size = SOME},
    {.key = "cameras", .want = Want::objects, .size = SOME},
    {.key = "images", .want = Want::objects, .size = SOME},
    {.key = "materials", .want = Want::objects, .size = SOME},
    {.key = "meshes", .want = Want::objects, .size = MANY},
    {.key = "nodes", .want = Want::objects, .size = MANY},
    {.key = "samplers", .want = Want::objects, .size = SOME},
    {.key = "scenes", .want = Want::objects, .size = SOME},
    {.key = "skins", .want = Want::objects, .size = SOME},
    {.key = "textures", .want = Want::objects, .size = SOME},
    {.key = "scene", .want = Want::index, .into = "scenes"},

    {.at = "buffers/*", .key = "byteLength", .want = Want::natural, .required = true, .min = 1, .max = UINT_LIMIT},
    {.at = "buffers/*", .key = "uri", .want = Want::text},
    {.at = "bufferViews/*", .key = "buffer", .want = Want::index, .required = true, .into = "buffers"},
    {.at = "bufferViews/*", .key = "byteOffset", .want = Want::natural, .min = 0, .max = BYTES_MAX},
    {.at = "bufferViews/*", .key = "byteLength", .want = Want::natural, .required = true, .min = 1, .max = BYTES_MAX},
    {.at = "bufferViews/*", .key = "byteStride", .want = Want::natural, .min = 4, .max = 252, .step = 4},

    {.at = "accessors/*", .key = "bufferView", .want = Want::index, .into = "bufferViews"},
    {.at = "accessors/*", .key = "byteOffset", .want = Want::natural, .min = 0, .max = BYTES_MAX},
    {.at = "accessors/*",
     .key = "componentType",
     .want = Want::natural,
     .required = true,
     .words = "5120, 5121, 5122, 5123, 5125, 5126"},
    {.at = "accessors/*", .key = "normalized", .want = Want::flag},
    {.at = "accessors/*", .key = "count", .want = Want::natural, .required = true, .min = 1, .max = UINT_LIMIT},
    {.at = "accessors/*",
     .key = "type",
     .want = Want::text,
     .required = true,
     .words = "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4"},
    {.at = "accessors/*", .key = "sparse", .want = Want::object},
    {.at = "accessors/*/sparse", .key = "count", .want = Want::natural, .required = true, .min = 1, .max = INT_LIMIT},
    {.at = "accessors/*/sparse", .key = "indices", .want = Want::object, .required = true},
    {.at = "accessors/*/sparse", .key = "values", .want = Want::object, .required = true},
    {.at = "accessors/*/sparse/indices",
     .key = "bufferView",
     .want = Want::index,
     .required = true,
     .into = "bufferViews"},
    {.at = "accessors/*/sparse/indices", .key = "byteOffset", .want = Want::natural, .min = 0, .max = INT_LIMIT},
    {.at = "accessors/*/sparse/indices",
     .key = "componentType",
     .want = Want::natural,
     .required = true,
     .words = "5121, 5123, 5125"},
    {.at = "accessors/*/sparse/values",
     .key = "bufferView",
     .want = Want::index,
     .required = true,
     .into = "bufferViews"},
    {.at = "accessors/*/sparse/values", .key = "byteOffset", .want = Want::natural, .min = 0, .max = INT_LIMIT},

    {.at = "images/*", .key = "uri", .want = Want::text},
    {.at = "images/*", .key = "bufferView", .want = Want::index, .into = "bufferViews"},
    {.at = "images/*", .key = "mimeType", .want = Want::text},
    {.at = "images/*", .key = "name", .want = Want::text, .size = NAME_BYTES},
    {.at = "samplers/*", .key = "magFilter", .want = Want::natural, .words = "9728, 9729"},
    {.at = "samplers/*", .key = "minFilter", .want = Want::natural, .words = "9728, 9729, 9984, 9985, 9986, 9987"},
    {.at = "samplers/*", .key = "wrapS", .want = Want::natural, .words = "10497, 33071, 33648"},
    {.at = "samplers/*", .key = "wrapT", .want = Want::natural, .words = "10497, 33071, 33648"},
    {.at = "textures/*", .key = "sampler", .want = Want::index, .into = "samplers"},
    {.at = "textures/*", .key = "source", .want = Want::index, .into = "images"},

    {.at = "materials/*", .key = "name", .want = Want::text, .size = NAME_BYTES},
    {.at = "materials/*", .key = "extensions", .want = Want::object},
    {.at = "materials/*", .key = "emissiveFactor", .want = Want::numbers, .min = 0, .size = 3},
    {.at = "materials/*", .key = "alphaMode", .want = Want::text, .words = "OPAQUE, MASK, BLEND"},
    {.at = "materials/*", .key = "alphaCutoff", .want = Want::number, .min = 0},
    {.at = "materials/*", .key = "doubleSided", .want = Want::flag},
    {.at = "materials/*", .key = "pbrMetallicRoughness", .want = Want::object},
    {.at = PBR, .key = "baseColorFactor", .want = Want::numbers, .min = 0, .max = 1, .size = 4},
    {.at = PBR, .key = "metallicFactor", .want = Want::number, .min = 0, .max = 1},
    {.at = PBR, .key = "roughnessFactor", .want = Want::number, .min = 0, .max = 1},
    {.at = PBR, .key = "baseColorTexture", .want = Want::object},
    {.at = PBR, .key = "metallicRoughnessTexture", .want = Want::object},
    {.at = "materials/*", .key = "normalTexture", .want = Want::object},
    {.at = "materials/*/normalTexture", .key = "scale", .want = Want::number},
    {.at = "materials/*", .key = "occlusionTexture", .want = Want::object},
    {.at = "materials/*/occlusionTexture", .key = "strength", .want = Want::number, .min = 0, .max = 1},
    {.at = "materials/*", .key = "emissiveTexture", .want = Want::object},
    {.at = "materials/*/extensions", .key = "KHR_materials_emissive_strength", .want = Want::object},
    {.at = "materials/*/extensions/KHR_materials_emissive_strength",
     .key = "emissiveStrength",
     .want = Want::number,
     .min = 0},

    {.at = "meshes/*", .key = "name", .want = Want::text, .size = NAME_BYTES},
    {.at = "meshes/*", .key = "primitives", .want = Want::objects, .required = true, .size = MANY},
    {.at = PRIMITIVE, .key = "attributes", .want = Want::named_indices, .required = true, .into = "accessors"},
    {.at = PRIMITIVE, .key = "indices", .want = Want::index, .into = "accessors"},
    {.at = PRIMITIVE, .key = "material", .want = Want::index, .into = "materials"},
    {.at = PRIMITIVE, .key = "mode", .want = Want::natural, .words = "0, 1, 2, 3, 4, 5, 6"},

    {.at = "extensions", .key = "KHR_lights_punctual", .want = Want::object},
    {.at = "extensions/KHR_lights_punctual", .key = "lights", .want = Want::objects, .required = true, .size = MANY},
    {.at = LIGHT, .key = "type", .want = Want::text, .required = true, .words = "point, spot, directional"},
    {.at = LIGHT, .key = "name", .want = Want::text, .size = NAME_BYTES},
    {.at = LIGHT, .key = "color", .want = Want::numbers, .min = 0, .size = 3},
    {.at = LIGHT, .key = "intensity", .want = Want::number, .min = 0},
    {.at = LIGHT, .key = "range", .want = Want::number, .min = POSITIVE},
    {.at = LIGHT, .key = "spot", .want = Want::object, .required = true, .when = "spot"},
    {.at = "extensions/KHR_lights_punctual/lights/*/spot", .key = "innerConeAngle", .want = Want::number, .min = 0},
    {.at = "extensions/KHR_lights_punctual/lights/*/spot",
     .key = "outerConeAngle",
     .want = Want::number,
     .min = POSITIVE},

    {.at = "cameras/*", .key = "type", .want = Want::text, .required = true, .words = "perspective, orthographic"},
    {.at = "cameras/*", .key = "name", .want = Want::text, .size = NAME_BYTES},
    {.at = "cameras/*", .key = "perspective", .want = Want::object, .required = true, .when = "perspective"},
    {.at = "cameras/*/perspective", .key = "yfov", .want = Want::number, .required = true, .min = POSITIVE},
    {.at = "cameras/*/perspective", .key = "znear", .want = Want::number, .required = true, .min = POSITIVE},
    {.at = "cameras/*/perspective", .key = "aspectRatio", .want = Want::number, .min = POSITIVE},
    {.at = "cameras/*/perspective", .key = "zfar", .want = Want::number, .min = POSITIVE},
    {.at = "cameras/*", .key = "orthographic", .want = Want::object, .required = true, .when = "orthographic"},
    {.at = "cameras/*/orthographic", .key = "xmag", .want = Want::number, .required = true, .min = POSITIVE},
    {.at = "cameras/*/orthographic", .key = "ymag", .want = Want::number, .required = true, .min = POSITIVE},
    {.at = "cameras/*/orthographic", .key = "znear", .want = Want::number, .required = true, .min = 0},
    {.at = "cameras/*/orthographic", .key = "zfar", .want = Want::number, .required = true, .min = POSITIVE},

    {.at = "nodes/*", .key = "name", .want = Want::text, .size = NAME_BYTES},
    {.at = "nodes/*", .key = "camera", .want = Want::index, .into = "cameras"},
    {.at = "nodes/*", .key = "mesh", .want = Want::index, .into = "meshes"},
    {.at = "nodes/*", .key = "skin", .want = Want::index, .into = "skins"},
    {.at = "nodes/*", .key = "children", .want = Want::indices, .into = "nodes"},
    {.at = "nodes/*", .key = "matrix", .want = Want::numbers, .size = 16},
    {.at = "nodes/*", .key = "translation", .want = Want::numbers, .size = 3},
    {.at = "nodes/*", .key = "rotation", .want = Want::numbers, .size = 4},
    {.at = "nodes/*", .key = "scale", .want = Want::numbers, .size = 3},
    {.at = "nodes/*", .key = "extensions", .want = Want::object},
    {.at = "nodes/*/extensions", .key = "KHR_lights_punctual", .want = Want::object},
    {.at = "nodes/*/extensions/KHR_lights_punctual",
     .key = "light",
     .want = Want::index,
     .required = true,
     .into = LIGHTS},
    {.at = "skins/*", .key = "joints", .want = Want::indices, .required = true, .into = "nodes"},
    {.at = "skins/*", .key = "inverseBindMatrices", .want = Want::index, .into = "accessors"},
    {.at = "scenes/*", .key = "nodes", .want = Want::indices, .into = "nodes"},
});

constexpr std::string_view TRANSFORM = "extensions/KHR_texture_transform";

constexpr auto TEXTURE_RULES = std::to_array<Rule>({
    {.key = "index", .want = Want::index, .required = true, .into = "textures"},
    {.key = "texCoord", .want = Want::natural, .min = 0, .max = INT_LIMIT},
    {.key = "extensions", .want = Want::object},
    {.at = "extensions", .key = "KHR_texture_transform", .want = Want::object},
    {.at = TRANSFORM, .key = "offset", .want = Want::numbers, .size = 2},
    {.at = TRANSFORM, .key = "rotation", .want = Want::number},
    {.at = TRANSFORM, .key = "scale", .want = Want::numbers, .size = 2},
    {.at = TRANSFORM, .key = "texCoord", .want = Want::natural, .min = 0, .max = INT_LIMIT},
});

constexpr auto TEXTURE_PLACES = std::to_array<std::string_view>({
    "materials/*/pbrMetallicRoughness/baseColorTexture",
    "materials/*/pbrMetallicRoughness/metallicRoughnessTexture",
    "materials/*/normalTexture",
    "materials/*/occlusionTexture",
    "materials/*/emissiveTexture",
});

/// What the format forbids, and a reader would have to guess about.
void check_pairs(const json& document, const std::string& file) {
  std::size_t number = 0;
  for (const json& node : gltf_array(document, "nodes")) {
    const std::string element = fmt::format("node {}", number++);
    for (const char* part : {"translation", "rotation", "scale"})
      if (node.contains("matrix") && node.contains(part))
        gltf_fail(file, element, fmt::format("has a matrix and a {}, expected one of them", part));
  }
}

/// Arrays that must hold something, of every element of an array.
void check_filled(const json& document, const std::string& file, const char* array, const char* element,
                  const char* member) {
  std::size_t number = 0;
  for (const json& of : gltf_array(document, array)) {
    if (of[member].empty())
      gltf_fail(file, fmt::format("{} {}", element, number), fmt::format("has no {}, expected one or more", member));
    ++number;
  }
}

}  // namespace

void check_gltf(const json& document, const std::string& file) {
  check_rules(document, RULES, file);
  for (const std::string_view place : TEXTURE_PLACES) check_rules(document, TEXTURE_RULES, file, place);
  check_pairs(document, file);
  check_filled(document, file, "meshes", "mesh", "primitives");
  check_filled(document, file, "skins", "skin", "joints");
}

const json& gltf_array(const json& document, const char* array) {
  static const json NONE = json::array();
  const auto found = document.find(array);
  return found == document.end() ? NONE : *found;
}

}  // namespace lamp::app
