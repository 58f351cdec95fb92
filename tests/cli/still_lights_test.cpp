// Lights that stand still on the command line: numbers, checks, and what is wrong in one line.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cli/cli_test.h"
#include "image/image.h"

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

// All lights stand still, so that the method's own lists are empty.
TEST_F(Still, LightsAreInTheHeatMapOfEveryViewAndOfSamples) {
  const auto half_has_colours = [](const app::LdrImage& map, std::uint32_t begin) {
    for (std::uint32_t i = 0; i < map.pixels.size(); ++i)
      if (i % map.width >= begin && i % map.width < begin + map.width / 2 && map.pixels[i] != map.pixels[begin])
        return true;
    return false;
  };
  const std::vector<std::pair<Arguments, const char*>> cases{{{"--stereo", "0.064"}, "world-tree"},
                                                             {{"--stereo", "0.064"}, "triangle-lists"},
                                                             {{"--depth-samples", "4"}, "world-tree"}};
  for (const auto& [pictures, lists] : cases) {
    SCOPED_TRACE(pictures.front() + " " + lists);
    Arguments render{"render",    "corridor", "--size",        "96x27",      "--lights", "40",
                     "--still",   "1",        "--still-lists", lists,        "--method", "clustered",
                     "--heatmap", "heat.png", "--out",         "picture.png"};
    render.insert(render.end(), pictures.begin(), pictures.end());
    const std::string words = output_of(render);
    EXPECT_NE(words.find("walked    0 pairs of pixel and light, besides still lights;"), std::string::npos) << words;
    const app::LdrImage map = app::read_png(path("heat.png"));
    EXPECT_TRUE(half_has_colours(map, 0));
    EXPECT_TRUE(half_has_colours(map, map.width / 2));
  }
}

/// Behind decals and probes, where records of still lights are.
TEST_F(Still, LightsAreAskedForTheirOwnShadows) {
  const auto truth = [&](const std::string& lists) {
    const Outcome run = lamp({"verify",        "corridor", "--lights",  "40",    "--size",  "64x36", "--still",  "0.5",
                              "--still-lists", lists,      "--shadows", "hard",  "--atlas", "512",   "--decals", "3",
                              "--probes",      "2",        "--method",  "tiled", "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out).at(0).at("shadows").at("truth");
  };
  const nlohmann::json with = truth("triangle-lists");
  const nlohmann::json without = truth("off");
  ASSERT_EQ(with.size(), without.size());
  EXPECT_GT(without.at("in_shadow").get<int>(), 0);
  for (const auto& [key, value] : without.items()) {
    SCOPED_TRACE(key);
    if (value.is_number_integer()) {
      EXPECT_EQ(with.at(key), value);
    }
  }
}

/// `--shadow-lights` counts lights, and what fits nowhere is named by its light.
TEST_F(Still, LightsCastShadowsAsWithoutLists) {
  const auto shadows = [&](const std::string& lists) {
    const Outcome run =
        lamp({"verify",        "corridor", "--lights",  "40",   "--size",   "64x36", "--still",         "1",
              "--still-lists", lists,      "--shadows", "hard", "--atlas",  "64",    "--shadow-lights", "30",
              "--decals",      "3",        "--probes",  "2",    "--method", "tiled", "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.out;
    return nlohmann::json::parse(run.out).at(0).at("shadows");
  };
  const nlohmann::json with = shadows("world-tree");
  const nlohmann::json without = shadows("off");
  EXPECT_GT(without.at("without_lights").size(), 0U) << "it says nothing of their numbers";
  for (const char* key : {"seen", "shadowed", "without", "without_lights", "smaller", "used_texels"})
    EXPECT_EQ(with.at(key), without.at(key)) << key;
}

TEST_F(Still, ListsAreCheckedInEveryView) {
  for (const char* lists : {"world-tree", "triangle-lists"}) {
    SCOPED_TRACE(lists);
    const auto points_with = [&](const char* views) {
      const nlohmann::json row =
          json_of({"verify", "corridor", "--lights", "40", "--size", "32x18", "--method", "clustered", "--still", "1",
                   "--still-lists", lists, "--points", "100", "--views", views, "--json"})
              .at(0);
      EXPECT_EQ(row.at("still").at("checks").at(0).at("verdict"), "ok");
      return row.at("still").at("checks").at(0).at("count").get<std::size_t>();
    };
    const std::size_t of_one = points_with("1");
    EXPECT_LE(of_one, 32U * 18U);
    EXPECT_GT(points_with("4"), 2 * of_one);
  }
}

TEST_F(Still, SayWhatIsWrong) {
  expect_error(BAD_INPUT, {"render", "--still", "2"}, {"--still"});
  expect_error(BAD_INPUT, {"render", "--still-lists", "triangles"}, {"--still-lists 'triangles'", "triangle-lists"});
  for (const char* lists : {"triangle-lists", "world-tree"})
    expect_error(BAD_INPUT, {"render", "--still-lists", lists, "--path", "standard-deferred"},
                 {"standard-deferred: walks no lists"});
  expect_error(BAD_INPUT, {"verify", "--still-lists", "world-tree", "--points", "10", "--cut", "cut.png"},
               {"--cut", "--still-lists off"});
  expect_error(BAD_INPUT, {"render", "--still-occlusion", "32"}, {"--still-occlusion 32", "there are no lists"});
}

}  // namespace
}  // namespace lamp::cli
