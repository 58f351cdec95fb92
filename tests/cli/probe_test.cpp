// lamp probe: a picture of what a probe sees, with shadows and without, and what it refuses.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"
#include "image/image.h"

namespace lamp::cli {
namespace {

using Probe = CliTest;

TEST_F(Probe, WritesWhatIsSeenFromAPlace) {
  const std::string text = output_of({"probe", "corridor", "--at", "0.5", "1.6", "0.5", "--lights", "64"});
  EXPECT_NE(text.find("at (0.50, 1.60, 0.50), 64 lights"), std::string::npos) << text;
  const app::LdrImage picture = app::read_png(path("probe.png"));
  EXPECT_EQ(picture.width, 640U);
  EXPECT_GT(picture.height, 900U);
  const std::string shadows = output_of({"probe", "corridor", "--at", "0.5", "1.6", "0.5", "--lights", "64",
                                         "--shadows", "hard", "--atlas", "64", "--out", "shadows.png"});
  EXPECT_NE(read("shadows.png"), read("probe.png"));
  EXPECT_NE(shadows.find("\nshadows   hard: "), std::string::npos) << shadows;
  EXPECT_NE(shadows.find(" fit nowhere"), std::string::npos) << shadows;
  expect_error(BAD_INPUT, {"probe", "--shadows", "hard", "--shadow-budget", "1"}, {"option '--shadow-budget'"});
}

TEST_F(Probe, AreCapturedBeforeAPictureAndWithinABudgetAfterwards) {
  const Outcome run = lamp({"render", "corridor", "--probes", "5", "--probe-budget", "2", "--lights", "20", "--size",
                            "64x36", "--frames", "0..2", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json frames = nlohmann::json::parse(run.out);
  ASSERT_EQ(frames.size(), 3);
  EXPECT_EQ(frames[0].at("probe_captures").at("drawn"), 5);
  for (int i = 1; i < 3; ++i) {
    EXPECT_EQ(frames[i].at("probe_captures").at("drawn"), 2);
    EXPECT_EQ(frames[i].at("probe_captures").at("waiting"), 3);
  }
  const nlohmann::json flat =
      nlohmann::json::parse(output_of(small({"render", "--probes", "5", "--probes-show", "flat", "--json"})));
  EXPECT_EQ(flat.at("probes"), 5);
  EXPECT_FALSE(flat.contains("probe_captures"));
  expect_error(BAD_INPUT, {"render", "--probes", "5", "--probes-show", "colours"},
               {"--probes-show 'colours'", "captures, flat"});
  expect_error(BAD_INPUT, {"render", "--probe-budget", "2"}, {"--probe-budget", "--probes"});
  expect_error(BAD_INPUT, {"render", "--probes-show", "flat"}, {"--probes-show", "--probes"});
}

TEST_F(Probe, RefusesACapturedFrame) {
  (void)output_of(small({"capture", "--out", "frame"}));
  expect_error(BAD_INPUT, {"probe", "frame"}, {"a capture is seen from one place alone"});
}

}  // namespace
}  // namespace lamp::cli
