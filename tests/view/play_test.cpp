// Plays every script below tests/view/scripts on one device with validation on, and holds pictures that are saved
// against what `lamp render` makes.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "system/run_program.h"
#include "view/view_test.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

fs::path scripts() { return fs::path(LAMPLIGHT_SOURCE_DIR) / "tests/view/scripts"; }

std::vector<std::string> script_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(scripts())) names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class Play : public InFolder {
 protected:
  static void play_script(const std::vector<ScriptLine>& script) {
    run_headless(view_context(), small_viewer(), [&](Player& player) { play(player, script); });
  }
};

class PlayScript : public Play, public ::testing::WithParamInterface<std::string> {};

TEST_P(PlayScript, MeetsItsExpectations) {
  try {
    play_script(read_script(scripts() / (GetParam() + ".jsonl")));
  } catch (const Error& error) {
    ADD_FAILURE() << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlayScript, ::testing::ValuesIn(script_names()),
                         [](const auto& test) { return test.param; });

TEST_F(Play, EndsWhereAnExpectationIsNotMet) {
  try {
    play_script(parse_script(R"({"expect": {"/method": "clustered"}})", "wrong"));
    FAIL() << "the method is tiled";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::check_failed);
    EXPECT_STREQ(error.what(), "wrong: line 1: /method is \"tiled\", expected \"clustered\"");
  }
}

TEST_F(Play, WidgetsAreClickedWhereTheyAreInSight) {
  HeadlessInfo info = small_viewer();
  info.screen = {720, 4};
  try {
    run_headless(view_context(), info,
                 [](Player& player) { play(player, parse_script(R"({"click": "prove the picture"})", "small")); });
    FAIL() << "the screen has no room for it";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::check_failed);
    EXPECT_STREQ(error.what(), "small: line 1: prove the picture cannot be scrolled into sight");
  }
}

TEST_F(Play, AScreenIsNoLargerThanTheDevicesImages) {
  HeadlessInfo info = small_viewer();
  const std::uint32_t limit = view_context().device().traits.max_image_size;
  info.screen = {20, limit + 1};
  try {
    run_headless(view_context(), info, [](Player& player) { play(player, parse_script(R"({"wait": 1})", "large")); });
    FAIL() << "the device has no such image";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              fmt::format("screen of 20x{}: expected at most {} pixels a side on this device", limit + 1, limit));
  }
}

/// A picture that is saved, a state that is saved, and what `lamp render` makes of that state and of the options.
TEST_F(Play, SavesThePictureOfLampRender) {
  const nlohmann::json state = nlohmann::json::parse(R"({"scene": "posts", "lights": 90, "seed": 4, "light_frame": 17,
    "depth": "standard", "depth_samples": 4, "exposure": "0.7", "method": "clustered", "free_camera": {"eye": [0.5, 2, 6], "yaw": 0.25, "pitch": -0.125,
    "near": 0.05, "far": 0, "fov_y": 1}, "edits": [{"light": 3, "type": "spot", "position": [0, 3, 0],
    "color": [1, 0.2, 0.1], "intensity": 80, "range": 9, "direction": [0, -1, 0.1], "inner_angle": 0.3,
    "outer_angle": 0.6}]})");
  play_script(parse_script(nlohmann::json{{"set", state}}.dump() + R"(
{"wait": "idle"}
{"save_state": "state.json"}
{"save_picture": "view.exr"}
{"save_picture": "view.png"})",
                           "picture"));
  for (const std::string extension : {".exr", ".png"}) {
    const ProgramResult run =
        run_program({LAMP_EXECUTABLE, "render", "--state", "state.json", "-o", "lamp" + extension});
    ASSERT_TRUE(run.succeeded) << run.err;
    EXPECT_EQ(bytes_of_file("view" + extension), bytes_of_file("lamp" + extension)) << extension;
  }
}

/// With shadows, and depth of several samples.
TEST_F(Play, SavesThePictureOfLampRenderWithShadows) {
  const std::string states[] = {R"({"shadows": "pcf", "atlas": 512})", R"({"depth": "standard", "depth_samples": 4})"};
  for (const std::string& set : states) {
    play_script(parse_script("{\"set\": " + set + "}\n{\"wait\": \"idle\"}\n" + R"({"save_state": "state.json"}
{"save_picture": "view.exr"})",
                             "picture"));
    const ProgramResult run = run_program({LAMP_EXECUTABLE, "render", "--state", "state.json", "-o", "lamp.exr"});
    ASSERT_TRUE(run.succeeded) << run.err;
    EXPECT_EQ(bytes_of_file("view.exr"), bytes_of_file("lamp.exr")) << set;
  }
}

TEST_F(Play, SavesThePictureOfTheSameOptions) {
  play_script(parse_script("{\"wait\": \"idle\"}\n{\"save_picture\": \"view.exr\"}", "picture"));
  const ProgramResult run = run_program({LAMP_EXECUTABLE, "render", "plane", "--size", "96x54", "--lights", "32",
                                         "--method", "tiled", "--samples", "1", "-o", "lamp.exr"});
  ASSERT_TRUE(run.succeeded) << run.err;
  EXPECT_EQ(bytes_of_file("view.exr"), bytes_of_file("lamp.exr"));
}

/// The frames of a flight, and a capture with a changed light, as `lamp` makes them.
TEST_F(Play, SavesFlightAndCaptureOfLamp) {
  const nlohmann::json state = nlohmann::json::parse(R"({"edits": [{"light": 5, "type": "point", "position": [0, 1, 0],
    "color": [1, 0.3, 0.1], "intensity": 80, "range": 9}], "exposure": "0.7"})");
  play_script(parse_script(nlohmann::json{{"set", state}}.dump() + R"(
{"wait": "idle"}
{"save_state": "state.json"}
{"click": "save flight"}
{"wait": "idle"}
{"click": "save capture"}
{"wait": "idle"})",
                           "flight"));
  const std::string lamp = LAMP_EXECUTABLE;
  ProgramResult run = run_program({lamp, "render", "--state", "state.json", "--frames", "28..29", "-o", "lamp.png"});
  ASSERT_TRUE(run.succeeded) << run.err;
  for (const char* frame : {"-0028.png", "-0029.png"})
    EXPECT_EQ(bytes_of_file("lamp-view" + std::string(frame)), bytes_of_file("lamp" + std::string(frame))) << frame;
  run = run_program({lamp, "render", "lamp-view-capture", "--exposure", "0.7", "-o", "capture.exr"});
  ASSERT_TRUE(run.succeeded) << run.err;
  run = run_program({lamp, "render", "--state", "state.json", "-o", "scene.exr"});
  ASSERT_TRUE(run.succeeded) << run.err;
  EXPECT_EQ(bytes_of_file("capture.exr"), bytes_of_file("scene.exr"));
}

/// A capture that is dropped, and its state.
TEST_F(Play, SavesThePictureOfACapture) {
  play_script(parse_script(R"({"set": {"range": "1:3", "spots": 0.25}}
{"wait": "idle"}
{"click": "save capture"}
{"wait": "idle"}
{"drop": "lamp-view-capture"}
{"wait": "idle"}
{"expect": {"/shown/scene": "lamp-view-capture", "/shown/lights": 33, "/lights": 32, "/error": ""}}
{"save_state": "state.json"}
{"save_picture": "view.exr"}
{"set": {"scene": "plane"}}
{"wait": "idle"}
{"expect": {"/shown/lights": 33}})",
                           "capture"));
  const ProgramResult run = run_program({LAMP_EXECUTABLE, "render", "--state", "state.json", "-o", "lamp.exr"});
  ASSERT_TRUE(run.succeeded) << run.err;
  EXPECT_EQ(bytes_of_file("view.exr"), bytes_of_file("lamp.exr"));
}

/// What stands in the window is what `lamp` prints, but for times and the clock, of which it is said alike if it is
/// told.
TEST_F(Play, ReportsTheNumbersOfLamp) {
  const ProgramResult run = run_program({LAMP_EXECUTABLE, "render", "plane", "--size", "96x54", "--lights", "32",
                                         "--method", "tiled", "--samples", "1", "--json"});
  ASSERT_TRUE(run.succeeded) << run.err;
  const nlohmann::json lamp = nlohmann::json::parse(run.out);
  nlohmann::json expected;
  for (const char* key :
       {"method", "options", "path", "width", "height", "lights", "bytes", "cells", "overflowed_cells"})
    expected[key] = lamp.at(key);
  ASSERT_TRUE(lamp.contains("clock_mhz"));
  if (lamp.contains("clock_mhz_reason")) expected["clock_mhz_reason"] = lamp.at("clock_mhz_reason");
  nlohmann::json pointers;
  const nlohmann::json flat = expected.flatten();
  for (const auto& [pointer, value] : flat.items()) pointers["/shown" + pointer] = value;
  const std::string line = nlohmann::json{{"expect", pointers}}.dump();
  EXPECT_NO_THROW(play_script(parse_script("{\"wait\": \"idle\"}\n" + line, "numbers")));
}

}  // namespace
}  // namespace lamp::app
