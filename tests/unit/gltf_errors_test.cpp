// The glTF loader on bad input: one line that names the file, the element, what is wrong and what was expected.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "unit/gltf_builder.h"

namespace {

using namespace lamp::test;

/// One of everything, all of it right: mesh 0 with indices (accessor 1), material, texture, lights, cameras, nodes.
GltfBuilder full_scene() {
  GltfBuilder builder = triangle();
  json& primitive = builder.document["meshes"][0]["primitives"][0];
  primitive["indices"] =
      builder.accessor(builder.view(std::vector<std::uint16_t>{0, 1, 2}), UNSIGNED_SHORT, 3, "SCALAR");
  primitive["material"] = 0;
  primitive["attributes"]["NORMAL"] = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  builder.add("images", {{"uri", "data:image/png;base64," + std::string(PNG)}});
  builder.add("samplers", {{"wrapS", 10497}});
  builder.add("textures", {{"source", 0}, {"sampler", 0}});
  builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 2}}}});
  builder.root({{"name", "camera"}, {"camera", 0}});
  builder.root({{"extensions", builder.light({{"type", "point"}, {"range", 5}, {"intensity", 1}})}});
  const json cone = {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}};
  builder.root({{"extensions", builder.light({{"type", "spot"}, {"spot", cone}})}});
  return builder;
}

/// Replaces the value at `pointer` ("" as value: removes it) and expects the loader to say `says`.
struct Fault {
  std::string pointer;
  std::string value;
  std::string says;
};

const std::string LIGHTS = "/extensions/KHR_lights_punctual/lights";
const std::string BASE_COLOR = "/materials/0/pbrMetallicRoughness/baseColorTexture";

const std::vector<Fault>& faults() {
  static const std::vector<Fault> FAULTS{
      {"/asset", "", "asset is missing, expected an object"},
      {"/asset/version", "", "asset: version is missing, expected a string"},
      {"/asset/minVersion", "\"2.9\"", "asset: minVersion is \"2.9\", expected one of 2.0"},
      {"/asset/version", "\"1.0\"", "asset: version is '1.0', expected 2.0"},
      {"/extensionsRequired", R"(["KHR_draco_mesh_compression"])",
       "extensionsRequired: KHR_draco_mesh_compression not supported, expected none but KHR_lights_punctual"},
      {"/nodes", "{}", "nodes is {}, expected an array of objects, at most"},
      {"/nodes", "[7]", "nodes is [7], expected an array of objects, at most 262144 in the file"},
      {"/scene", "3", "scene is 3, expected an index into scenes (1 there)"},
      {"/scenes/0/nodes", "[0, 9]", "scene 0: nodes is [0,9], expected an array of indices into nodes (4 there)"},
      {"/nodes/0/mesh", "1", "node 0: mesh is 1, expected an index into meshes (1 there)"},
      {"/nodes/0/mesh", "-1", "node 0: mesh is -1, expected an index into meshes"},
      {"/nodes/0/mesh", "0.5", "node 0: mesh is 0.5, expected an index into meshes"},
      {"/nodes/0/children", "[4294967296]", "node 0: children is [4294967296], expected an array of indices"},
      {"/nodes/0/children", "[0]", "node 0: is reached twice from the scene, expected a tree without cycles"},
      {"/nodes/1", R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "scale": [1,1,1]})",
       "node 1: has a matrix and a scale, expected one of them"},
      {"/nodes/1", R"({"skin": 0})", "node 1: skin is 0, expected an index into skins (0 there)"},
      {"/meshes/0/primitives", "[]", "mesh 0: has no primitives, expected one or more"},
      {"/nodes/0/children", "[1]", "node 1: is reached twice from the scene, expected a tree without cycles"},
      {"/nodes/0/translation", "[1, 2]", "node 0: translation is [1,2], expected 3 numbers"},
      {"/nodes/0/translation", R"([0, "NaN", 0])", "node 0: translation is [0,\"NaN\",0], expected 3 numbers"},
      {"/nodes/0/translation", "[1e300, 0, 0]",
       "node 0: translation is [1e+300,0,0], expected numbers of at most 3.4028"},
      {"/nodes/0/translation", "[0, -1e300, 0]", "translation is [0,-1e+300,0], expected numbers of at least -3.4028"},
      {"/nodes/0/translation", "[1e30, 0, 0]", "node 0: its transform in the world is too large, expected numbers"},
      {"/nodes/0/rotation", "[0, 0, 0, 0]", "node 0: rotation has length 0, expected a unit quaternion"},
      {"/nodes/0/matrix", "[1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "node 0: matrix has a last row that is not 0 0 0 1"},
      {LIGHTS + "/0/range", "1e300", "range is 1e+300, expected at most 3.4028"},
      {"/nodes/2/extensions/KHR_lights_punctual/light", "2",
       "node 2 KHR_lights_punctual: light is 2, expected an index into extensions/KHR_lights_punctual/lights (2 "
       "there)"},

      {"/accessors/0/count", "0", "accessor 0: count is 0, expected an integer 1 .. 4294967295"},
      {"/accessors/0/count", "4", "accessor 0: 4 elements of 12 bytes, 12 apart, from byte 0, expected to end within"},
      {"/accessors/0/count", "4294967295", "accessor 0: 4294967295 elements of 12 bytes"},
      {"/accessors/0/byteOffset", "9007199254740991",
       "from byte 9007199254740991, expected to end within the 36 bytes"},
      {"/accessors/0/byteOffset", "18446744073709551615", "byteOffset is 18446744073709551615, expected an integer"},
      {"/accessors/0/byteOffset", "-4", "accessor 0: byteOffset is -4, expected an integer 0 .. 9007199254740992"},
      {"/accessors/0/componentType", "5124",
       "componentType is 5124, expected one of 5120, 5121, 5122, 5123, 5125, 5126"},
      {"/accessors/0/type", "\"VEC5\"", "accessor 0: type is \"VEC5\", expected one of SCALAR, VEC2"},
      {"/accessors/0/type", "\"VEC2\"", "POSITION (accessor 0) has 2 components an element, expected 3"},
      {"/accessors/0/bufferView", "7", "accessor 0: bufferView is 7, expected an index into bufferViews (3 there)"},
      {"/accessors/1/componentType", "5126", "accessor 1: componentType is 5126, expected a SCALAR of 5121, 5123 or"},
      {"/accessors/1/count", "2", "mesh 0 primitive 0: 2 indices, expected a multiple of 3 for triangles"},
      {"/accessors/2/count", "2", "mesh 0 primitive 0: NORMAL (accessor 2) has 2 elements, expected 3, as many as"},
      {"/accessors/2/componentType", "5125", "NORMAL (accessor 2) has componentType 5125, expected floats or normal"},
      {"/buffers/0/byteLength", "4294967296",
       "buffer 0: byteLength is 4294967296, expected an integer 1 .. 4294967295"},
      {"/buffers/1", R"({"byteLength": 4294967295})",
       "buffers: have 4294967375 bytes together, expected at most 4294967296"},
      {"/nodes/1/name", '"' + std::string(5000, 'n') + '"', "node 1: name is \"nnn"},
      {"/bufferViews/0/buffer", "1", "bufferView 0: buffer is 1, expected an index into buffers (1 there)"},
      {"/bufferViews/0/byteLength", "1000",
       "bufferView 0: 1000 bytes from byte 0, expected to end within the 80 bytes"},
      {"/bufferViews/0/byteOffset", "9007199254740000",
       "bufferView 0: 36 bytes from byte 9007199254740000, expected to"},
      {"/bufferViews/0/byteStride", "2",
       "bufferView 0: byteStride is 2, expected an integer 4 .. 252, a multiple of 4"},
      {"/bufferViews/0/byteStride", "13",
       "bufferView 0: byteStride is 13, expected an integer 4 .. 252, a multiple of 4"},
      {"/bufferViews/0/byteStride", "8", "byteStride of bufferView 0 is 8, expected at least 12, the size of an"},

      {"/meshes/0/primitives", "", "mesh 0: primitives is missing, expected an array"},
      {"/meshes/0/primitives/0/attributes", "{}", "scene: has no triangles, expected a node with a mesh that has some"},
      {"/meshes/0/primitives/0/attributes/POSITION", "9",
       "mesh 0 primitive 0: attributes POSITION is 9, expected an index into accessors (3"},
      {"/meshes/0/primitives/0/indices", "9", "mesh 0 primitive 0: indices is 9, expected an index into accessors (3"},
      {"/meshes/0/primitives/0/material", "1",
       "mesh 0 primitive 0: material is 1, expected an index into materials (1"},
      {"/meshes/0/primitives/0/mode", "7", "mesh 0 primitive 0: mode is 7, expected one of 0, 1, 2, 3, 4, 5, 6"},
      {"/meshes/0/primitives/0/mode", "1", "scene: has no triangles, expected a node with a mesh that has some"},
      {BASE_COLOR + "/index", "5", "material 0 pbrMetallicRoughness baseColorTexture: index is 5, expected an index"},
      {BASE_COLOR + "/texCoord", "-1", "baseColorTexture: texCoord is -1, expected an integer 0 .. 2147483647"},
      {"/materials/0/alphaMode", "\"GLASS\"",
       "material 0: alphaMode is \"GLASS\", expected one of OPAQUE, MASK, BLEND"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[9, 9, 9, 1]",
       "material 0 pbrMetallicRoughness: baseColorFactor is [9,9,9,1], expected 4 numbers 0 .. 1"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1, -1]", "expected 4 numbers 0 .. 1"},
      {"/materials/0/pbrMetallicRoughness/roughnessFactor", "5", "roughnessFactor is 5, expected a number 0 .. 1"},
      {"/materials/0/occlusionTexture", R"({"index": 0, "strength": 2})",
       "material 0 occlusionTexture: strength is 2, expected a number 0 .. 1"},
      {"/materials/0/alphaCutoff", "-1", "material 0: alphaCutoff is -1, expected a number >= 0"},
      {"/materials/0/emissiveFactor", "[0, -1, 0]", "emissiveFactor is [0,-1,0], expected 3 numbers >= 0"},
      {"/materials/0/pbrMetallicRoughness/metallicFactor", "2", "metallicFactor is 2, expected a number 0 .. 1"},
      {"/textures/0/source", "1", "texture 0: source is 1, expected an index into images (1 there)"},
      {"/textures/0/sampler", "1", "texture 0: sampler is 1, expected an index into samplers (1 there)"},
      {"/samplers/0/minFilter", "1", "sampler 0: minFilter is 1, expected one of 9728, 9729, 9984, 9985, 9986, 9987"},
      {"/samplers/0/wrapS", "1", "sampler 0: wrapS is 1, expected one of 10497, 33071, 33648"},
      {"/images/0/mimeType", "7", "image 0: mimeType is 7, expected a string"},
      {"/images/0/uri", "", "image 0: expected either a uri or a bufferView"},
      {"/images/0/uri", "\"data:image/png;base64,AAAA\"", "image 0: cannot be decoded, expected a PNG or JPEG"},
      {"/images/0/uri", "\"data:image/png;base64,!\"", "image 0: the data URI cannot be decoded, expected base64"},
      {"/images/0/uri", "\"data:image/png,x\"", "image 0: uri begins 'data:image/png', expected 'data:TYPE;base64,'"},
      {"/images/0/uri", "\"/etc/x.png\"", "image 0: uri is '/etc/x.png', expected a data URI or a path below the"},
      {"/images/0/uri", "\"%2Fetc/x.png\"", "image 0: uri is '%2Fetc/x.png', expected a data URI or a path below the"},
      {"/images/0/uri", "\"../x.png\"",
       "image 0: uri is '../x.png', expected a data URI or a path below the file's own"},
      {"/images/0/uri", "\"a/../../x.png\"", "image 0: uri is 'a/../../x.png', expected a data URI or a path below"},
      {"/images/0/uri", "\"%2e%2E/x.png\"", "image 0: uri is '%2e%2E/x.png', expected a data URI or a path below the"},
      {"/images/0/uri", "\"x%00.png\"", "image 0: uri is 'x%00.png', expected a data URI or a path below the file's"},
      {"/images/0/uri", "\"\"", "image 0: uri is '', expected a data URI or a path below the file's own folder"},
      {"/images/0/uri", '"' + std::string(5000, 'n') + '"', "image 0: uri is '" + std::string(60, 'n') + "', expected"},
      {"/images/0/uri", "\"x.png\"", "image 0: uri is 'x.png', expected a data URI, as the scene does not come from"},

      {LIGHTS + "/0/type", "\"area\"", "light 0: type is \"area\", expected one of point, spot, directional"},
      {LIGHTS + "/0/range", "-1", "light 0: range is -1, expected a number > 0"},
      {LIGHTS + "/0/range", "0", "light 0: range is 0, expected a number > 0"},
      {LIGHTS + "/0/range", "1e-40", "light 0: range is 1e-40, expected at least 1.17549"},
      {LIGHTS + "/0/range", "\"NaN\"", "light 0: range is \"NaN\", expected a number > 0"},
      {LIGHTS + "/0/intensity", "-2", "light 0: intensity is -2, expected a number >= 0"},
      {LIGHTS + "/0/intensity", "1e300", "light 0: intensity is 1e+300, expected at most 3.4028"},
      {LIGHTS + "/0", R"({"type": "directional", "color": [1e20, 0, 0], "intensity": 1e20})",
       "light 0: color times intensity is inf, expected at most 1e+30"},
      {LIGHTS + "/0", R"({"type": "point", "color": [1e20, 0, 0], "intensity": 1e20})",
       "light 0: color times intensity is inf, expected at most 1e+30"},
      {LIGHTS + "/0/intensity", "3.4e38", "light 0: color times intensity is 3.4e+38, expected at most 1e+30"},
      {LIGHTS + "/0/color", "[1, -1, 0]", "light 0: color is [1,-1,0], expected 3 numbers >= 0"},
      {LIGHTS + "/1/spot", "", "light 1: spot is missing, expected an object"},
      {LIGHTS + "/1/spot/outerConeAngle", "1.6", "light 1: outerConeAngle is 1.6, expected 0 .. pi/2 radians"},
      {LIGHTS + "/1/spot/outerConeAngle", "0", "light 1 spot: outerConeAngle is 0, expected a number > 0"},
      {LIGHTS + "/1/spot/innerConeAngle", "0.6",
       "light 1: innerConeAngle is 0.6, expected at most outerConeAngle, 0.5"},

      {"/cameras/0/type", "\"fisheye\"", "camera 0: type is \"fisheye\", expected one of perspective, orthographic"},
      {"/cameras/0/type", "\"orthographic\"", "camera 0: orthographic is missing, expected an object"},
      {"/cameras/0/perspective/yfov", "4",
       "camera 0: camera 'camera': the vertical field of view must lie between 0 and 3.14 radians, got 4"},
      {"/cameras/0/perspective/yfov", "3.1414180", "must lie between 0 and 3.14 radians, got 3.141418"},
      {"/cameras/0/perspective/znear", "0", "camera 0 perspective: znear is 0, expected a number > 0"},
      {"/cameras/0/perspective/yfov", "0", "camera 0 perspective: yfov is 0, expected a number > 0"},
      {"/cameras/0/perspective/aspectRatio", "0", "camera 0 perspective: aspectRatio is 0, expected a number > 0"},
      {"/cameras/0", R"({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 1, "znear": 0, "zfar": 2}})",
       "camera 0 orthographic: xmag is 0, expected a number > 0"},
      {"/cameras/0", R"({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": -6, "znear": 0, "zfar": 2}})",
       "camera 0 orthographic: ymag is -6, expected a number > 0"},
      {"/cameras/0/perspective/zfar", "1.00000000001", "camera 0: camera 'camera': the far plane must lie beyond"},
      {"/cameras/0/perspective/zfar", "0.5",
       "camera 0: camera 'camera': the far plane must lie beyond the near plane (1 m), got 0.5"},
  };
  return FAULTS;
}

void expect_error(const std::string& text, const std::string& says, const std::filesystem::path& folder = {}) {
  const std::string error = error_text(text, folder);
  EXPECT_TRUE(error.starts_with("test.gltf: ")) << error;
  EXPECT_NE(error.find(says), std::string::npos) << "got:  " << error << "\nwant: " << says;
  EXPECT_EQ(error.find_first_of("\n\r"), std::string::npos) << error;
}

TEST(GltfErrors, TheSceneWithoutFaultsLoads) { EXPECT_EQ(error_text(full_scene().gltf()), ""); }

TEST(GltfErrors, NameTheElementAndWhatWasExpected) {
  for (const Fault& fault : faults()) {
    SCOPED_TRACE(fault.pointer + " = " + fault.value);
    json document = json::parse(full_scene().gltf());
    const json::json_pointer pointer(fault.pointer);
    if (fault.value.empty()) {
      document[pointer.parent_pointer()].erase(pointer.back());
    } else {
      document[pointer] = json::parse(fault.value);
    }
    expect_error(document.dump(), fault.says);
  }
}

TEST(GltfErrors, ContainersThatAreBroken) {
  expect_error("", "the file is empty, expected glTF 2.0");
  expect_error("{\n\"asset\": \n", "asset: is no JSON: parse error at line");
  expect_error("[1e999]", "0: is no JSON: number overflow parsing '1e999'");
  expect_error("7", "is 7, expected an object");
  expect_error(std::string(100000, '['), "is nested too deep, expected at most 64 levels");
  const std::string glb = full_scene().glb();
  EXPECT_EQ(error_text(glb), "");
  const auto changed = [&glb](std::size_t at, char value) {
    std::string copy = glb;
    copy[at] = value;
    return copy;
  };
  expect_error(changed(4, 1), "GLB header: version 1, expected 2");
  expect_error(changed(11, 1), "GLB header: a length of");
  expect_error(changed(15, 1), "GLB chunk at byte 12: a length of");
  expect_error(changed(16, 'X'), "GLB chunk 0: type 0x4e4f5358, expected 0x4e4f534a (JSON)");
  expect_error(glb.substr(0, 8), "GLB header: 8 bytes, expected at least 12");
}

TEST(GltfErrors, EveryTruncationIsAnError) {
  const GltfBuilder builder = full_scene();
  for (const std::string& whole : {builder.glb(), builder.gltf()}) {
    for (std::size_t size = 0; size < whole.size(); size += 7) {
      ASSERT_NE(error_text(whole.substr(0, size)), "") << size << " of " << whole.size() << " bytes";
    }
  }
}

TEST(GltfErrors, DataThatIsWrong) {
  GltfBuilder builder = full_scene();
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(builder.bytes.data() + 16, &not_a_number, 4);
  expect_error(builder.gltf(), "mesh 0 primitive 0: POSITION (accessor 0) of vertex 1 holds nan, expected finite");
  builder = full_scene();
  builder.bytes[40] = std::byte{3};
  expect_error(builder.gltf(), "mesh 0 primitive 0: index 2 (accessor 1) is 3, expected less than the 3 vertices");
  builder = triangle();
  builder.document["accessors"][0]["count"] = 2;
  expect_error(builder.gltf(), "mesh 0 primitive 0: 2 vertices, expected a multiple of 3 for triangles");
  builder.document["meshes"][0]["primitives"][0]["mode"] = 5;
  expect_error(builder.gltf(), "mesh 0 primitive 0: 2 vertices, expected at least 3 for a strip or fan");
  builder = triangle();
  builder.document["buffers"][0] = {{"byteLength", 36}};
  expect_error(builder.document.dump(), "buffer 0: uri is missing, expected one");
}

/// The begin of a PNG of this size: all that is looked at before what images add up to is known.
std::string png_header(std::uint32_t width, std::uint32_t height, char last) {
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  for (const std::uint32_t side : {width, height})
    for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(side >> shift & 0xFFU);
  bytes += last;
  return "data:image/png;base64," + base64(std::as_bytes(std::span(bytes)));
}

TEST(GltfErrors, ImagesThatAreTooLarge) {
  GltfBuilder builder = full_scene();
  builder.document["images"][0]["uri"] = png_header(30000, 30000, 0);
  expect_error(builder.gltf(), "image 0: 30000 x 30000 pixels, expected 1 .. 16384 a side");
  builder.document["images"].clear();
  builder.document["textures"].clear();
  builder.document["materials"].clear();
  for (int i = 0; i < 5; ++i) {
    builder.add("images", {{"uri", png_header(16384, 16384, static_cast<char>(i))}});
    builder.add("textures", {{"source", i}});
    builder.add("materials", {{"emissiveTexture", {{"index", i}}}});
  }
  expect_error(builder.gltf(), "image 4: all images up to it have 1342177280 pixels and ");
  expect_error(builder.gltf(), " bytes, expected at most 1073741824 and 2147483648");
}

TEST(GltfErrors, PrimitivesAreCountedOverAllMeshes) {
  GltfBuilder builder = triangle();
  const json primitive = builder.document["meshes"][0]["primitives"][0];
  const json mesh = {{"primitives", json(std::vector<json>(1000, primitive))}};
  builder.document["meshes"] = std::vector<json>(263, mesh);
  expect_error(builder.gltf(),
               "mesh 262: primitives is an array of 1000 elements, expected an array of objects, at most");
}

TEST(GltfErrors, SparseAccessors) {
  GltfBuilder builder = triangle();
  const int at = builder.view(std::vector<std::uint8_t>{1, 1});
  const int values = builder.view(std::vector<float>{1, 2, 3, 4, 5, 6});
  json& sparse = builder.document["accessors"][0]["sparse"];
  sparse = {{"count", 2},
            {"indices", {{"bufferView", at}, {"componentType", UNSIGNED_BYTE}}},
            {"values", {{"bufferView", values}}}};
  expect_error(builder.gltf(), "accessor 0 sparse indices: index 1 is 1, expected more than the one before");
  sparse["indices"]["bufferView"] = values;
  sparse["indices"]["componentType"] = UNSIGNED_INT;
  expect_error(builder.gltf(), "accessor 0 sparse indices: index 0 is 1065353216, expected more than the one before");
  sparse["count"] = 7;
  expect_error(builder.gltf(), "accessor 0 sparse indices: 7 elements of 4 bytes, 4 apart, from byte 0, expected to");
}

TEST(GltfErrors, ZerosOutOfNothingAreLimited) {
  GltfBuilder builder = triangle();
  builder.document["accessors"][0].erase("bufferView");
  EXPECT_EQ(error_text(builder.gltf()), "");
  builder.document["accessors"][0]["count"] = 3000000000;
  expect_error(builder.gltf(), "accessor 0: count is 3000000000 without a bufferView, expected at most 1048576");
}

TEST(GltfErrors, FilesThatAreNotThere) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "lamp_gltf_errors";
  std::filesystem::create_directories(folder);
  GltfBuilder builder = full_scene();
  builder.document["images"][0] = {{"uri", "missing.png"}};
  expect_error(builder.gltf(), "image 0: file '" + (folder / "missing.png").string() + "': is not there", folder);
  builder.document["images"][0] = {{"uri", "."}};
  expect_error(builder.gltf(), "is a folder, expected a file", folder);
  std::filesystem::remove_all(folder);
  try {
    static_cast<void>(lamp::app::load_gltf(std::filesystem::path("nowhere/scene.gltf")));
    ADD_FAILURE() << "a file that is not there was loaded";
  } catch (const lamp::app::Error& error) {
    EXPECT_STREQ(error.what(), "nowhere/scene.gltf: is not there, expected a glTF file");
    EXPECT_EQ(error.exit(), lamp::app::Exit::bad_input);
  }
}

}  // namespace
