// --depth and --depth-samples: every method misses nothing at any sample, whichever way depth runs; bench takes both;
// what they do not go with is refused.
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

constexpr int NO_DEVICE = 3;

using DepthTest = CliTest;

const Arguments SMALL{"--lights", "70", "--size", "37x23"};

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(DepthTest, NoMethodMissesALightAtAnySample) {
  const auto rows = json_of(with({"verify", "posts", "--depth", "standard", "--depth-samples", "4", "--json"}, SMALL));
  EXPECT_GE(rows.size(), 20);
  for (const auto& row : rows) {
    SCOPED_TRACE(row.at("method"));
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

TEST_F(DepthTest, IsMeasured) {
  static_cast<void>(output_of(with({"bench", "plane", "--method", "tiled", "--depth", "standard", "--depth-samples",
                                    "4", "--frames", "1", "--warm-up", "0", "--out", "folder"},
                                   SMALL)));
  const auto result = nlohmann::json::parse(read("folder/results.json")).at("results").at(0);
  EXPECT_EQ(result.at("verdict"), "exact");
  EXPECT_EQ(result.at("parameters").at("depth"), "standard");
  EXPECT_EQ(result.at("parameters").at("depth_samples"), 4);
  EXPECT_NE(result.at("key").get<std::string>().find(" depth=standard depth_samples=4 "), std::string::npos);
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
  static_cast<void>(output_of(with({"capture", "plane", "--out", "folder"}, SMALL)));
  expect_error(BAD_INPUT, {"verify", "folder", "--depth", "standard"}, {"--depth standard", "expected reversed"});
  expect_error(BAD_INPUT, {"verify", "folder", "--depth-samples", "4"}, {"--depth-samples 4", "expected 1"});
}

}  // namespace
}  // namespace lamp::cli
