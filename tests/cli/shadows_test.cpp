// Shadows on the command line: numbers, and what is wrong in one line.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using Shadows = CliTest;

TEST_F(Shadows, AreCountedAndNamed) {
  const Arguments small{"render",    "plane", "--lights",  "6",   "--size",          "64x36", "--method", "all",
                        "--samples", "1",     "--shadows", "pcf", "--shadow-budget", "0",     "--json"};
  Outcome run = lamp(small);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json none = nlohmann::json::parse(run.out).at("shadows");
  EXPECT_GT(none.at("seen"), 0);
  EXPECT_EQ(none.at("without"), none.at("seen"));
  EXPECT_EQ(none.at("waiting"), none.at("seen"));
  EXPECT_EQ(none.at("waiting_lights").size(), none.at("seen"));

  Arguments all = small;
  all[13] = "all";
  run = lamp(all);
  const nlohmann::json shadows = nlohmann::json::parse(run.out).at("shadows");
  EXPECT_EQ(shadows.at("shadowed"), shadows.at("seen"));
  EXPECT_EQ(shadows.at("filter"), "pcf");
  EXPECT_GT(shadows.at("used_texels"), 0);
  all.insert(all.end(), {"--shadow-lights", "2"});
  run = lamp(all);
  EXPECT_LE(nlohmann::json::parse(run.out).at("shadows").at("seen"), 2);
}

TEST_F(Shadows, OffIsTheDefault) {
  const Outcome run = lamp({"render", "plane", "--lights", "2", "--size", "16x9", "--method", "all", "--json"});
  EXPECT_FALSE(nlohmann::json::parse(run.out).contains("shadows"));
}

TEST_F(Shadows, SayWhatIsWrong) {
  expect_error(BAD_INPUT, {"render", "--shadows", "soft"}, {"--shadows 'soft'", "nearest are "});
  expect_error(BAD_INPUT, {"render", "--shadow-lights", "many"}, {"--shadow-lights 'many'", "or all"});
  expect_error(BAD_INPUT, {"render", "--shadow-budget=-1"}, {"--shadow-budget '-1'", "or all"});
  expect_error(BAD_INPUT, {"render", "--point-shadows", "cube"}, {"--point-shadows 'cube'", "faces, octahedron"});
  expect_error(BAD_INPUT, {"render", "plane", "--lights", "1", "--shadows", "pcf", "--atlas", "1000"},
               {"shadow atlas: size", "power of two", "1000"});
}

}  // namespace
}  // namespace lamp::cli
