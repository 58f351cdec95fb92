// The glTF loader: containers, files next to the scene, scenes, nodes and cameras.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "image/image.h"
#include "scene/flight.h"
#include "temporary_folder.h"
#include "unit/gltf_builder.h"
#include "unit/this_system.h"

namespace {

using namespace lamp::test;
using lamp::app::bounds;
using lamp::app::Scene;

void expect_near(glm::vec3 actual, glm::vec3 expected, float tolerance = 1e-5F) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

TEST(Gltf, LoadsJsonAndBinaryAlike) {
  const GltfBuilder builder = triangle();
  for (const std::string& file : {builder.gltf(), builder.glb()}) {
    const Scene scene = load_text(file);
    EXPECT_EQ(scene.name, "test.gltf");
    ASSERT_EQ(scene.vertices.size(), 3U);
    EXPECT_EQ(scene.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
    ASSERT_EQ(scene.instances.size(), 1U);
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].metallic, 1.0F) << "the specification's default material";
    EXPECT_TRUE(scene.notes.empty());
  }
}

TEST(Gltf, LoadsBuffersAndImagesNextToTheFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "lamp gltf";
  std::filesystem::create_directories(folder);
  GltfBuilder builder = triangle();
  builder.document["buffers"][0] = {{"byteLength", builder.bytes.size()}, {"uri", "a%20buffer.bin"}};
  // A file may be longer than the buffer in it.
  const std::string contents(reinterpret_cast<const char*>(builder.bytes.data()), builder.bytes.size());
  std::ofstream(folder / "a buffer.bin", std::ios::binary) << contents << "more";
  std::ofstream(folder / "scene.gltf") << builder.document.dump();
  const Scene scene = lamp::app::load_gltf(folder / "scene.gltf");
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.vertices.at(2).position, glm::vec3(0, 1, 0));
  EXPECT_EQ(scene.files, (std::vector{folder / "scene.gltf", folder / "a buffer.bin"}));

  std::ofstream(folder / "a buffer.bin", std::ios::binary) << contents.substr(0, 35);
  const std::string error = error_text(builder.document.dump(), folder);
  EXPECT_NE(error.find("test.gltf: buffer 0: byteLength is 36, expected at most the 35 bytes"), std::string::npos)
      << error;
  std::filesystem::remove_all(folder);
}

TEST(Gltf, SaysWhichFilesItRead) {
  const lamp::app::TemporaryFolder folder;
  GltfBuilder builder = triangle();
  std::ofstream(folder.path() / "scene.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(builder.bytes.data()), static_cast<std::streamsize>(builder.bytes.size()));
  for (const char* name : {"used.png", "unused.png"})
    lamp::app::write_png(folder.path() / name, {1, 1, {glm::u8vec4(255)}});
  builder.document["buffers"][0] = {{"byteLength", builder.bytes.size()}, {"uri", "scene.bin"}};
  for (const char* name : {"unused.png", "used.png"}) builder.add("images", {{"uri", name}});
  builder.add("images", {{"uri", "data:image/png;base64," + std::string(PNG)}});
  for (const int source : {1, 2}) builder.add("textures", {{"source", source}});
  builder.add("materials", {{"pbrMetallicRoughness",
                             {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
                            {"emissiveTexture", {{"index", 1}}}});
  builder.document["meshes"][0]["primitives"][0]["material"] = 0;
  std::ofstream(folder.path() / "scene.gltf") << builder.document.dump();
  EXPECT_EQ(lamp::app::load_gltf(folder.path() / "scene.gltf").files,
            (std::vector{folder.path() / "scene.gltf", folder.path() / "scene.bin", folder.path() / "used.png"}));
  EXPECT_TRUE(load(triangle()).files.empty()) << "from memory";
}

TEST(Gltf, PlacesNodesByMatrixAndByTranslationRotationScale) {
  GltfBuilder builder = triangle();
  const float half = std::sqrt(0.5F);
  builder.document["nodes"][0] = {
      {"translation", {1, 2, 3}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 2, 2}}, {"children", {1}}};
  builder.add("nodes", {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.instances.size(), 1U);
  // The child lies at (1,0,0) of its parent, which turns x to y, doubles, and moves.
  expect_near(glm::vec3(scene.instances[0].world_from_object[3]), {1, 4, 3});
  expect_near(glm::vec3(scene.instances[0].world_from_object[0]), {0, 2, 0});
  expect_near(bounds(scene).max, {1, 6, 3});
}

TEST(Gltf, LoadsAllRootsOfTheDefaultSceneOnly) {
  GltfBuilder builder = triangle();
  builder.root({{"mesh", 0}, {"translation", {5, 0, 0}}});
  builder.add("nodes", {{"mesh", 0}, {"translation", {0, 9, 0}}});
  builder.add("scenes", {{"nodes", {2}}});
  EXPECT_EQ(load(builder).instances.size(), 2U);
  builder.document["scene"] = 1;
  ASSERT_EQ(load(builder).instances.size(), 1U);
  expect_near(bounds(load(builder)).min, {0, 9, 0});
  builder.document.erase("scene");
  EXPECT_EQ(load(builder).instances.size(), 2U) << "without a default scene, the first";
  builder.document.erase("scenes");
  EXPECT_EQ(load(builder).instances.size(), 3U) << "without scenes, every root node";
}

TEST(Gltf, SurvivesAVeryDeepHierarchy) {
  GltfBuilder builder = triangle();
  constexpr int DEPTH = 50000;
  builder.document["nodes"][0] = {{"children", {1}}};
  for (int i = 1; i < DEPTH; ++i) builder.add("nodes", {{"children", {i + 1}}});
  builder.add("nodes", {{"mesh", 0}});
  EXPECT_EQ(load(builder).instances.size(), 1U);
}

TEST(Gltf, ReadsPerspectiveAndOrthographicCameras) {
  GltfBuilder builder = triangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.25}}}});
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.25}, {"zfar", 50}}}});
  builder.add("cameras",
              {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}});
  builder.root({{"name", "eye"}, {"camera", 0}, {"translation", {0, 0, 5}}, {"scale", {3, 3, -3}}});
  builder.root({{"name", "eye"}, {"camera", 1}});
  builder.root({{"camera", 2}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.cameras.size(), 3U);

  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_FLOAT_EQ(scene.cameras[0].fov_y, 0.8F);
  EXPECT_FLOAT_EQ(scene.cameras[0].near_m, 0.25F);
  EXPECT_EQ(scene.cameras[0].far_m, 0.0F) << "infinite";
  const glm::mat4& pose = scene.cameras[0].world_from_camera;
  expect_near(glm::vec3(pose[3]), {0, 0, 5});
  expect_near(glm::vec3(pose[2]), {0, 0, -1});
  expect_near(glm::vec3(pose[1]), {0, 1, 0});
  EXPECT_NEAR(glm::determinant(glm::mat3(pose)), 1.0F, 1e-5F) << "rigid in spite of the node's scale";

  EXPECT_EQ(scene.cameras[1].name, "eye 2") << "names are unique";
  EXPECT_FLOAT_EQ(scene.cameras[1].far_m, 50.0F);
  EXPECT_EQ(scene.cameras[2].name, "camera 2");
  EXPECT_TRUE(scene.cameras[2].orthographic);
  EXPECT_FLOAT_EQ(scene.cameras[2].half_height, 3.0F);
  EXPECT_FLOAT_EQ(scene.cameras[2].far_m, 9.0F);
}

TEST(Gltf, NamesManyCamerasApartInNoTime) {
  GltfBuilder builder = triangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.25}}}});
  builder.root({{"name", "camera 0 3"}, {"camera", 0}});
  constexpr int COUNT = 20000;  // comparing each with each took minutes
  for (int i = 0; i < COUNT; ++i) builder.root({{"camera", 0}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.cameras.size(), COUNT + 1U);
  EXPECT_EQ(scene.cameras[1].name, "camera 0");
  EXPECT_EQ(scene.cameras[2].name, "camera 0 2");
  EXPECT_EQ(scene.cameras[3].name, "camera 0 4") << "a node has 3 already";
  std::set<std::string> names;
  for (const lamp::app::Camera& camera : scene.cameras) EXPECT_TRUE(names.insert(camera.name).second) << camera.name;
}

TEST(Gltf, FollowsPathsBelowItsFolderAndLinksInIt) {
  if (!has_links()) GTEST_SKIP() << NO_LINKS;
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "lamp gltf links";
  std::filesystem::create_directories(folder / "parts");
  GltfBuilder builder = triangle();
  const std::string contents(reinterpret_cast<const char*>(builder.bytes.data()), builder.bytes.size());
  std::ofstream(folder / "a.bin", std::ios::binary) << contents;
  std::filesystem::create_symlink(std::filesystem::absolute(folder / "a.bin"), folder / "parts" / "link.bin");
  for (const char* uri : {"./a.bin", "parts/../a.bin", "nowhere/../a.bin", "parts/link.bin"}) {
    builder.document["buffers"][0] = {{"byteLength", builder.bytes.size()}, {"uri", uri}};
    EXPECT_EQ(error_text(builder.document.dump(), folder), "") << uri;
  }
  std::filesystem::remove_all(folder);
}

/// Whether a world point is beyond a camera's near plane and within its vertical field of view.
bool sees(const lamp::app::Camera& camera, glm::vec3 point) {
  const glm::vec3 view(glm::inverse(camera.world_from_camera) * glm::vec4(point, 1.0F));
  return -view.z > camera.near_m && std::abs(view.y) <= -view.z * std::tan(camera.fov_y / 2.0F);
}

TEST(Gltf, FramesSmallScenesFromOutside) {
  const Scene scene = load(triangle());
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_EQ(scene.cameras[0].name, "default");
  for (const lamp::app::Vertex& vertex : scene.vertices) EXPECT_TRUE(sees(scene.cameras[0], vertex.position));
  ASSERT_TRUE(scene.flight.has_value());
  EXPECT_EQ(scene.flight->keys.size(), 8U);
}

TEST(Gltf, FramesScenesOfEverySize) {
  for (const float size : {1e-8F, 1e-6F, 1e-4F, 0.02F, 1.0F, 100.0F, 1e6F}) {
    SCOPED_TRACE(size);
    GltfBuilder builder = triangle();
    builder.document["nodes"][0]["scale"] = {size, size, size};
    const Scene scene = load(builder);
    const auto sees_all = [&](const lamp::app::Camera& camera) {
      return std::ranges::all_of(scene.vertices,
                                 [&](const auto& vertex) { return sees(camera, size * vertex.position); });
    };
    EXPECT_TRUE(sees_all(scene.cameras.at(0)));
    for (int frame = 0; frame < 300; frame += 10) EXPECT_TRUE(sees_all(lamp::app::frame_camera(scene, frame))) << frame;
  }
}

TEST(Gltf, TakesTheExtentOfAPointForOneItCanShow) {
  GltfBuilder builder = triangle();
  builder.document["nodes"][0]["scale"] = {0, 0, 0};
  builder.document["nodes"][0]["translation"] = {1, 2, 3};
  EXPECT_TRUE(sees(load(builder).cameras.at(0), {1, 2, 3}));
}

TEST(Gltf, RefusesEyesThatAreTooFarAway) {
  GltfBuilder builder = triangle();
  builder.document["nodes"][0]["scale"] = {9e14, 9e14, 9e14};
  EXPECT_EQ(error_text(builder.gltf()),
            "test.gltf: camera 'default': stands 1.85927e+15 m from the origin, expected at most 1e+15 m");
  builder.document["nodes"][0]["scale"] = {1, 1, 1};
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  builder.root({{"name", "eye"}, {"camera", 0}, {"translation", {9e14, 9e14, 0}}});
  EXPECT_EQ(error_text(builder.gltf()),
            "test.gltf: camera 'eye': stands 1.27279e+15 m from the origin, expected at most 1e+15 m");
}

TEST(Gltf, StandsInsideLargeScenes) {
  GltfBuilder builder = triangle();
  // Two corners of a hall, 40 m long in z, 10 m wide, 6 m high.
  builder.document["nodes"][0]["translation"] = {-5, 0, -20};
  builder.root({{"mesh", 0}, {"translation", {4, 5, 20}}});
  const Scene scene = load(builder);
  const glm::mat4& pose = scene.cameras.at(0).world_from_camera;
  EXPECT_NEAR(pose[3].y, 1.7F, 1e-4F);
  EXPECT_LT(pose[3].z, -10.0F);
  EXPECT_GT(pose[3].z, -20.0F);
  expect_near(-glm::vec3(pose[2]), {0, 0, 1});
  for (const auto& key : scene.flight->keys) {
    EXPECT_LT(std::abs(key.eye.x), 2.0F);
    EXPECT_LT(std::abs(key.eye.z), 20.0F);
    EXPECT_NEAR(key.eye.y, 1.7F, 1e-4F);
  }
}

TEST(Gltf, FliesAtTheFilesOwnCamera) {
  GltfBuilder builder = triangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  builder.root({{"camera", 0}, {"translation", {7, 1, 2}}});
  builder.root({{"mesh", 0}, {"translation", {9, 0, 0}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.flight->keys.size(), 8U);
  EXPECT_EQ(scene.flight->near_m, 0.05F);
  EXPECT_FLOAT_EQ(scene.flight->fov_y, 0.5F);
  expect_near(scene.flight->keys[0].target, {7, 1, -8});
  expect_near(scene.flight->keys[4].target, {7, 1, 12});
  for (const auto& key : scene.flight->keys) EXPECT_NEAR(glm::distance(key.eye, {7, 1, 2}), 0.3F, 1e-5F);

  builder.document["nodes"][0]["scale"] = {0.02, 0.02, 0.02};
  builder.document["nodes"][2]["translation"] = {0, 0, 0};
  builder.document["nodes"][2]["scale"] = {0.02, 0.02, 0.02};
  builder.document["nodes"][1]["translation"] = {0, 0, 0.01};
  const Scene small = load(builder);
  EXPECT_LT(small.flight->near_m, 0.001F);
  EXPECT_LT(glm::distance(small.flight->keys[0].eye, {0, 0, 0.01F}), 0.005F) << "within the scene";
}

TEST(Gltf, LeavesOutCamerasThatAScaleOfZeroHides) {
  GltfBuilder builder = triangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  for (const json& scale : {json{0, 0, 0}, json{1, 1, 0}, json{1, 0, 1}})
    builder.root({{"camera", 0}, {"scale", scale}});
  const Scene none = load(builder);
  EXPECT_EQ(none.cameras.at(0).name, "default");
  EXPECT_EQ(none.notes, std::vector<std::string>{"3 cameras left out: a scale of 0 hides them"});
  builder.root({{"name", "tiny"}, {"camera", 0}, {"scale", {1e-7, 1e-7, 1e-7}}});
  builder.root({{"name", "flat"}, {"camera", 0}, {"scale", {0, 1, 1}}});
  const Scene two = load(builder);
  ASSERT_EQ(two.cameras.size(), 2U);
  for (const lamp::app::Camera& camera : two.cameras)
    EXPECT_EQ(camera.world_from_camera, glm::mat4(1.0F)) << camera.name;
}

TEST(Gltf, TakesWholeNumbersHoweverTheyAreWritten) {
  std::string text = triangle().gltf();
  for (const auto& [integer, decimal] :
       {std::pair<std::string, std::string>{"\"byteLength\":36", "\"byteLength\":36.0"},
        {"\"scene\":0", "\"scene\":0.0"},
        {"\"count\":3", "\"count\":0.3e1"},
        {"\"componentType\":5126", "\"componentType\":5.126E3"},
        {"\"nodes\":[0]", "\"nodes\":[0.0]"}}) {
    for (std::size_t at = text.find(integer); at != std::string::npos; at = text.find(integer, at + decimal.size()))
      text.replace(at, integer.size(), decimal);
    EXPECT_NE(text.find(decimal), std::string::npos) << decimal;
  }
  EXPECT_EQ(load_text(text).vertices.size(), 3U);
}

TEST(Gltf, NotesExtensionsThatItDoesNotDeclare) {
  GltfBuilder builder = triangle();
  builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = json::object();
  builder.document["meshes"][0]["primitives"][0]["extensions"]["KHR_b"] = {{"extensions", {{"KHR_a", 1}}}};
  builder.document["extensionsUsed"] = {"KHR_b"};
  EXPECT_EQ(load(builder).notes,
            std::vector<std::string>{"extensions that are not supported, left out: KHR_b, EXT_mesh_gpu_instancing"});
}

TEST(Gltf, ReadsWhatFilesOftenHaveAgainstTheFormat) {
  GltfBuilder builder = triangle();
  builder.add("materials", {{"emissiveFactor", {0, 2.5, 0}}});
  builder.add("images", {{"uri", "data:image/png;base64," + std::string(PNG)}, {"mimeType", "image/webp"}});
  builder.add("images", {{"uri", "data:image/png;base64," + std::string(PNG)}, {"mimeType", "image/ktx2"}});
  builder.add("textures", {{"source", 0}});
  builder.root({{"extensions", builder.light({{"type", "point"}, {"color", {1, 3, 1}}})}});
  const json cone = {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}};
  builder.root({{"extensions", builder.light({{"type", "spot"}, {"spot", cone}})}});
  builder.root({{"matrix", {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.materials.at(0).emissive.y, 2.5F);
  EXPECT_EQ(glm::vec3(scene.lights.at(0).color), glm::vec3(1, 3, 1));
  EXPECT_EQ(scene.notes,
            (std::vector<std::string>{"against glTF, but read: 1 materials with an emissiveFactor above 1",
                                      "against glTF, but read: 1 lights with a color above 1",
                                      "against glTF, but read: 1 spots whose innerConeAngle is their outerConeAngle",
                                      "against glTF, but read: 1 nodes with a matrix that shears",
                                      "against glTF, but read: 1 images whose mimeType is missing or unknown"}));
}

TEST(Gltf, NotesWhatItLeavesOut) {
  GltfBuilder builder = triangle();
  builder.add("animations", json::object());
  builder.document["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", 0}}});
  builder.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  builder.document["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
  for (const char* name : {"TEXCOORD_2", "COLOR_1", "_MINE", "JOINTS_0"})
    builder.document["meshes"][0]["primitives"][0]["attributes"][name] = 0;
  builder.add("scenes", json::object());
  builder.document["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_lights_punctual"};
  const Scene scene = load(builder);
  EXPECT_EQ(scene.notes,
            (std::vector<std::string>{
                "extensions that are not supported, left out: KHR_materials_clearcoat",
                "1 animations left out: the scene stands still", "1 scenes left out: scene 0 is shown",
                "morph targets of 1 primitives left out", "attributes of 1 primitives left out: COLOR_1, TEXCOORD_2",
                "1 primitives of points or lines left out", "1 primitives without POSITION left out"}));
}

}  // namespace
