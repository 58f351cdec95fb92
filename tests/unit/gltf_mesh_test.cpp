// The glTF loader: topologies, component types, sparse and strided accessors, mirrored meshes, normals and tangents.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace {

using namespace lamp::test;
using lamp::app::Scene;
using lamp::app::Vertex;

using Indices = std::vector<std::uint32_t>;

/// (0,0), (1,0), (0,1), (1,1): a strip of two triangles.
const std::vector<float> QUAD{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const std::vector<float> QUAD_NORMALS{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

/// A quad with normals, so that its vertices stay shared.
GltfBuilder quad(const json& primitive = json::object()) {
  GltfBuilder builder;
  json whole = primitive;
  whole["attributes"]["POSITION"] = builder.floats(QUAD, "VEC3", 3);
  whole["attributes"]["NORMAL"] = builder.floats(QUAD_NORMALS, "VEC3", 3);
  builder.root({{"mesh", builder.mesh(whole)}});
  return builder;
}

json& primitive_of(GltfBuilder& builder) { return builder.document["meshes"][0]["primitives"][0]; }

template <class T>
Indices load_indices(int component) {
  GltfBuilder builder = quad();
  primitive_of(builder)["indices"] = builder.accessor(builder.view(std::vector<T>{2, 1, 3}), component, 3, "SCALAR");
  return load(builder).indices;
}

TEST(GltfMesh, ReadsEveryIndexType) {
  EXPECT_EQ(load_indices<std::uint8_t>(UNSIGNED_BYTE), (Indices{2, 1, 3}));
  EXPECT_EQ(load_indices<std::uint16_t>(UNSIGNED_SHORT), (Indices{2, 1, 3}));
  EXPECT_EQ(load_indices<std::uint32_t>(UNSIGNED_INT), (Indices{2, 1, 3}));
}

TEST(GltfMesh, TurnsStripsAndFansIntoTriangles) {
  EXPECT_EQ(load(quad({{"mode", 5}})).indices, (Indices{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(load(quad({{"mode", 6}})).indices, (Indices{1, 2, 0, 2, 3, 0}));
}

TEST(GltfMesh, ReadsQuantizedAndNormalizedAttributesWithStrides) {
  GltfBuilder builder;
  const int positions = builder.view(std::vector<std::int16_t>{0, 0, 0, 0, 100, 0, 0, 0, 0, -200, 0, 0}, 8);
  const int normals = builder.view(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, -128, 0}, 4);
  const int uvs = builder.view(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 32768});
  const int raw_uvs = builder.view(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6});
  const int colors = builder.view(std::vector<std::uint16_t>{65535, 0, 0, 32896, 0, 0, 65535, 65535, 0, 0, 0, 0});
  const json attributes = {{"POSITION", builder.accessor(positions, SHORT, 3, "VEC3")},
                           {"NORMAL", builder.accessor(normals, BYTE, 3, "VEC3", true)},
                           {"TEXCOORD_0", builder.accessor(uvs, UNSIGNED_SHORT, 3, "VEC2", true)},
                           {"TEXCOORD_1", builder.accessor(raw_uvs, UNSIGNED_BYTE, 3, "VEC2")},
                           {"COLOR_0", builder.accessor(colors, UNSIGNED_SHORT, 3, "VEC4", true)}};
  builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  builder.root({{"mesh", builder.mesh({{"attributes", attributes}})}});
  const std::vector<Vertex> vertices = load(builder).vertices;
  ASSERT_EQ(vertices.size(), 3U);
  EXPECT_EQ(vertices[1].position, glm::vec3(100, 0, 0));
  EXPECT_EQ(vertices[2].position, glm::vec3(0, -200, 0));
  EXPECT_EQ(vertices[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(vertices[2].normal, glm::vec3(0, 0, -1)) << "-128 is -1, not less";
  EXPECT_EQ(vertices[1].uv[0], glm::vec2(1, 0));
  EXPECT_NEAR(vertices[2].uv[0].y, 0.5F, 1e-4F);
  EXPECT_EQ(vertices[2].uv[1], glm::vec2(5, 6));
  EXPECT_EQ(vertices[0].color, glm::u8vec4(255, 0, 0, 128));
}

TEST(GltfMesh, ReadsVectorsOfThreeColors) {
  GltfBuilder builder = quad({{"mode", 5}});
  primitive_of(builder)["attributes"]["COLOR_0"] = builder.floats({1, 0.5F, 0, 0, 0, 0, 0, 0, 0, 2, 1, 1}, "VEC3", 3);
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices.at(0).color, glm::u8vec4(255, 128, 0, 255));
  EXPECT_EQ(scene.notes, std::vector<std::string>{"mesh 0 primitive 0: 1 colors clamped to 0 .. 1"});
}

TEST(GltfMesh, ReadsSparseAccessorsOverDataAndOverNothing) {
  for (const bool over_data : {true, false}) {
    GltfBuilder builder = triangle();
    const int at = builder.view(std::vector<std::uint16_t>{1});
    const int values = builder.view(std::vector<float>{7, 8, 9});
    builder.document["accessors"][0]["sparse"] = {{"count", 1},
                                                  {"indices", {{"bufferView", at}, {"componentType", UNSIGNED_SHORT}}},
                                                  {"values", {{"bufferView", values}}}};
    if (!over_data) builder.document["accessors"][0].erase("bufferView");
    const Scene scene = load(builder);
    EXPECT_EQ(scene.vertices.at(1).position, glm::vec3(7, 8, 9));
    EXPECT_EQ(scene.vertices.at(2).position, over_data ? glm::vec3(0, 1, 0) : glm::vec3(0));
  }
}

TEST(GltfMesh, ReadsIndicesOverNothing) {
  GltfBuilder builder = triangle();
  const int at = builder.view(std::vector<std::uint8_t>{1, 2});
  const int values = builder.view(std::vector<std::uint16_t>{2, 1});
  primitive_of(builder)["indices"] =
      builder.add("accessors", {{"componentType", UNSIGNED_SHORT},
                                {"count", 3},
                                {"type", "SCALAR"},
                                {"sparse",
                                 {{"count", 2},
                                  {"indices", {{"bufferView", at}, {"componentType", UNSIGNED_BYTE}}},
                                  {"values", {{"bufferView", values}}}}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.vertices.size(), 3U) << "each corner has its own, for lack of normals";
  EXPECT_EQ(scene.vertices[1].position, glm::vec3(0, 1, 0));
  EXPECT_EQ(scene.vertices[2].position, glm::vec3(1, 0, 0));
}

TEST(GltfMesh, TakesTheSignOfAHandednessThatIsNone) {
  GltfBuilder builder = triangle();
  json& attributes = primitive_of(builder)["attributes"];
  attributes["NORMAL"] = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  attributes["TANGENT"] = builder.floats({1, 0, 0, -1, 1, 0, 0, -0.5F, 1, 0, 0, 0}, "VEC4", 4);
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices.at(1).tangent.w, -1.0F);
  EXPECT_EQ(scene.vertices.at(2).tangent.w, 1.0F);
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"mesh 0 primitive 0: 2 tangents with a w that is not 1 or -1: its sign is taken"});
}

/// The world-space normal of a scene's first triangle, from the order of its corners.
glm::vec3 facing(const Scene& scene) {
  const lamp::app::Mesh& mesh = scene.meshes.at(scene.instances.at(0).mesh);
  std::array<glm::vec3, 3> corner{};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Vertex& vertex = scene.vertices.at(mesh.vertex_offset + scene.indices.at(mesh.first_index + i));
    corner.at(i) = glm::vec3(scene.instances[0].world_from_object * glm::vec4(vertex.position, 1.0F));
  }
  return glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
}

TEST(GltfMesh, KeepsFrontFacesOfMirroredInstances) {
  GltfBuilder builder = triangle();
  EXPECT_EQ(facing(load(builder)), glm::vec3(0, 0, 1));
  builder.document["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(facing(load(builder)), glm::vec3(0, 0, 1));
  builder.root({{"mesh", 0}});
  builder.root({{"mesh", 0}, {"scale", {1, 1, -2}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.instances.size(), 3U);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh) << "one mirrored copy serves both";
  EXPECT_NE(scene.instances[0].mesh, scene.instances[1].mesh);
  const lamp::app::Mesh& copy = scene.meshes.at(scene.instances[0].mesh);
  EXPECT_EQ(scene.vertices.at(copy.vertex_offset).tangent.w, -1.0F) << "the tangent frame is mirrored too";
}

TEST(GltfMesh, MakesFlatNormalsWhereThereAreNone) {
  GltfBuilder builder;
  // Two triangles that share an edge at a right angle.
  const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  const int indices =
      builder.accessor(builder.view(std::vector<std::uint8_t>{0, 1, 2, 0, 3, 1}), UNSIGNED_BYTE, 6, "SCALAR");
  builder.root({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.vertices.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scene.vertices[i].normal, glm::vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(scene.vertices[i].normal, glm::vec3(0, 1, 0));
}

TEST(GltfMesh, ReplacesNormalsAndTangentsOfLengthZero) {
  GltfBuilder builder;
  const json attributes = {{"POSITION", builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3)},
                           {"NORMAL", builder.floats({0, 0, 0, 0, 0, 2, 0, 0, 1}, "VEC3", 3)},
                           {"TANGENT", builder.floats({1, 0, 0, -1, 0, 0, 0, 1, 0, 3, 0, 1}, "VEC4", 4)}};
  builder.root({{"mesh", builder.mesh({{"attributes", attributes}})}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices.at(0).normal, glm::vec3(0, 0, 1)) << "of its triangle";
  EXPECT_EQ(scene.vertices.at(1).normal, glm::vec3(0, 0, 1)) << "made a unit vector";
  EXPECT_EQ(scene.vertices.at(0).tangent, glm::vec4(1, 0, 0, -1));
  EXPECT_NEAR(glm::length(glm::vec3(scene.vertices.at(1).tangent)), 1.0F, 1e-6F);
  EXPECT_NEAR(scene.vertices.at(1).tangent.z, 0.0F, 1e-6F) << "across the normal";
  EXPECT_EQ(scene.vertices.at(2).tangent, glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(scene.notes, (std::vector<std::string>{"mesh 0 primitive 0: 1 normals of length 0 replaced",
                                                   "mesh 0 primitive 0: 1 tangents of length 0 replaced"}));
}

TEST(GltfMesh, MakesTangentsForNormalMaps) {
  GltfBuilder builder = quad({{"mode", 5}, {"material", 0}});
  // u grows along y, v along x: a mirrored texture. In the second set u grows along x.
  primitive_of(builder)["attributes"]["TEXCOORD_0"] = builder.floats({0, 0, 0, 1, 1, 0, 1, 1}, "VEC2", 2);
  primitive_of(builder)["attributes"]["TEXCOORD_1"] = builder.floats({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", 2);
  builder.add("images", {{"uri", "data:image/png;base64," + std::string(PNG)}});
  builder.add("textures", {{"source", 0}});
  builder.add("materials", {{"normalTexture", {{"index", 0}}}});
  for (const Vertex& vertex : load(builder).vertices) EXPECT_EQ(vertex.tangent, glm::vec4(0, 1, 0, -1));
  builder.document["materials"][0]["normalTexture"]["texCoord"] = 1;
  for (const Vertex& vertex : load(builder).vertices) EXPECT_EQ(vertex.tangent, glm::vec4(1, 0, 0, 1));
}

TEST(GltfMesh, SharesAMeshBetweenNodes) {
  GltfBuilder builder = triangle();
  builder.root({{"mesh", 0}, {"translation", {0, 0, 4}}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices.size(), 3U);
  EXPECT_EQ(scene.instances.size(), 2U);
}

}  // namespace
