// --depth, --depth-samples, --stereo, --views: every method misses nothing at any sample of any view, whichever way
// depth runs; bench takes the first two; what they do not go with is refused.
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

constexpr int NO_DEVICE = 3;

using DepthTest = CliTest;

const Arguments SMALL{"--lights", "70", "--size", "37x23"};
// One of each kind of list; tests/gpu has them all.
const Arguments OF_EACH_KIND{"--method",  "tiled",    "--method",           "clustered", "--method",
                             "lamplight", "--method", "drobot-raster-tile", "--method",  "world-cells"};

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(DepthTest, NoMethodMissesALightAtAnySampleOfAnyView) {
  const auto rows = json_of(
      with(with({"verify", "posts", "--views", "3", "--depth", "standard", "--depth-samples", "4", "--json"}, SMALL),
           OF_EACH_KIND));
  EXPECT_EQ(rows.size(), 5);
  for (const auto& row : rows) {
    SCOPED_TRACE(row.at("method"));
    EXPECT_EQ(row.at("views"), 3);
    if (!row.at("approximate").get<bool>()) {
      EXPECT_EQ(row.at("missed"), 0);
    }
  }
}

TEST_F(DepthTest, VerifiesDecalsAtEverySample) {
  const auto rows = json_of(with({"verify", "plane", "--decals", "8", "--depth", "standard", "--depth-samples", "4",
                                  "--method", "lamplight", "--json"},
                                 SMALL));
  EXPECT_EQ(rows.at(0).at("missed"), 0);
  EXPECT_GT(rows.at(0).at("decals"), 0);
}

TEST_F(DepthTest, BothEyesShareThePicture) {
  const Arguments even{"--lights", "70", "--size", "38x24", "--method", "lamplight"};
  const auto stats = json_of(with(
      {"render", "posts", "--stereo", "0.5", "--samples", "1", "--heatmap", "heat.png", "--out", "eyes.png", "--json"},
      even));
  EXPECT_EQ(stats.at("views"), 2);
  EXPECT_EQ(stats.at("width"), 19);
  EXPECT_EQ(size_of_png(read("eyes.png")), std::pair(38U, 24U));
  EXPECT_EQ(size_of_png(read("heat.png")).first, 38U);
  const auto rows = json_of(with({"verify", "posts", "--stereo", "0.5", "--depth-samples", "4", "--json"}, even));
  EXPECT_EQ(rows.at(0).at("missed"), 0);
}

// Clusters are looked up at each picture's own depth.
TEST_F(DepthTest, IsMeasured) {
  write("hosts.json", R"({"version": 1, "name": "hosts", "series": [
    {"name": "samples", "methods": ["clustered"], "scenes": ["posts"], "sizes": ["38x24"], "lights": [70],
     "depth": "standard", "depth_samples": 4, "frames": 1, "warm_up": 0},
    {"name": "eyes", "methods": ["clustered"], "scenes": ["posts"], "sizes": ["38x24"], "lights": [70],
     "stereo": 0.5, "frames": 1, "warm_up": 0},
    {"name": "hosts", "methods": [{"name": "clustered", "host": "culler"}, {"name": "clustered", "host": "larger-plan"},
                                  {"name": "clustered", "host": "changing-size"}],
     "scenes": ["posts"], "sizes": ["38x24"], "lights": [70], "frames": 1, "warm_up": 0}]})");
  static_cast<void>(output_of({"bench", "hosts.json", "--out", "folder"}));
  const auto results = nlohmann::json::parse(read("folder/results.json")).at("results");
  ASSERT_EQ(results.size(), 5);
  for (const auto& result : results) {
    SCOPED_TRACE(result.at("key"));
    EXPECT_EQ(result.at("verdict"), "exact");
    EXPECT_GT(result.at("times").at("cull").at("median"), 0.0);
  }
  EXPECT_EQ(results.at(0).at("parameters").at("depth"), "standard");
  EXPECT_EQ(results.at(0).at("parameters").at("depth_samples"), 4);
  EXPECT_NE(results.at(0).at("key").get<std::string>().find(" depth=standard depth_samples=4 "), std::string::npos);
  EXPECT_EQ(results.at(1).at("parameters").at("stereo"), 0.5);
  EXPECT_EQ(results.at(2).at("parameters").at("host"), "culler");
  EXPECT_NE(results.at(4).at("key").get<std::string>().find(" host=changing-size "), std::string::npos);
}

TEST_F(DepthTest, IsMeasuredOnAScene) {
  static_cast<void>(output_of(with({"bench", "plane", "--method", "tiled", "--depth", "standard", "--depth-samples",
                                    "4", "--frames", "1", "--warm-up", "0", "--out", "folder"},
                                   SMALL)));
  const auto result = nlohmann::json::parse(read("folder/results.json")).at("results").at(0);
  EXPECT_EQ(result.at("parameters").at("depth_samples"), 4);
}

TEST_F(DepthTest, WhatDoesNotGoTogetherIsRefused) {
  expect_error(BAD_INPUT, {"verify", "--depth", "standart"}, {"--depth 'standart'", "nearest are standard, "});
  expect_error(BAD_INPUT, {"verify", "--depth-samples", "3"}, {"--depth-samples 3", "expected 1, 2, 4 or 8"});
  expect_error(BAD_INPUT, {"verify", "plane", "--depth-samples", "4", "--verifier", "gpu"}, {"--verifier gpu"});
  expect_error(BAD_INPUT, {"render", "plane", "--depth-samples", "4", "--samples", "2"},
               {"--samples: got 2", "--depth-samples 4"});
  expect_error(BAD_INPUT, {"bench", "quick", "--depth-samples", "4"}, {"--depth-samples: belongs to a scene"});
  expect_error(BAD_INPUT, {"compare", "tiled", "tight", "plane", "--depth", "standard"}, {"--depth"});
  expect_error(NO_DEVICE, with({"render", "plane", "--depth-samples", "8", "--device", "llvmpipe"}, SMALL),
               {"depth of 8 samples a pixel", "has depth images of 1, 4"});
  expect_error(BAD_INPUT, with({"render", "plane", "--stereo", "0.064"}, SMALL), {"--size 37x23", "even width"});
  expect_error(BAD_INPUT, {"verify", "plane", "--views", "9"}, {"--views", "1 to 8"});
  expect_error(BAD_INPUT, {"verify", "plane", "--views", "3", "--stereo", "1"}, {"--views 3", "--stereo"});
  expect_error(BAD_INPUT, {"verify", "plane", "--views", "2", "--verifier", "gpu"},
               {"--verifier gpu", "several views"});
  static_cast<void>(output_of(with({"capture", "plane", "--out", "folder"}, SMALL)));
  expect_error(BAD_INPUT, {"verify", "folder", "--views", "2"}, {"--views", "is one view"});
  expect_error(BAD_INPUT, {"verify", "folder", "--depth", "standard"}, {"--depth standard", "expected reversed"});
  expect_error(BAD_INPUT, {"verify", "folder", "--depth-samples", "4"}, {"--depth-samples 4", "expected 1"});
}

}  // namespace
}  // namespace lamp::cli
