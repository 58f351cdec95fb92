// The glTF loader: skinned meshes stand in the pose of their joints.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "unit/gltf_builder.h"

namespace {

using namespace lamp::test;
using lamp::app::Scene;
using lamp::app::Vertex;

const std::vector<float> FIRST_JOINT{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};  // of three vertices, WEIGHTS_0

void expect_near(glm::vec3 actual, glm::vec3 expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5F) << "component " << i;
}

/// The triangle (0,0,0), (1,0,0), (0,1,0) with normals along z and tangents along x, placed at x = -100 by node 0 with
/// a skin of two joints, nodes 1 and 2, below node 3 at y = 1. All vertices follow the first.
GltfBuilder skinned(const json& first = json::object(), const json& second = json::object()) {
  GltfBuilder builder;
  const json attributes = {
      {"POSITION", builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3)},
      {"NORMAL", builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3)},
      {"TANGENT", builder.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4)},
      {"JOINTS_0", builder.accessor(builder.view(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}),
                                    UNSIGNED_BYTE, 3, "VEC4")},
      {"WEIGHTS_0", builder.floats(FIRST_JOINT, "VEC4", 4)}};
  builder.root({{"mesh", builder.mesh({{"attributes", attributes}})}, {"skin", 0}, {"translation", {-100, 0, 0}}});
  builder.add("nodes", first);
  builder.add("nodes", second);
  builder.root({{"translation", {0, 1, 0}}, {"children", {1, 2}}});
  builder.add("skins", {{"joints", {1, 2}}});
  return builder;
}

json& attributes_of(GltfBuilder& builder) { return builder.document["meshes"][0]["primitives"][0]["attributes"]; }

/// The same matrix for both joints, column after column.
void bind(GltfBuilder& builder, const std::array<float, 16>& matrix) {
  std::vector<float> both(matrix.begin(), matrix.end());
  both.insert(both.end(), matrix.begin(), matrix.end());
  builder.document["skins"][0]["inverseBindMatrices"] = builder.floats(both, "MAT4", 16);
}

TEST(GltfSkins, StandWhereTheirJointsAre) {
  const Scene scene = load(skinned({{"translation", {2.5, 0, 0}}}));
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.instances[0].world_from_object, glm::mat4(1.0F)) << "the mesh's own node does not place it";
  ASSERT_EQ(scene.vertices.size(), 3U);
  EXPECT_EQ(scene.vertices[0].position, glm::vec3(2.5F, 1, 0));
  EXPECT_EQ(scene.vertices[1].position, glm::vec3(3.5F, 1, 0));
  EXPECT_EQ(scene.vertices[2].position, glm::vec3(2.5F, 2, 0));
  EXPECT_EQ(scene.indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(scene.notes.empty());
}

TEST(GltfSkins, TurnWithJointsFromWhereTheyWereBound) {
  const float half = std::sqrt(0.5F);
  GltfBuilder builder = skinned({{"translation", {2, 0, 0}}, {"rotation", {0, 0, half, half}}});
  bind(builder, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});  // the joint was at x = 1
  const std::vector<Vertex> vertices = load(builder).vertices;
  expect_near(vertices.at(1).position, {2, 1, 0});
  expect_near(vertices.at(0).position, {2, 0, 0});
  expect_near(vertices.at(2).position, {1, 0, 0});
  expect_near(vertices.at(0).normal, {0, 0, 1});
  expect_near(glm::vec3(vertices.at(0).tangent), {0, 1, 0});
  EXPECT_EQ(vertices.at(0).tangent.w, 1.0F);
}

/// Every vertex goes a fifth of the way from the second joint to the first.
void expect_blended(const GltfBuilder& builder) {
  const std::vector<Vertex> vertices = load(builder).vertices;
  expect_near(vertices.at(0).position, {2, 1, 8});
  expect_near(vertices.at(1).position, {3, 1, 8});
}

TEST(GltfSkins, BlendJointsByWeightsOfEveryType) {
  GltfBuilder builder = skinned({{"translation", {10, 0, 0}}}, {{"translation", {0, 0, 10}}});
  json& attributes = attributes_of(builder);
  attributes["WEIGHTS_0"] = builder.floats({0.2F, 0.8F, 0, 0, 0.2F, 0.8F, 0, 0, 0.2F, 0.8F, 0, 0}, "VEC4", 4);
  expect_blended(builder);
  attributes["WEIGHTS_0"] =
      builder.accessor(builder.view(std::vector<std::uint8_t>{51, 204, 0, 0, 51, 204, 0, 0, 51, 204, 0, 0}),
                       UNSIGNED_BYTE, 3, "VEC4", /* normalized= */ true);
  expect_blended(builder);
  attributes["WEIGHTS_0"] = builder.accessor(
      builder.view(std::vector<std::uint16_t>{13107, 52428, 0, 0, 13107, 52428, 0, 0, 13107, 52428, 0, 0}),
      UNSIGNED_SHORT, 3, "VEC4", /* normalized= */ true);
  attributes["JOINTS_0"] = builder.accessor(
      builder.view(std::vector<std::uint16_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}), UNSIGNED_SHORT, 3, "VEC4");
  expect_blended(builder);
  attributes["WEIGHTS_0"] = builder.floats({2, 8, 0, 0, 2, 8, 0, 0, 2, 8, 0, 0}, "VEC4", 4);
  expect_blended(builder);  // only their ratio matters
  attributes["WEIGHTS_0"] = builder.floats(FIRST_JOINT, "VEC4", 4);
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  attributes["WEIGHTS_1"] = builder.floats({0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0}, "VEC4", 4);
  expect_blended(builder);  // a second set
}

TEST(GltfSkins, BendNormalsAsSurfacesBend) {
  GltfBuilder builder = skinned({{"scale", {2, 1, 1}}});
  attributes_of(builder)["NORMAL"] = builder.floats({1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3", 3);
  expect_near(load(builder).vertices.at(0).normal, glm::normalize(glm::vec3(0.5F, 1, 0)));
  attributes_of(builder).erase("NORMAL");
  expect_near(load(builder).vertices.at(0).normal, {0, 0, 1});
}

TEST(GltfSkins, KeepFrontFacesWhereJointsMirror) {
  const Scene scene = load(skinned({{"scale", {-1, 1, 1}}}));
  ASSERT_EQ(scene.indices.size(), 3U);
  const auto corner = [&](std::size_t i) { return scene.vertices.at(scene.indices[i]).position; };
  expect_near(glm::cross(corner(1) - corner(0), corner(2) - corner(0)), {0, 0, 1});
  expect_near(scene.vertices.at(0).normal, {0, 0, 1});
  EXPECT_EQ(scene.vertices.at(0).tangent, glm::vec4(-1, 0, 0, -1));
}

TEST(GltfSkins, AreCopiesOfAMesh) {
  GltfBuilder builder = skinned({{"translation", {5, 0, 0}}}, {{"translation", {0, 0, 7}}});
  builder.add("skins", {{"joints", {2, 1}}});
  attributes_of(builder)["COLOR_0"] = builder.floats({2, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC3", 3);
  builder.root({{"mesh", 0}, {"skin", 1}});
  builder.root({{"mesh", 0}, {"skin", 0}});
  builder.root({{"mesh", 0}, {"translation", {0, 0, 3}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.instances.size(), 4U);
  const auto first_vertex = [&](std::size_t instance) {
    const glm::vec3 position =
        scene.vertices.at(scene.meshes.at(scene.instances[instance].mesh).vertex_offset).position;
    return glm::vec3(scene.instances[instance].world_from_object * glm::vec4(position, 1.0F));
  };
  expect_near(first_vertex(0), {5, 1, 0});
  expect_near(first_vertex(1), {0, 1, 7});
  expect_near(first_vertex(2), {5, 1, 0});
  expect_near(first_vertex(3), {0, 0, 3});
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh) << "one copy a skin";
  EXPECT_EQ(scene.notes, std::vector<std::string>{"mesh 0 primitive 0: 1 colors clamped to 0 .. 1"}) << "said once";
}

TEST(GltfSkins, CountVerticesWithoutWeights) {
  GltfBuilder builder = skinned({{"translation", {5, 0, 0}}});
  attributes_of(builder)["WEIGHTS_0"] = builder.floats({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices.at(0).position, glm::vec3(5, 1, 0));
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"mesh 0 primitive 0: 2 vertices without weights follow their first joint"});
}

void expect_error(const GltfBuilder& builder, const std::string& says) {
  const std::string error = error_text(builder.gltf());
  EXPECT_EQ(error.substr(0, 11), "test.gltf: ") << error;
  EXPECT_NE(error.find(says), std::string::npos) << "got:  " << error << "\nwant: " << says;
}

TEST(GltfSkins, SayWhatIsWrongWithASkin) {
  const auto with = [](const char* pointer, const json& value) {
    GltfBuilder builder = skinned();
    builder.document[json::json_pointer(pointer)] = value;
    return builder;
  };
  expect_error(with("/nodes/0/skin", 1), "node 0: skin is 1, expected an index into skins (1 there)");
  expect_error(with("/skins/0", json::object()), "skin 0: joints is missing, expected an array of indices into nodes");
  expect_error(with("/skins/0/joints", json::array()), "skin 0: has no joints, expected one or more");
  expect_error(with("/skins/0/joints/1", 9), "skin 0: joints is [1,9], expected an array of indices into nodes (4 ");
  expect_error(with("/skins/0/inverseBindMatrices", 99), "skin 0: inverseBindMatrices is 99, expected an index into");
  expect_error(with("/skins/0/inverseBindMatrices", 0),
               "accessor 0: type is not MAT4, expected that, as it holds matrices");
  expect_error(with("/skins/0/joints", {1}),
               "mesh 0 primitive 0: JOINTS_0 (accessor 3) of vertex 0 holds 1, expected less than the 1 joints of");
  expect_error(with("/nodes/3/children", {1}), "skin 0: joint 1 is node 2, expected one that is in the scene");
}

TEST(GltfSkins, SayWhatIsWrongWithBindMatrices) {
  GltfBuilder builder = skinned();
  const std::vector<float> one{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  builder.document["skins"][0]["inverseBindMatrices"] = builder.floats(one, "MAT4", 16);
  expect_error(builder, "skin 0: inverseBindMatrices (accessor 5) has 1 elements, expected 2, one for each joint");
  builder = skinned();
  bind(builder, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2});
  expect_error(builder, "inverseBindMatrices (accessor 5) of joint 0 has a last row that is not 0 0 0 1, expected an");
  builder = skinned();
  bind(builder, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, NAN, 0, 0, 1});
  expect_error(builder, "inverseBindMatrices (accessor 5) of joint 0 holds nan, expected finite numbers up to 1e+15");
  builder = skinned({{"scale", {1e10, 1e10, 1e10}}});
  bind(builder, {1e10F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  expect_error(builder, "mesh 0 primitive 0: its skin takes vertex 1 1e+20 m away, expected at most 1e+15 m from the");
}

TEST(GltfSkins, SayWhatIsWrongWithAttributes) {
  const auto without = [](const char* attribute) {
    GltfBuilder builder = skinned();
    attributes_of(builder).erase(attribute);
    return builder;
  };
  expect_error(without("JOINTS_0"), "mesh 0 primitive 0: JOINTS_0 is missing, expected it, as a skin poses the mesh");
  expect_error(without("WEIGHTS_0"), "mesh 0 primitive 0: WEIGHTS_0 is missing, expected it beside JOINTS_0");
  GltfBuilder builder = skinned();
  attributes_of(builder)["JOINTS_1"] = 3;
  expect_error(builder, "mesh 0 primitive 0: WEIGHTS_1 is missing, expected it beside JOINTS_1");
  builder = skinned();
  attributes_of(builder)["JOINTS_0"] = 4;
  expect_error(builder, "JOINTS_0 (accessor 4) has componentType 5126, expected 5121 or 5123");
  builder = skinned();
  builder.document["accessors"][3]["normalized"] = true;
  expect_error(builder, "JOINTS_0 (accessor 3) has componentType 5121 normalized, expected 5121 or 5123");
  builder = skinned();
  attributes_of(builder)["WEIGHTS_0"] = 3;
  expect_error(builder, "WEIGHTS_0 (accessor 3) has componentType 5121, expected floats or normalized 8 or 16 bit");
  builder = skinned();
  attributes_of(builder)["WEIGHTS_0"] = builder.floats({-1, 2, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  expect_error(builder, "WEIGHTS_0 (accessor 5) of vertex 0 holds -1, expected 0 or more");
  builder = skinned();
  attributes_of(builder)["WEIGHTS_0"] = builder.floats({1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  expect_error(builder, "WEIGHTS_0 (accessor 5) has 2 elements, expected 3, as many as POSITION");
}

}  // namespace
