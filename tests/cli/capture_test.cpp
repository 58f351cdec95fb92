// lamp capture, and captures as scenes of the other commands. One comes from court.py, a
// renderer that shares no code with Lamplight and writes it with the script of docs/capture.md: nothing may be missed.
// SPDX-License-Identifier: Apache-2.0
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "cli/cli_test.h"
#include "image/image.h"

namespace lamp::cli {
namespace {

const std::string SCRIPT = std::string(LAMPLIGHT_SOURCE_DIR) + "/tests/cli/court.py";

using Capture = CliTest;

const std::vector<std::string> FILES{"albedo.exr", "depth.exr",    "emission.exr", "frame.json",
                                     "lights.npy", "material.exr", "normal.exr"};

std::vector<std::string> in_folder(const std::string& folder, const std::vector<std::string>& names) {
  std::vector<std::string> paths{folder};
  for (const std::string& name : names) paths.push_back((std::filesystem::path(folder) / name).string());
  return paths;
}

TEST_F(Capture, ComesBackAsTheSamePicture) {
  const std::string text = output_of(small({"capture", "--out", "frame"}));
  EXPECT_NE(text.find("capture   frame, 64x36"), std::string::npos) << text;
  EXPECT_NE(text.find("lights    9: 8 generated"), std::string::npos) << text;
  EXPECT_EQ(files(), in_folder("frame", FILES));
  (void)output_of(small({"render", "--out", "scene.png", "--method", "tiled", "--samples", "1"}));
  (void)output_of({"render", "frame", "--out", "capture.png", "--method", "tiled"});
  (void)output_of({"render", "frame/frame.json", "--out", "file.png", "--method", "tiled"});
  EXPECT_EQ(read("capture.png"), read("scene.png"));
  EXPECT_EQ(read("file.png"), read("scene.png"));
}

TEST_F(Capture, OfACaptureIsTheSame) {
  (void)output_of(small({"capture", "--out", "a"}));
  (void)output_of({"capture", "a", "--out", "b"});
  for (const std::string& name : FILES) EXPECT_EQ(read("b/" + name), read("a/" + name)) << name;
}

TEST_F(Capture, EveryCommandTakesOne) {
  (void)output_of(small({"capture", "--out", "frame", "--lights-as", "json"}));
  EXPECT_FALSE(std::filesystem::exists(path("frame/lights.npy")));
  const nlohmann::json verified = json_of({"verify", "frame", "--method", "tiled", "--method", "all", "--json"});
  for (const nlohmann::json& stats : verified) {
    EXPECT_EQ(stats.at("scene"), "frame");
    EXPECT_EQ(stats.at("width"), 64);
    EXPECT_EQ(stats.at("lights"), 8 + 1);
    EXPECT_EQ(stats.at("missed"), 0);
    EXPECT_GT(stats.at("useful").get<int>(), 0);
  }
  (void)output_of({"compare", "tiled", "clustered", "frame", "--out", "two.png"});
  EXPECT_GE(app::read_png(path("two.png")).width, 4U * 64U);
  for (const char* way : {"forward", "tiled-deferred", "standard-deferred"})
    (void)output_of({"render", "frame", "--path", way});
}

TEST_F(Capture, TakesMoreLightsWhenAsked) {
  (void)output_of(small({"capture", "--out", "frame"}));
  const nlohmann::json more = json_of({"verify", "frame", "--lights", "20", "--method", "clustered", "--json"});
  EXPECT_EQ(more[0].at("lights"), 20 + 8 + 1);
  EXPECT_EQ(more[0].at("missed"), 0);
  const std::vector<Arguments> of_generated{{"--seed", "2"}, {"--spots", "0.5"}, {"--still", "0"}, {"--range", "1:2"}};
  for (const Arguments& option : of_generated) {
    Arguments alone{"render", "frame"};
    alone.insert(alone.end(), option.begin(), option.end());
    expect_error(BAD_INPUT, alone, {option.front(), "no light is generated", "expected --lights N too"});
  }
  expect_error(BAD_INPUT, {"bench", "frame", "--seed", "2"}, {"--seed", "expected --lights N too"});
  expect_error(BAD_INPUT, {"capture", "plane", "--out", "x", "--brdf", "ggx"}, {"option '--brdf'"});
}

TEST_F(Capture, KeepsDecalsInItsSurfaces) {
  const std::string text = output_of(small({"capture", "--out", "frame", "--decals", "60"}));
  EXPECT_NE(text.find("decals    60: "), std::string::npos) << text;
  EXPECT_NE(text.find("kept in albedo and normals"), std::string::npos) << text;
  (void)output_of(small({"capture", "--out", "bare"}));
  EXPECT_NE(read("frame/albedo.exr"), read("bare/albedo.exr"));
  EXPECT_EQ(read("frame/depth.exr"), read("bare/depth.exr"));
  expect_error(BAD_INPUT, {"render", "frame", "--decals", "3"}, {"--decals 3", "the capture frame has its decals"});
  (void)output_of(small({"render", "--decals", "60", "--out", "scene.png", "--method", "tiled", "--samples", "1"}));
  (void)output_of({"render", "frame", "--out", "capture.png", "--method", "tiled"});
  EXPECT_EQ(read("capture.png"), read("scene.png"));
}

TEST_F(Capture, DecalsAreCountedInStats) {
  const nlohmann::json stats = json_of(small({"verify", "--decals", "20", "--method", "tight", "--json"}));
  EXPECT_EQ(stats[0].at("decals"), 20);
  EXPECT_EQ(stats[0].at("decals_missed"), 0);
  EXPECT_EQ(stats[0].at("missed"), 0);
  EXPECT_GE(stats[0].at("decal_evaluations").get<int>(), stats[0].at("decals_useful").get<int>());
  const nlohmann::json without = json_of(small({"verify", "--method", "tight", "--json"}));
  EXPECT_EQ(without[0].at("decals"), 0);
  EXPECT_FALSE(without[0].contains("decals_missed"));
}

TEST_F(Capture, HasOneViewAlone) {
  (void)output_of(small({"capture", "--out", "frame"}));
  expect_error(BAD_INPUT, {"render", "frame", "--size", "65x36"}, {"--size '65x36'", "the capture frame has 64x36"});
  expect_error(BAD_INPUT, {"render", "frame", "--camera", "front"}, {"camera 'front'", "there are capture"});
  expect_error(BAD_INPUT, {"render", "frame", "--frame", "3"}, {"--frame", "the capture frame is one frame"});
  expect_error(BAD_INPUT, {"render", "frame", "--projection", "infinite"}, {"--projection 'infinite'", "has its own"});
  (void)output_of({"render", "frame", "--size", "64x36", "--camera", "capture", "--projection", "camera"});
}

TEST_F(Capture, HasNothingThatCastsAShadow) {
  (void)output_of(small({"capture", "--out", "frame"}));
  for (const Arguments& command :
       {Arguments{"render", "frame"}, Arguments{"verify", "frame"}, Arguments{"compare", "tiled", "all", "frame"},
        Arguments{"bench", "frame", "--out", "measured"}}) {
    Arguments with = command;
    with.insert(with.end(), {"--shadows", "pcf"});
    expect_error(BAD_INPUT, with, {"--shadows pcf: the capture frame has no triangles", "expected off"});
  }
  (void)output_of({"render", "frame", "--shadows", "off"});
}

TEST_F(Capture, FoldersThatCannotBeWritten) {
  expect_error(BAD_INPUT, {"capture", "plane"}, {"--out", "required"});
  expect_error(BAD_INPUT, {"capture", "plane", "--out", "x", "--lights-as", "csv"}, {"--lights-as 'csv'", "json, npy"});
  write("file", "mine");
  expect_error(BAD_INPUT, {"capture", "plane", "--out", "file"}, {"--out 'file'", "is a file, expected a folder"});
  expect_error(BAD_INPUT, {"capture", "plane", "--out", "file/frame"}, {"--out 'file/frame'", "is not a folder"});
  expect_error(BAD_INPUT, {"capture", "plane", "--out", "."}, {"--out '.'", "holds file, expected a new folder"});
  expect_error(BAD_INPUT, {"capture", "nowhere.gltf", "--out", "new"}, {"nowhere.gltf"});
}

TEST_F(Capture, ThatIsDamagedIsBadInput) {
  std::filesystem::create_directory(path("empty"));
  expect_error(BAD_INPUT, {"render", "empty"}, {"empty/frame.json", "is not there"});
  (void)output_of(small({"capture", "--out", "frame"}));
  const std::string frame = read("frame/frame.json");
  nlohmann::json changed = nlohmann::json::parse(frame);
  changed["width"] = 63;
  write("frame/frame.json", changed.dump());
  for (const char* command : {"render", "verify"})
    expect_error(BAD_INPUT, {command, "frame"}, {"frame/depth.exr: is 64x36 pixels, expected 63x36"});
  write("frame/frame.json", frame.substr(0, frame.size() / 2));
  expect_error(BAD_INPUT, {"render", "frame"}, {"frame/frame.json: ", "is no JSON: parse error at line"});
  write("frame/frame.json", frame);
  const std::string depth = read("frame/depth.exr");
  write("frame/depth.exr", depth.substr(0, depth.size() / 2));
  expect_error(BAD_INPUT, {"compare", "tiled", "all", "frame"}, {"frame/depth.exr: "});
  write("frame/depth.exr", depth);
  const std::string lights = read("frame/lights.npy");
  write("frame/lights.npy", lights.substr(0, lights.size() - 4));
  expect_error(BAD_INPUT, {"capture", "frame", "--out", "new"}, {"frame/lights.npy: is truncated"});
}

TEST_F(Capture, OnAFullDiskLeavesNothing) {
  // No file may grow beyond a few kilobytes; the first that is written would.
  write("run.sh", std::string("trap '' XFSZ\nulimit -f 8\ncd '") + path(".").string() + "'\nexec '" + LAMP_EXECUTABLE +
                      "' capture plane --size 320x180 --lights 8 --out new 2>err\n");
  const int status = std::system(("sh '" + path("run.sh").string() + "'").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), BAD_INPUT);
  const std::string line = read("err");
  EXPECT_NE(line.find("cannot be written: File too large"), std::string::npos) << line;
  EXPECT_EQ(std::ranges::count(line, '\n'), 1) << line;
  EXPECT_EQ(files(), (std::vector<std::string>{"err", "run.sh"}));
}

/// A Python that has NumPy; empty if there is none.
std::string python() {
  for (const char* name : {"/usr/bin/python3", "python3"})
    if (std::system((std::string(name) + " -c 'import numpy' 2>/dev/null").c_str()) == 0) return name;
  return {};
}

/// Writes a court to FOLDER and returns how many pairs of pixel and light the other program counted.
double court(const std::string& interpreter, const std::filesystem::path& folder, const std::string& kind) {
  const std::string counted = folder.string() + ".txt";
  const std::string command =
      interpreter + " -B '" + SCRIPT + "' '" + folder.string() + "' " + kind + " >'" + counted + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  double pairs = 0.0;
  std::ifstream(counted) >> pairs;
  std::filesystem::remove(counted);
  return pairs;
}

TEST_F(Capture, FromAnotherProgramMissesNothing) {
  const std::string interpreter = python();
  if (interpreter.empty()) GTEST_SKIP() << "needs Python with NumPy (python3-numpy)";
  const double pairs = court(interpreter, path("court"), "linear");
  EXPECT_GT(pairs, 10000.0);
  EXPECT_EQ(files(), in_folder("court", {"depth.exr", "frame.json", "lights.npy"}));
  const nlohmann::json rows =
      json_of({"verify", "court", "--json", "--method", "all", "--method", "tiled", "--method", "clustered", "--method",
               "drobot-zbin", "--method", "lamplight", "--method", "drobot-raster-cluster", "--method", "world-cells"});
  EXPECT_EQ(rows.size(), 7);
  for (const nlohmann::json& stats : rows) {
    SCOPED_TRACE(stats.at("method").get<std::string>());
    EXPECT_EQ(stats.at("lights"), 200);
    EXPECT_NEAR(stats.at("useful").get<double>(), pairs, 1e-3 * pairs) << "the oracle and the other program disagree";
    EXPECT_EQ(stats.at("missed"), 0);
  }
}

/// Each kind of depth says the same of the same court.
TEST_F(Capture, DepthOfEveryKindFromAnotherProgram) {
  const std::string interpreter = python();
  if (interpreter.empty()) GTEST_SKIP() << "needs Python with NumPy (python3-numpy)";
  for (const char* kind : {"reversed", "standard", "linear"}) {
    SCOPED_TRACE(kind);
    const double pairs = court(interpreter, path(kind), kind);
    const nlohmann::json one = json_of({"verify", kind, "--method", "tight", "--json"});
    EXPECT_EQ(one[0].at("missed"), 0);
    EXPECT_NEAR(one[0].at("useful").get<double>(), pairs, 1e-3 * pairs);
  }
}

}  // namespace
}  // namespace lamp::cli
