// lamp info: of every kind of scene, in words and as JSON.
// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <utility>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using Info = CliTest;
using nlohmann::json;

TEST_F(Info, OfABuiltInScene) {
  const json plane = json_of({"info", "plane", "--json"});
  EXPECT_EQ(plane.at("kind"), "built-in");
  EXPECT_EQ(plane.at("triangles"), 2);
  EXPECT_EQ(plane.at("flight_frames"), 300);
  EXPECT_EQ(plane.at("cameras").at(0).at("name"), "front");
  EXPECT_EQ(plane.at("lights").at("point"),
            (json{{"count", 1}, {"unlimited", 0}, {"min_range", 1000.0}, {"max_range", 1000.0}}));
  EXPECT_EQ(plane.at("lights").at("spot").at("count"), 0);
  EXPECT_TRUE(plane.at("lights").at("spot").at("min_range").is_null());
  EXPECT_EQ(plane.at("bounds"), (json{{"min", {-10.0, 0.0, -10.0}}, {"max", {10.0, 0.0, 10.0}}}));
  const std::string text = output_of({"info", "plane"});
  for (const char* part : {"plane (built-in)", "front", "--frame 0 to 299", "1, range 1000.00 to 1000.00 m",
                           "20.00 x 0.00 x 20.00 m", "2 in 1 meshes"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in " << text;
  for (const json& scene : json_of({"list", "scenes", "--json"})) {
    const json found = json_of({"info", scene.at("name"), "--json"});
    EXPECT_GT(found.at("triangles"), 0) << scene;
  }
}

TEST_F(Info, OfAFile) {
  const std::string folder = LAMPLIGHT_SOURCE_DIR "/tests/fuzz/corpus_gltf/";
  const json triangle = json_of({"info", folder + "triangle.glb", "--json"});
  EXPECT_EQ(triangle.at("kind"), "glTF");
  EXPECT_EQ(triangle.at("triangles"), 1);
  const json lights = json_of({"info", folder + "lights.gltf", "--json"}).at("lights");
  const int all = lights.at("point").at("count").get<int>() + lights.at("spot").at("count").get<int>() +
                  lights.at("directional").at("count").get<int>();
  EXPECT_GT(all, 0);
  EXPECT_NE(output_of({"info", folder + "lights.gltf"}).find("(glTF)"), std::string::npos);
}

TEST_F(Info, OfVerySmallAndVeryLargeNumbers) {
  std::ifstream file(LAMPLIGHT_SOURCE_DIR "/tests/fuzz/corpus_gltf/lights.gltf");
  json scene = json::parse(file);
  for (const auto& [range, says] :
       {std::pair(1e30, "1, 1 without a range"), std::pair(1e17, "range 1e+17 to 1e+17 m"),
        std::pair(1e-20, "range 1e-20 to 1e-20 m"), std::pair(5.0, "range 5.00 to 5.00 m")}) {
    scene["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = range;
    write("scene.gltf", scene.dump());
    const std::string text = output_of({"info", "scene.gltf"});
    EXPECT_NE(text.find(says), std::string::npos) << says << " is not in " << text;
  }
}

TEST_F(Info, OfACapture) {
  (void)output_of(small({"capture", "--out", "frame"}));
  const json frame = json_of({"info", "frame", "--json"});
  EXPECT_EQ(frame.at("kind"), "capture");
  EXPECT_TRUE(frame.at("flight_frames").is_null());
  EXPECT_EQ(frame.at("width"), 64);
  EXPECT_EQ(frame.at("height"), 36);
  EXPECT_EQ(
      frame.at("lights").at("point").at("count").get<int>() + frame.at("lights").at("spot").at("count").get<int>(),
      8 + 1);
  const int covered = frame.at("covered_pixels");
  EXPECT_GT(covered, 0);
  EXPECT_LE(covered, 64 * 36);
  // What it shows lies on the plane, which is 20 m wide.
  for (const char* end : {"min", "max"}) {
    EXPECT_NEAR(frame.at("bounds").at(end).at(1).get<double>(), 0.0, 1e-3);
    EXPECT_LE(std::abs(frame.at("bounds").at(end).at(0).get<double>()), 10.001);
  }
  EXPECT_NE(output_of({"info", "frame"}).find("64x36, surfaces on "), std::string::npos);
}

TEST_F(Info, OfWhatIsNone) {
  expect_error(BAD_INPUT, {"info"}, {"scene is required"});
  expect_error(BAD_INPUT, {"info", "nowhere.gltf"}, {"nowhere.gltf"});
}

}  // namespace
}  // namespace lamp::cli
