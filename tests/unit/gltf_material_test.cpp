// The glTF loader: materials, textures, samplers, and images in two colour spaces.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace {

using namespace lamp::test;
using lamp::app::AlphaMode;
using lamp::app::Material;
using lamp::app::Scene;
using lamp::app::Texture;
using lamp::app::Wrap;

std::string png_uri() { return "data:image/png;base64," + std::string(PNG); }

/// A triangle with two textures (0 and 1) of one image, and the given material.
GltfBuilder with_material(const json& material) {
  GltfBuilder builder = triangle();
  builder.add("images", {{"uri", png_uri()}, {"name", "four pixels"}});
  builder.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}});
  builder.add("textures", {{"source", 0}});
  builder.add("textures", {{"source", 0}, {"sampler", 0}});
  builder.add("materials", material);
  builder.document["meshes"][0]["primitives"][0]["material"] = 0;
  return builder;
}

TEST(GltfMaterial, SaysWhereItEmitsMoreThanIsKept) {
  const Scene scene =
      load(with_material({{"emissiveFactor", {1, 0.5, 0}},
                          {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 70000}}}}}}));
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"material 0: emits 70000, shown as 65504, the most that is kept of a pixel"});
}

TEST(GltfMaterial, ReadsFactors) {
  const Scene scene = load(with_material(
      {{"name", "brass"},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"doubleSided", true},
       {"emissiveFactor", {1, 0.5, 0}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.75}, {"roughnessFactor", 0.125}}}}));
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.meshes.at(0).material, 0U);
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.name, "brass");
  EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(material.metallic, 0.75F);
  EXPECT_EQ(material.roughness, 0.125F);
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
  EXPECT_TRUE(scene.notes.empty());
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.25F);
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.base_color_texture.image, -1);
  EXPECT_TRUE(scene.images.empty()) << "no material uses the image";
  EXPECT_EQ(load(with_material({{"alphaMode", "BLEND"}})).materials.at(0).alpha_mode, AlphaMode::blend);
}

TEST(GltfMaterial, ReadsTexturesOfEveryKindAndTheirColorSpace) {
  const json texture = {{"index", 0}};
  const Scene scene = load(with_material(
      {{"normalTexture", {{"index", 0}, {"scale", 0.5}}},
       {"occlusionTexture", {{"index", 0}, {"strength", 0.75}}},
       {"emissiveTexture", texture},
       {"pbrMetallicRoughness", {{"baseColorTexture", texture}, {"metallicRoughnessTexture", texture}}}}));
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.normal_scale, 0.5F);
  EXPECT_EQ(material.occlusion_strength, 0.75F);
  // One image, used as colour and as data: two images of the scene.
  ASSERT_EQ(scene.images.size(), 2U);
  const auto srgb = [&](const Texture& use) { return scene.images.at(static_cast<std::size_t>(use.image)).srgb; };
  EXPECT_TRUE(srgb(material.base_color_texture));
  EXPECT_TRUE(srgb(material.emissive_texture));
  EXPECT_FALSE(srgb(material.normal_texture));
  EXPECT_FALSE(srgb(material.occlusion_texture));
  EXPECT_FALSE(srgb(material.metallic_roughness_texture));
  EXPECT_EQ(material.base_color_texture.image, material.emissive_texture.image);
}

TEST(GltfMaterial, DecodesImagesFromUrisAndBufferViews) {
  GltfBuilder builder = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  const std::vector<std::uint8_t> expected{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128};
  const Scene from_uri = load(builder);
  EXPECT_EQ(from_uri.images.at(0).name, "four pixels");
  EXPECT_EQ(from_uri.images.at(0).width, 2U);
  EXPECT_EQ(from_uri.images.at(0).height, 2U);
  EXPECT_EQ(from_uri.images.at(0).rgba, expected);

  // The same bytes as a part of a .glb. A uri of just the padding-free base64 loads as well.
  std::vector<std::uint8_t> png;
  for (std::uint32_t bits = 0, count = 0; const char character : PNG.substr(0, PNG.find('='))) {
    const std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(character));
    count += 6;
    if (count >= 8) png.push_back(static_cast<std::uint8_t>(bits >> (count -= 8)));
  }
  builder.document["images"][0] = {{"bufferView", builder.view(png)}, {"mimeType", "image/png"}};
  EXPECT_EQ(load_text(builder.glb()).images.at(0).rgba, expected);
  builder.document["images"][0] = {{"uri", "DATA:image/png;base64," + std::string(PNG)}};
  EXPECT_EQ(load(builder).images.at(0).rgba, expected) << "schemes ignore case";
}

TEST(GltfMaterial, DecodesASourceOnce) {
  GltfBuilder builder = with_material({{"normalTexture", {{"index", 0}}}, {"emissiveTexture", {{"index", 1}}}});
  for (int i = 1; i < 4; ++i) {
    builder.add("images", {{"uri", png_uri()}});
    builder.add("textures", {{"source", i}});
    builder.add("materials", {{"emissiveTexture", {{"index", i + 1}}}});
  }
  const Scene scene = load(builder);
  ASSERT_EQ(scene.images.size(), 2U) << "one image in two colour spaces, though the file has four of its bytes";
  EXPECT_EQ(scene.images[0].rgba, scene.images[1].rgba);
  EXPECT_NE(scene.images[0].srgb, scene.images[1].srgb);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_EQ(scene.materials.at(i).emissive_texture.image, scene.materials[0].emissive_texture.image);
}

TEST(GltfMaterial, ReadsSamplers) {
  const json textures = {{"baseColorTexture", {{"index", 1}, {"texCoord", 1}}},
                         {"metallicRoughnessTexture", {{"index", 0}}}};
  const Material material = load(with_material({{"pbrMetallicRoughness", textures}})).materials.at(0);
  EXPECT_EQ(material.base_color_texture.wrap_u, Wrap::clamp);
  EXPECT_EQ(material.base_color_texture.wrap_v, Wrap::mirror);
  EXPECT_TRUE(material.base_color_texture.nearest);
  EXPECT_EQ(material.base_color_texture.uv, 1U);
  EXPECT_EQ(material.metallic_roughness_texture.wrap_u, Wrap::repeat);
  EXPECT_FALSE(material.metallic_roughness_texture.nearest);
  EXPECT_EQ(material.metallic_roughness_texture.uv, 0U);
}

TEST(GltfMaterial, ReadsTextureTransforms) {
  const json transform = {{"offset", {0.5, 1}}, {"rotation", 1.5}, {"scale", {2, 3}}, {"texCoord", 0}};
  const json moved = {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", transform}}}};
  const json plain = {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", json::object()}}}};
  const Material material =
      load(with_material({{"emissiveTexture", plain}, {"pbrMetallicRoughness", {{"baseColorTexture", moved}}}}))
          .materials.at(0);
  EXPECT_EQ(material.base_color_texture.offset, glm::vec2(0.5F, 1.0F));
  EXPECT_EQ(material.base_color_texture.rotation, 1.5F);
  EXPECT_EQ(material.base_color_texture.scale, glm::vec2(2, 3));
  EXPECT_EQ(material.base_color_texture.uv, 0U) << "the extension overrides";
  EXPECT_EQ(material.emissive_texture.scale, glm::vec2(1));
  EXPECT_EQ(material.emissive_texture.uv, 1U);
}

TEST(GltfMaterial, NotesTexturesThatPrimitivesHaveNoCoordinatesFor) {
  const std::vector<std::string> note{"1 primitives lack texture coordinates: a texture of theirs is one colour"};
  GltfBuilder builder = with_material({{"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}});
  json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(load(builder).notes, note);
  attributes["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
  EXPECT_EQ(load(builder).notes, note) << "of the other set";
  attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"];
  EXPECT_TRUE(load(builder).notes.empty());
}

TEST(GltfMaterial, NotesTexturesWithoutAnImageItCanReadOnce) {
  const json texture = {{"index", 0}};
  GltfBuilder builder =
      with_material({{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}, {"emissiveTexture", texture}});
  builder.document["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
  builder.document["extensionsUsed"] = {"KHR_texture_basisu"};
  const Scene scene = load(builder);
  EXPECT_EQ(scene.materials.at(0).base_color_texture.image, -1);
  EXPECT_EQ(scene.notes,
            (std::vector<std::string>{"extensions that are not supported, left out: KHR_texture_basisu",
                                      "1 textures left out: they have no image in a format that is supported"}));
}

TEST(GltfMaterial, LeavesOutTexturesOfFurtherCoordinates) {
  const json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 3}}}}}};
  const Scene scene = load(with_material(
      {{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}, {"pbrMetallicRoughness", {{"baseColorTexture", moved}}}}));
  EXPECT_EQ(scene.materials.at(0).emissive_texture.image, -1);
  EXPECT_EQ(scene.materials.at(0).base_color_texture.image, -1);
  EXPECT_TRUE(scene.images.empty());
  EXPECT_EQ(scene.notes, std::vector<std::string>{"2 uses of textures left out: their texCoord is neither 0 nor 1"});
}

TEST(GltfMaterial, NotesFiltersThatItReplaces) {
  GltfBuilder builder = with_material({{"emissiveTexture", {{"index", 1}}}, {"normalTexture", {{"index", 1}}}});
  json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
  for (const auto& [filter, notes] :
       {std::pair(9728, 1U), std::pair(9729, 1U), std::pair(9984, 1U), std::pair(9987, 0U)}) {
    builder.document["samplers"][0]["minFilter"] = filter;
    EXPECT_EQ(load(builder).notes.size(), notes) << filter;
  }
  builder.document["samplers"][0]["minFilter"] = 9985;
  EXPECT_EQ(load(builder).notes,
            std::vector<std::string>{
                "1 samplers have their minFilter replaced: textures become smaller by linear mip levels"});
}

TEST(GltfMaterial, ReadsLargeWholeNumbersOfTransforms) {
  const json transform = {{"offset", {3000000000, -3000000000}}};
  const json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  EXPECT_EQ(load(with_material({{"emissiveTexture", moved}})).materials.at(0).emissive_texture.offset,
            glm::vec2(3e9F, -3e9F));
}

}  // namespace
