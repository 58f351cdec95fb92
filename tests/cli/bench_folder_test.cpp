// What lamp bench does with the results that its folder has: it goes on with those of the same run, measures again what
// files have changed under, and loses nothing without a word.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <span>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using nlohmann::json;

class BenchFolder : public CliTest {
 protected:
  [[nodiscard]] json results() const { return json::parse(read("out/results.json")).at("results"); }

  /// As a run leaves them; then as the same run leaves them once more, when nothing has changed.
  [[nodiscard]] json measured(const Arguments& command) const {
    const std::string first = output_of(command);
    EXPECT_EQ(first.find("again"), std::string::npos) << first;
    return unchanged(command);
  }
  [[nodiscard]] json unchanged(const Arguments& command) const {
    json before = results();
    const std::string text = output_of(command);
    EXPECT_EQ(text.find("again"), std::string::npos) << text;
    EXPECT_EQ(results(), before);
    return before;
  }
  /// A run that says how many results it measures again; those that are there then.
  [[nodiscard]] json measured_again(const Arguments& command, const std::string& how_many) const {
    const std::string text = output_of(command);
    EXPECT_TRUE(text.starts_with("out/results.json: " + how_many + " results are measured again: ")) << text;
    return unchanged(command);
  }

  /// A triangle whose corners are in a file of their own, one of them at (x, 0, 0).
  void write_corners(float x) const {
    const float corners[9] = {0.0F, 0.0F, 0.0F, x, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
    const auto bytes = std::as_bytes(std::span(corners));
    write("corners.bin", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  void write_scene(const std::string& more = "") const {
    write("scene.gltf",
          R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                     "max": [1, 1, 0]}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"byteLength": 36, "uri": "corners.bin"}])" +
              more + "}");
  }
  void write_suite(const std::string& methods) const {
    write("mine.json",
          R"({"version": 1, "name": "mine", "series": [{"name": "small", "methods": )" + methods +
              R"(, "scenes": ["plane"], "sizes": ["16x9"], "lights": [2, 4], "frames": 1, "warm_up": 0}]})");
  }
};

/// One frame of two lights.
Arguments bench_of(const std::string& scene) {
  return {"bench", scene, "--method", "tiled", "--lights", "2", "--frames", "1", "--warm-up", "0", "--out", "out"};
}
const Arguments MINE{"bench", "mine.json", "--out", "out"};

Arguments with(Arguments command, const Arguments& more) {
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

TEST_F(BenchFolder, ASceneWhoseFilesHaveChangedIsMeasuredAgain) {
  const Arguments command = with(bench_of("scene.gltf"), {"--size", "16x9"});
  write_corners(1.0F);
  write_scene();
  const json first = measured(command);
  write_corners(2.0F);
  const json other_corners = measured_again(command, "1 of its 1");
  EXPECT_EQ(other_corners[0].at("key"), first[0].at("key"));
  EXPECT_NE(other_corners[0].at("hashes").at("scene"), first[0].at("hashes").at("scene"));
  EXPECT_NE(other_corners[0].at("times"), first[0].at("times"));
  write_scene(R"(, "extras": "another text")");
  const json other_text = measured_again(command, "1 of its 1");
  EXPECT_NE(other_text[0].at("hashes"), other_corners[0].at("hashes"));
}

TEST_F(BenchFolder, ACaptureThatWasTakenAnewIsMeasuredAgain) {
  const auto capture = [&](const char* lights) {
    (void)output_of({"capture", "plane", "--size", "16x9", "--lights", lights, "--out", "frame"});
  };
  capture("4");
  const json first = measured(bench_of("frame"));
  capture("7");
  const json second = measured_again(bench_of("frame"), "1 of its 1");
  EXPECT_EQ(second[0].at("stats").at("lights"), first[0].at("stats").at("lights").get<int>() + 3);
}

TEST_F(BenchFolder, AnotherCalibrationOfAutoIsMeasuredAgain) {
  write_suite(R"(["auto", "tiled"])");
  json calibration = json::parse(read(LAMPLIGHT_SOURCE_DIR "/tests/calibration.json"));
  write("costs.json", calibration.dump());
  const Arguments command = with(MINE, {"--calibration", "costs.json"});
  const json first = measured(command);
  ASSERT_EQ(first.size(), 4U);
  for (const json& result : first)
    EXPECT_EQ(result.contains("hashes"), result.at("parameters").at("method") == "auto") << result.at("key");
  calibration["candidates"][0]["cull"][0] = 1.5;
  write("costs.json", calibration.dump());
  EXPECT_NE(measured_again(command, "4 of its 4")[0].at("hashes"), first[0].at("hashes"));

  write("costs.json", "{}");
  expect_error(BAD_INPUT, {"bench", "plane", "--method", "auto", "--calibration", "costs.json"},
               {"--calibration 'costs.json'", "format is missing"});
}

TEST_F(BenchFolder, MethodsThatAreAddedMeasureThoseBesideThemAgain) {
  write_suite(R"(["tiled"])");
  (void)measured(MINE);
  write_suite(R"(["tiled", "clustered"])");
  EXPECT_EQ(measured_again(MINE, "2 of its 2").size(), 4U);
}

TEST_F(BenchFolder, WhatAnotherRunWouldLoseIsSaidInsteadOfLost) {
  write_suite(R"(["tiled", "clustered"])");
  const json all = measured(MINE);
  expect_error(BAD_INPUT, with(MINE, {"--max-lights", "2"}),
               {"out/results.json: 2 of its 4 results would be lost", "such as 'small: plane 16x9 lights=4",
                "expected another --out, or --overwrite"});
  expect_error(BAD_INPUT, with(MINE, {"--frames", "2"}), {"4 of its 4 results would be lost", "frames=0+1"});
  write_suite(R"(["clustered"])");
  expect_error(BAD_INPUT, MINE, {"2 of its 4 results would be lost", "| tiled "});
  expect_error(BAD_INPUT, bench_of("plane"), {"holds the suite \"mine\"; expected \"scene\", another --out, or"});
  EXPECT_EQ(results(), all);
}

TEST_F(BenchFolder, AnotherSceneDoesNotTakeTheFolder) {
  const Arguments size{"--size", "16x9"};
  const json first = measured(with(bench_of("plane"), size));
  expect_error(BAD_INPUT, with(bench_of("posts"), size), {"1 of its 1 results would be lost", "'scene: plane 16x9"});
  EXPECT_EQ(results(), first);
}

TEST_F(BenchFolder, OverwriteMeasuresAnew) {
  write_suite(R"(["tiled", "clustered"])");
  const json first = measured(MINE);
  (void)output_of(with(MINE, {"--overwrite"}));
  const json again = results();
  ASSERT_EQ(again.size(), first.size());
  EXPECT_EQ(again[0].at("key"), first[0].at("key"));
  EXPECT_NE(again[0].at("times"), first[0].at("times"));
  (void)output_of(with(MINE, {"--overwrite", "--max-lights", "2"}));
  EXPECT_EQ(results().size(), 2U);
  (void)output_of(with(bench_of("plane"), {"--size", "16x9", "--overwrite"}));
  EXPECT_EQ(results().size(), 1U) << "of another suite";
  write("out/results.json", "torn {");
  (void)output_of(with(MINE, {"--overwrite"}));
  EXPECT_EQ(results().size(), 4U);
}

}  // namespace
}  // namespace lamp::cli
