// Mirrored light on the command line: numbers, checks, things that move, and what is wrong in one line.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using MirrorOption = CliTest;

TEST_F(MirrorOption, IsCountedAndChecked) {
  const Outcome run = lamp({"verify", "corridor", "--lights", "100", "--size", "64x36", "--method", "lamplight",
                            "--mirror", "0.8", "--moving", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at(0);
  EXPECT_EQ(row.at("image_max_abs_diff"), 0.0);
  const nlohmann::json& mirror = row.at("mirror");
  EXPECT_EQ(mirror.at("lists"), "world-cells");
  EXPECT_GT(mirror.at("rays"), 100);
  EXPECT_EQ(mirror.at("ended"), 0);
  const nlohmann::json& check = mirror.at("check");
  EXPECT_EQ(check.at("verdict"), "ok") << check.at("reason");
  EXPECT_EQ(check.at("wrong"), 0);
  EXPECT_EQ(check.at("lists").at("missed"), 0);
  EXPECT_GT(check.at("lists").at("useful"), 0);
}

TEST_F(MirrorOption, IsCheckedInEveryViewAndSample) {
  for (const Arguments& pictures : {Arguments{"--stereo", "0.064"}, Arguments{"--depth-samples", "4"}}) {
    SCOPED_TRACE(pictures.front());
    Arguments verify{"verify",   "corridor", "--lights", "20",  "--size", "64x36",
                     "--method", "tiled",    "--mirror", "0.6", "--json"};
    verify.insert(verify.end(), pictures.begin(), pictures.end());
    const nlohmann::json mirror = json_of(verify).at(0).at("mirror");
    EXPECT_EQ(mirror.at("check").at("verdict"), "ok") << mirror.at("check").at("reason");
    EXPECT_GT(mirror.at("check").at("rays"), mirror.at("rays")) << "those of all pictures";
  }
}

TEST_F(MirrorOption, GoesWithProbes) {
  const Outcome run = lamp({"verify", "corridor", "--lights", "100", "--size", "64x36", "--method", "lamplight",
                            "--mirror", "0.6", "--probes", "12", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at(0);
  EXPECT_EQ(row.at("image_max_abs_diff"), 0.0);
  EXPECT_EQ(row.at("probes_missed"), 0);
  EXPECT_GT(row.at("probes_useful"), 0);
  const nlohmann::json& check = row.at("mirror").at("check");
  EXPECT_EQ(check.at("verdict"), "ok") << check.at("reason");
  EXPECT_GT(check.at("lists").at("useful"), 0);
}

TEST_F(MirrorOption, FollowsAFlightOfThingsThatMove) {
  const Arguments flight{"render", "corridor",   "--lights", "20",       "--size", "64x36",    "--method",
                         "all",    "--samples",  "1",        "--mirror", "0.8",    "--moving", "--frames",
                         "40..41", "--exposure", "1",        "--out",    "all.exr"};
  ASSERT_EQ(lamp(flight).exit_code, 0);
  Arguments alone = flight;
  alone[14] = "41..41";
  alone[18] = "alone.exr";
  ASSERT_EQ(lamp(alone).exit_code, 0);
  EXPECT_EQ(read("all-0041.exr"), read("alone-0041.exr")) << "the same as if it were the first";
}

TEST_F(MirrorOption, SaysWhatIsWrong) {
  expect_error(BAD_INPUT, {"render", "--mirror", "2"}, {"--mirror"});
  expect_error(BAD_INPUT, {"render", "--mirror", "0.5", "--mirror-lists", "tiles"}, {"--mirror-lists 'tiles'"});
  expect_error(BAD_INPUT, {"render", "--mirror", "0.5", "--decals", "3", "--path", "forward"},
               {"--decals", "--path deferred"});
  expect_error(BAD_INPUT, {"render", "--moving", "--path", "forward", "--still-lists", "triangle-lists"},
               {"--moving", "stand still"});
}

}  // namespace
}  // namespace lamp::cli
