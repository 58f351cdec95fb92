// Lights that stand still on the command line: numbers, checks, and what is wrong in one line.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using Still = CliTest;

TEST_F(Still, ListsAreCheckedAndCounted) {
  const Arguments small{"verify",        "corridor",       "--lights", "200",       "--size",  "64x36",
                        "--path",        "forward",        "--method", "clustered", "--still", "0.25",
                        "--still-lists", "triangle-lists", "--json"};
  Outcome run = lamp(small);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at(0);
  EXPECT_EQ(row.at("image_max_abs_diff"), 0.0);
  const nlohmann::json& still = row.at("still");
  EXPECT_EQ(still.at("lights"), 50);
  EXPECT_GT(still.at("bytes"), 0);
  ASSERT_EQ(still.at("checks").size(), 2);
  for (const nlohmann::json& check : still.at("checks")) {
    EXPECT_EQ(check.at("missed"), 0);
    EXPECT_GT(check.at("lighting"), 0);
    EXPECT_EQ(check.at("verdict"), "ok");
  }
  Arguments hidden = small;
  hidden.insert(hidden.end(), {"--still-occlusion", "16"});
  run = lamp(hidden);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json cut = nlohmann::json::parse(run.out).at(0);
  EXPECT_GT(cut.at("still").at("hidden"), 0);
  EXPECT_FALSE(cut.contains("image_max_abs_diff"));
}

TEST_F(Still, TriangleListsServeDeferredShading) {
  const Outcome run = lamp({"verify", "corridor", "--lights", "200", "--size", "64x36", "--method", "clustered",
                            "--still", "0.25", "--still-lists", "triangle-lists", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at(0);
  EXPECT_EQ(row.at("path"), "deferred");
  EXPECT_EQ(row.at("image_max_abs_diff"), 0.0);
  for (const nlohmann::json& check : row.at("still").at("checks")) EXPECT_EQ(check.at("verdict"), "ok");
}

/// On surfaces; a million of them do not fit what is held at once.
TEST_F(Still, ListsAreCheckedAtAsManyPointsAsWanted) {
  for (const char* lists : {"triangle-lists", "world-tree"}) {
    SCOPED_TRACE(lists);
    const Arguments asked{"verify",  "one-tile", "--lights",      "20",  "--size",   "16x16",  "--method", "clustered",
                          "--still", "1",        "--still-lists", lists, "--points", "1000000"};
    Arguments as_json = asked;
    as_json.emplace_back("--json");
    Outcome run = lamp(as_json);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json row = nlohmann::json::parse(run.out).at(0);
    const nlohmann::json& check = row.at("still").at("checks").at(1);
    EXPECT_EQ(check.at("points"), "surfaces");
    EXPECT_EQ(check.at("count"), 1'000'000);
    EXPECT_EQ(check.at("missed"), 0);
    run = lamp(asked);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("1000000"), std::string::npos) << run.out;
  }
}

TEST_F(Still, TreesServeDeferredShading) {
  const Outcome run = lamp({"verify", "corridor", "--lights", "200", "--size", "64x36", "--method", "clustered",
                            "--still", "0.25", "--still-lists", "world-tree", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at(0);
  EXPECT_EQ(row.at("image_max_abs_diff"), 0.0);
  const nlohmann::json& still = row.at("still");
  EXPECT_EQ(still.at("lights"), 50);
  EXPECT_GT(still.at("leaves"), 0);
  ASSERT_EQ(still.at("checks").size(), 2);
  for (const nlohmann::json& check : still.at("checks")) EXPECT_EQ(check.at("verdict"), "ok");
}

TEST_F(Still, SayWhatIsWrong) {
  expect_error(BAD_INPUT, {"render", "--still", "2"}, {"--still"});
  expect_error(BAD_INPUT, {"render", "--still-lists", "triangles"}, {"--still-lists 'triangles'", "triangle-lists"});
  for (const char* lists : {"triangle-lists", "world-tree"})
    expect_error(BAD_INPUT, {"render", "--still-lists", lists, "--path", "standard-deferred"},
                 {"standard-deferred walks no lists"});
  expect_error(BAD_INPUT, {"verify", "--still-lists", "world-tree", "--points", "10", "--cut", "cut.png"},
               {"--cut", "--still-lists off"});
  expect_error(BAD_INPUT, {"render", "--still-occlusion", "32"}, {"--still-occlusion 32", "there are no lists"});
}

}  // namespace
}  // namespace lamp::cli
