// lamp render --frames A..B: a numbered picture of each frame, each the one that --frame makes.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using Frames = CliTest;

Arguments with(const Arguments& more) {
  Arguments all = small({"render", "--method", "tiled", "--samples", "1"});
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST_F(Frames, AreThePicturesOfEachFrame) {
  const nlohmann::json all =
      json_of(with({"--frames", "38..40", "--out", "new/flight.exr", "--heatmap", "heat.png", "--json"}));
  ASSERT_EQ(all.size(), 3U);
  const std::vector<std::string> made{"heat-0038.png",       "heat-0039.png",       "heat-0040.png",      "new",
                                      "new/flight-0038.exr", "new/flight-0039.exr", "new/flight-0040.exr"};
  EXPECT_EQ(files(), made);
  for (const char* frame : {"38", "40"}) {
    SCOPED_TRACE(frame);
    const nlohmann::json one = json_of(with({"--frame", frame, "--out", "one.exr", "--heatmap", "one.png", "--json"}));
    EXPECT_EQ(read(std::string("new/flight-00") + frame + ".exr"), read("one.exr"));
    EXPECT_EQ(read(std::string("heat-00") + frame + ".png"), read("one.png"));
    const nlohmann::json& of_flight = all.at(std::stoul(frame) - 38);
    EXPECT_EQ(of_flight.at("frame"), std::stoul(frame));
    EXPECT_EQ(of_flight.at("evaluations"), one.at("evaluations"));
  }
  EXPECT_NE(read("new/flight-0038.exr"), read("new/flight-0040.exr"));
}

TEST_F(Frames, AreNamedWithTheirTimes) {
  const std::string words = output_of(with({"--frames", "9..10"}));
  for (const char* part : {"\nframe 9 ", ": lamp-0009.png\n", "\nframe 10 ", ": lamp-0010.png\n"})
    EXPECT_NE(words.find(part), std::string::npos) << words;
}

TEST_F(Frames, ThatAreNone) {
  for (const char* frames : {"..", "5..", "..5", "6..5", "-1..5", "1...5", "0..2147483648", "many"})
    expect_error(BAD_INPUT, with({std::string("--frames=") + frames}), {"--frames", "A..B"});
  expect_error(BAD_INPUT, with({"--frames", "298..300"}), {"frame 300", "has the frames 0 to 299"});
  expect_error(BAD_INPUT, with({"--frames", "1..2", "--frame", "3"}), {"--frame 3", "expected one of them"});
}

}  // namespace
}  // namespace lamp::cli
