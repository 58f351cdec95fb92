// lamp render --state: a file holds what options say, options change what the file says, and what is wrong is named.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using StateTest = CliTest;

constexpr const char* STATE = R"({"version": 1, "scene": "plane", "size": "48x27", "lights": 40, "seed": 3,
  "method": "tiled", "options": {"tile": "32"}, "exposure": "0.5"})";
const Arguments OPTIONS{"render", "plane",    "--size", "48x27",    "--lights", "40",         "--seed",
                        "3",      "--method", "tiled",  "--option", "tile=32",  "--exposure", "0.5"};

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(StateTest, MakesThePictureOfTheSameOptions) {
  write("state.json", STATE);
  static_cast<void>(output_of({"render", "--state", "state.json", "-o", "state.exr"}));
  static_cast<void>(output_of(with(OPTIONS, {"-o", "options.exr"})));
  EXPECT_EQ(read("state.exr"), read("options.exr"));
  static_cast<void>(output_of({"render", "--state", "state.json", "--samples", "1", "-o", "one.exr"}));
  EXPECT_NE(read("state.exr"), read("one.exr")) << "what a state does not say is the default";
}

TEST_F(StateTest, IsChangedByOptions) {
  write("state.json", STATE);
  const nlohmann::json json = json_of({"render", "--seed", "4", "--lights", "7", "--state", "state.json", "--json"});
  EXPECT_EQ(json.at("lights"), 7 + 1);
  EXPECT_EQ(json.at("method"), "tiled");
  EXPECT_EQ(json.at("options").at("tile"), "32");
  EXPECT_EQ(json.at("width"), 48);
}

TEST_F(StateTest, KeepsOptionsOfItsMethodThatAreNotGivenAnew) {
  write("state.json", STATE);
  const nlohmann::json more =
      json_of({"render", "--state", "state.json", "--option", "bounds=mask", "--json", "-o", "a.png"});
  EXPECT_EQ(more.at("options").at("tile"), "32");
  EXPECT_EQ(more.at("options").at("bounds"), "mask");
  const Outcome other = lamp({"render", "--state", "state.json", "--method", "clustered", "--json", "-o", "b.png"});
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_EQ(other.err, "--method clustered: the state's tile=32 is of tiled, and left out\n");
  EXPECT_EQ(lamp({"render", "--state", "state.json", "--method", "auto", "-o", "c.png"}).exit_code, 0);
}

// A frame moves the lights too; a camera leaves them where they are. Both leave a free camera.
TEST_F(StateTest, GoesToTheCameraAndTheFrameThatAreGiven) {
  const std::string plane = R"({"version": 1, "scene": "plane", "size": "48x27", "lights": 40, "method": "tiled",)";
  write("free.json", plane + R"("light_frame": 9, "free_camera": {"eye": [0, 3, 0], "yaw": 1.5, "pitch": -0.25,
    "near": 0.05, "far": 0, "fov_y": 1}})");
  write("camera.json", plane + R"("light_frame": 9, "camera": "front"})");
  write("frame.json", plane + R"("frame": 9})");
  const auto picture = [&](const Arguments& arguments) {
    static_cast<void>(output_of(with({"render"}, with(arguments, {"--samples", "1", "-o", "picture.exr"}))));
    return read("picture.exr");
  };
  const Arguments plain{"plane", "--size", "48x27", "--lights", "40", "--method", "tiled", "--frame", "30"};
  EXPECT_EQ(picture({"--state", "free.json", "--frame", "30"}), picture(plain));
  EXPECT_EQ(picture({"--state", "frame.json", "--frame", "30"}), picture(plain));
  EXPECT_EQ(picture({"--state", "free.json", "--camera", "front"}), picture({"--state", "camera.json"}));
  EXPECT_EQ(picture({"--state", "frame.json", "--camera", "front"}), picture({"--state", "camera.json"}));
  static_cast<void>(
      output_of({"render", "--state", "frame.json", "--frames", "30..30", "--samples", "1", "-o", "flight.exr"}));
  EXPECT_EQ(read("flight-0030.exr"), picture(plain));
}

TEST_F(StateTest, IsNotWrittenOver) {
  write("state.json", STATE);
  expect_error(BAD_INPUT, {"render", "--state", "state.json", "--stats", "state.json"}, {"state.json: is the --state"});
}

TEST_F(StateTest, PutsCameraAndLightsWhereItSays) {
  write("still.json", STATE);
  write("moved.json", R"({"version": 1, "scene": "plane", "size": "48x27", "lights": 40, "seed": 3, "method": "tiled",
    "options": {"tile": "32"}, "exposure": "0.5", "light_frame": 30})");
  write("edited.json", R"({"version": 1, "scene": "plane", "size": "48x27", "lights": 40, "seed": 3, "method": "tiled",
    "options": {"tile": "32"}, "exposure": "0.5", "edits": [{"light": 39, "type": "point", "position": [0, 2, 0],
    "color": [1, 0, 0], "intensity": 1e4}]})");
  write("free.json", R"({"version": 1, "scene": "plane", "size": "48x27", "lights": 40, "seed": 3, "method": "tiled",
    "options": {"tile": "32"}, "exposure": "0.5", "free_camera": {"eye": [0, 3, 0], "yaw": 1.5, "pitch": -0.25,
    "near": 0.05, "far": 0, "fov_y": 1}})");
  std::vector<std::string> pictures;
  for (const std::string name : {"still", "moved", "edited", "free"}) {
    static_cast<void>(output_of({"render", "--state", name + ".json", "-o", name + ".exr"}));
    pictures.push_back(read(name + ".exr"));
  }
  for (std::size_t i = 1; i < pictures.size(); ++i) EXPECT_NE(pictures[0], pictures[i]);
}

TEST_F(StateTest, SaysWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"[]", "is [], expected an object"},
      {"{}", "version is missing, expected a whole number 1 .. 1"},
      {R"({"version": 2})", "version is 2, expected a whole number 1 .. 1"},
      {R"({"version": 1, "sise": "4x4"})", "\"sise\" is not a key of the format; the nearest are size"},
      {R"({"version": 1, "overlay": "het"})", "overlay is \"het\", expected one of none, heat"},
      {R"({"version": 1, "method": "tild"})", "method"},
      {R"({"version": 1, "options": {"tile": 8}})", "options: tile is 8, expected a text"},
      {R"({"version": 1, "lights": -1})", "lights is -1, expected a whole number"},
      {R"({"version": 1, "spots": 2})", "spots is 2, expected 0 .. 1"},
      {R"({"version": 1, "frame": "x"})", "frame is \"x\", expected a whole number"},
      {R"({"version": 1, "projection": "round"})", "projection"},
      {R"({"version": 1, "picked": [1.5, 2]})", "picked is [1.5,2], expected two whole numbers"},
      {R"({"version": 1, "free_camera": {"eye": [0, 0]}})", "free_camera: eye has 2 elements"},
      {R"({"version": 1, "free_camera": {"eye": [0, 0, 0], "yaw": 0, "pitch": 0, "near": 0, "far": 0, "fov_y": 1}})",
       "free_camera: near is 0 and far 0, expected near > 0 m"},
      {R"({"version": 1, "free_camera": {"eye": [0, 0, 0], "yaw": 0, "pitch": 0, "near": 0.1, "far": -1, "fov_y": 1}})",
       "free_camera: near is 0.1 and far -1, expected near > 0 m"},
      {R"({"version": 1, "edits": [{"light": 0, "type": "sun"}]})", "edits 0: type is \"sun\", expected point or spot"},
      {R"({"version": 1, "against": {"method": "nil"}})", "method"},
  };
  for (const auto& [text, says] : faults) {
    write("bad.json", text);
    expect_error(BAD_INPUT, {"render", "--state", "bad.json"}, {"bad.json: ", says});
  }
  expect_error(BAD_INPUT, {"render", "--state", "missing.json"}, {"missing.json"});
}

// As without a state, options of shadows need some.
TEST_F(StateTest, MayHaveNoShadowsThatOptionsAreOf) {
  write("cut.json", R"({"version": 1, "lights": 16, "method": "lamplight", "options": {"occlusion": "radial"}})");
  expect_error(BAD_INPUT, {"render", "--state", "cut.json"}, {"occlusion=radial", "expected --shadows FILTER too"});
  write("none.json", R"({"version": 1, "lights": 16})");
  for (const Arguments& option : {Arguments{"--atlas", "1024"}, Arguments{"--shadow-blur", "lines"}})
    expect_error(BAD_INPUT, with({"render", "--state", "none.json"}, option),
                 {option.front(), "expected --shadows FILTER too"});
  write("hard.json", R"({"version": 1, "lights": 16, "shadows": "hard"})");
  expect_error(BAD_INPUT, {"render", "--state", "hard.json", "--shadow-blur", "lines"}, {"--shadow-blur", "vsm"});
}

TEST_F(StateTest, NamesALightThatIsNotThere) {
  write("state.json", R"({"version": 1, "lights": 4, "size": "16x9", "method": "all", "edits": [{"light": 4,
    "type": "point", "position": [0, 0, 0], "color": [1, 1, 1], "intensity": 1}]})");
  expect_error(BAD_INPUT, {"render", "--state", "state.json"}, {"edits: light 4", "expected one of the 4"});
}

TEST_F(StateTest, NamesALightThatIsTooBright) {
  write("bright.json", R"({"version": 1, "lights": 4, "size": "16x9", "method": "all", "edits": [{"light": 1,
    "type": "point", "position": [0, 0, 0], "color": [1, 1, 1], "intensity": 3.4e38}]})");
  expect_error(BAD_INPUT, {"render", "--state", "bright.json"},
               {"edits: light 1: color times intensity must be at most 1e+30 candela, got 3.4e+38"});
}

}  // namespace
}  // namespace lamp::cli
