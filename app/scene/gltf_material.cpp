// Materials of a glTF file, and which images they need in which colour space.
// Based on: Khronos, glTF 2.0 specification, section 3.9; KHR_materials_emissive_strength; KHR_texture_transform.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "scene/captured_frame.h"
#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

Wrap to_wrap(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
  return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? Wrap::clamp : Wrap::repeat;
}

/// Numbers of an extension's array, which the check has found to be `count` of them, or the fallback.
glm::vec2 vec2_of(const tinygltf::Value& extension, const char* key, glm::vec2 fallback) {
  if (!extension.Has(key)) return fallback;
  const tinygltf::Value& array = extension.Get(key);
  return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

/// `Info` is one of tinygltf's three kinds of texture info.
template <class Info>
void read_coordinates(const Info& info, Texture& texture) {
  texture.uv = static_cast<std::uint32_t>(info.texCoord);
  const auto found = info.extensions.find("KHR_texture_transform");
  if (found == info.extensions.end()) return;
  const tinygltf::Value& transform = found->second;
  texture.offset = vec2_of(transform, "offset", texture.offset);
  texture.scale = vec2_of(transform, "scale", texture.scale);
  if (transform.Has("rotation")) texture.rotation = static_cast<float>(transform.Get("rotation").GetNumberAsDouble());
  if (transform.Has("texCoord")) texture.uv = static_cast<std::uint32_t>(transform.Get("texCoord").GetNumberAsInt());
}

/// Reads textures and gives each pair of image and colour space its place.
struct TextureReader {
  GltfDocument& document;
  std::vector<GltfImageUse>& images;
  std::map<std::pair<int, bool>, std::int32_t> places;
  std::set<int> without_image;  ///< textures
  std::set<int> other_filters;  ///< samplers
  std::size_t without_set = 0;  ///< uses whose coordinates a vertex has no place for

  std::int32_t place(int image, bool srgb) {
    const auto [found, added] = places.try_emplace({image, srgb}, static_cast<std::int32_t>(images.size()));
    if (added) images.push_back({image, srgb});
    return found->second;
  }

  template <class Info>
  Texture read(const Info& info, bool srgb) {
    Texture texture;
    if (info.index < 0) return texture;
    const tinygltf::Texture& from = document.model.textures[static_cast<std::size_t>(info.index)];
    if (from.source < 0) {
      without_image.insert(info.index);
      return texture;
    }
    read_coordinates(info, texture);
    if (texture.uv >= Vertex{}.uv.size()) {
      ++without_set;
      return {};
    }
    texture.image = place(document.images[static_cast<std::size_t>(from.source)].first_alike, srgb);
    if (from.sampler >= 0) {
      const tinygltf::Sampler& sampler = document.model.samplers[static_cast<std::size_t>(from.sampler)];
      texture.wrap_u = to_wrap(sampler.wrapS);
      texture.wrap_v = to_wrap(sampler.wrapT);
      texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
      const bool is_linear = sampler.minFilter < 0 || sampler.minFilter == TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
      if (!is_linear) other_filters.insert(from.sampler);
    }
    return texture;
  }

  void note_left_out() const {
    const auto note = [this](std::size_t count, std::string_view what) {
      if (count > 0) document.notes.push_back(fmt::format("{} {}", count, what));
    };
    note(without_image.size(), "textures left out: they have no image in a format that is supported");
    note(without_set, "uses of textures left out: their texCoord is neither 0 nor 1");
    note(other_filters.size(), "samplers have their minFilter replaced: textures become smaller by linear mip levels");
  }
};

glm::vec3 emission(const tinygltf::Material& from, const std::string& file, std::size_t index) {
  double strength = 1.0;
  if (const auto found = from.extensions.find("KHR_materials_emissive_strength"); found != from.extensions.end()) {
    if (found->second.Has("emissiveStrength")) strength = found->second.Get("emissiveStrength").GetNumberAsDouble();
  }
  const auto& factor = from.emissiveFactor;
  const glm::dvec3 emissive = glm::dvec3(factor[0], factor[1], factor[2]) * strength;
  if (std::max({emissive.x, emissive.y, emissive.z}) > static_cast<double>(std::numeric_limits<float>::max())) {
    gltf_fail(file, fmt::format("material {}", index),
              "emissiveFactor times emissiveStrength is too large, expected a finite number");
  }
  return emissive;
}

AlphaMode to_alpha_mode(const std::string& mode) {
  if (mode == "MASK") return AlphaMode::mask;
  return mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

Material read_material(const tinygltf::Material& from, TextureReader& textures) {
  const auto& pbr = from.pbrMetallicRoughness;
  const auto& base = pbr.baseColorFactor;
  Material material;
  material.name = from.name;
  material.base_color = glm::vec4(base[0], base[1], base[2], base[3]);
  material.metallic = static_cast<float>(pbr.metallicFactor);
  material.roughness = static_cast<float>(pbr.roughnessFactor);
  material.normal_scale = static_cast<float>(from.normalTexture.scale);
  material.occlusion_strength = static_cast<float>(from.occlusionTexture.strength);
  material.alpha_mode = to_alpha_mode(from.alphaMode);
  material.alpha_cutoff = static_cast<float>(from.alphaCutoff);
  material.double_sided = from.doubleSided;
  material.base_color_texture = textures.read(pbr.baseColorTexture, /* srgb= */ true);
  material.metallic_roughness_texture = textures.read(pbr.metallicRoughnessTexture, /* srgb= */ false);
  material.normal_texture = textures.read(from.normalTexture, /* srgb= */ false);
  material.occlusion_texture = textures.read(from.occlusionTexture, /* srgb= */ false);
  material.emissive_texture = textures.read(from.emissiveTexture, /* srgb= */ true);
  return material;
}

}  // namespace

GltfMaterials read_materials(GltfDocument& document) {
  GltfMaterials result;
  TextureReader textures{.document = document, .images = result.images};
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    const tinygltf::Material& from = document.model.materials[i];
    result.materials.push_back(read_material(from, textures));
    const glm::vec3 emitted = result.materials.back().emissive = emission(from, document.origin.file, i);
    if (const float most = std::max({emitted.x, emitted.y, emitted.z}); most > LARGEST_EMISSION)
      document.notes.push_back(fmt::format("material {}: emits {:g}, shown as {:g}, the most that is kept of a pixel",
                                           i, most, LARGEST_EMISSION));
  }
  textures.note_left_out();
  Material fallback;
  fallback.name = "default";
  fallback.metallic = 1.0F;  // as the specification's default material
  result.materials.push_back(fallback);
  return result;
}

}  // namespace lamp::app
