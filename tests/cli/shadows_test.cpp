// Shadows on the command line: numbers, and what is wrong in one line.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

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

TEST_F(Shadows, AreMeasuredWithLightsThatAreCut) {
  write("cut.json", R"({"version": 1, "name": "cut", "series": [{"name": "cut", "methods": [
    {"name": "drobot-raster-tile", "options": ["raster=full"]},
    {"name": "drobot-raster-tile", "options": ["raster=full", "proxy=cut"]},
    {"name": "drobot-raster-tile", "options": ["raster=full", "occlusion=radial"]}],
    "scenes": ["corridor"], "sizes": ["160x90"], "lights": [12], "ranges": ["4:8"],
    "shadows": "hard", "atlas": 1024, "still": 1, "frames": 1, "warm_up": 0}]})");
  ASSERT_EQ(lamp({"bench", "cut.json", "--out", "folder"}).exit_code, 0);
  const auto results = nlohmann::json::parse(read("folder/results.json")).at("results");
  ASSERT_EQ(results.size(), 3);
  for (const auto& result : results) {
    EXPECT_EQ(result.at("verdict"), "exact") << result.at("reason");
    EXPECT_EQ(result.at("parameters").at("shadows"), "hard");
    EXPECT_EQ(result.at("parameters").at("still"), 1.0);
  }
  const auto walked = [&](std::size_t i) { return results.at(i).at("stats").at("evaluations").get<std::uint64_t>(); };
  EXPECT_LT(walked(1), walked(0));
  EXPECT_LT(walked(2), walked(0));
}

TEST_F(Shadows, LeakInColour) {
  const auto with = [](const Arguments& more) {
    Arguments all{"render", "corridor",     "--lights",    "8",         "--range", "4:8",       "--size",
                  "240x36", "--samples",    "1",           "--shadows", "vsm",     "--heatmap", "leaks.png",
                  "--json", "--heatmap-of", "shadow-leaks"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const nlohmann::json none =
      json_of(with({"--method", "tight", "--overlay", "over.png", "--shadow-budget", "0"})).at("shadows").at("picture");
  EXPECT_EQ(none.at("leaks"), 1.0) << "nothing has a map";
  EXPECT_EQ(none.at("false_shadows"), 0.0);
  EXPECT_EQ(none.at("ended"), 0);
  for (const char* file : {"leaks.png", "over.png"}) {
    EXPECT_EQ(size_of_png(read(file)).first, 240U);
    EXPECT_GT(size_of_png(read(file)).second, 36U) << "there is a legend";
  }
  EXPECT_NE(read("leaks.png"), read("over.png"));
  expect_error(BAD_INPUT, with({"--method", "lamplight", "--option", "occlusion=radial"}),
               {"--heatmap-of shadow-leaks", "lists leave out lights"});
}

// A script that goes through filters need not leave their options out where there are no shadows; but a method that
// cuts by shadows is another without them.
TEST_F(Shadows, ThatAreOffLeaveTheirOptionsAlone) {
  (void)output_of({"render", "plane", "--size", "8x8", "--lights", "1", "--shadows", "off", "--atlas", "512",
                   "--method", "tiled", "--out", "off.png"});
}

// Every picture is that of the first frame, in which a budget leaves lights without their shadows.
TEST_F(Shadows, OfAFrameWithABudgetVerify) {
  const Outcome outcome = lamp({"verify", "corridor", "--lights", "30", "--size", "48x27", "--shadows", "hard",
                                "--shadow-budget", "30000", "--method", "lamplight"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(Shadows, AreHeldAgainstRaysInEveryViewAndSample) {
  const auto pairs_with = [&](const Arguments& pictures) {
    Arguments verify{"verify", "corridor",  "--lights", "60",     "--range",  "6:9",      "--size",
                     "32x18",  "--shadows", "hard",     "--json", "--method", "clustered"};
    verify.insert(verify.end(), pictures.begin(), pictures.end());
    return json_of(verify).at(0).at("shadows").at("truth").at("pairs").get<std::size_t>();
  };
  const std::size_t of_one = pairs_with({});
  EXPECT_GT(pairs_with({"--views", "2"}), of_one);
  EXPECT_GT(pairs_with({"--depth-samples", "4"}), 2 * of_one);
}

std::size_t times_of(const nlohmann::json& stats, const std::string& pass) {
  return static_cast<std::size_t>(std::ranges::count(
      stats.at("passes"), pass, [](const nlohmann::json& p) { return p.at("name").get<std::string>(); }));
}

// Warm-up and samples before it draw them too.
TEST_F(Shadows, AreDrawnInTheFrameThatIsTimed) {
  for (const char* samples : {"1", "2"})
    for (const nlohmann::json& stats :
         json_of({"render", "corridor", "--lights", "8", "--size", "32x18", "--method", "tiled", "--shadows", "hard",
                  "--samples", samples, "--frames", "10..11", "--json"})) {
      EXPECT_GT(stats.at("shadows").at("redrawn"), 0);
      EXPECT_EQ(times_of(stats, "shadow maps"), 1U) << stats.at("passes");
    }
  const nlohmann::json both = json_of(
      {"compare", "tiled", "all", "corridor", "--lights", "8", "--size", "32x18", "--shadows", "hard", "--json"});
  for (const char* side : {"a", "b"})
    EXPECT_EQ(times_of(both.at(side), "shadow maps"), 1U) << both.at(side).at("passes");
}

TEST_F(Shadows, SayWhatIsWrong) {
  expect_error(BAD_INPUT, {"render", "--shadows", "soft"}, {"--shadows 'soft'", "nearest are "});
  expect_error(BAD_INPUT, {"render", "--heatmap", "h.png", "--heatmap-of", "age"},
               {"--heatmap-of 'age'", "nearest are"});
  expect_error(BAD_INPUT, {"render", "--heatmap", "h.png", "--heatmap-of", "shadow-age"}, {"expected --shadows"});
  expect_error(BAD_INPUT, {"render", "--heatmap", "h.png", "--heatmap-of", "shadow-leaks"}, {"expected --shadows"});
  expect_error(BAD_INPUT, {"render", "--shadows", "pcf", "--heatmap-of", "shadow-age"},
               {"expected --heatmap or --overlay"});
  expect_error(BAD_INPUT, {"render", "--shadows", "pcf", "--shadow-lights", "many"},
               {"--shadow-lights 'many'", "or all"});
  expect_error(BAD_INPUT, {"render", "--shadows", "pcf", "--shadow-budget=-1"}, {"--shadow-budget '-1'", "or all"});
  expect_error(BAD_INPUT, {"render", "--shadows", "pcf", "--point-shadows", "cube"},
               {"--point-shadows 'cube'", "faces, octahedron"});
  for (const char* option : {"--shadow-lights", "--shadow-budget", "--atlas", "--point-shadows", "--shadow-raster"})
    expect_error(BAD_INPUT, {"render", "plane", option, "4"}, {option, "expected --shadows FILTER too"});
  for (const char* cut : {"occlusion=radial", "proxy=cut"})
    expect_error(BAD_INPUT, {"render", "plane", "--method", "drobot-raster-tile", "--option", cut},
                 {cut, "expected --shadows FILTER too"});
  expect_error(BAD_INPUT, {"compare", "tiled", "lamplight:occlusion=radial", "plane"},
               {"lamplight:occlusion=radial", "expected --shadows FILTER too"});
  expect_error(BAD_INPUT, {"render", "plane", "--lights", "1", "--shadows", "pcf", "--atlas", "1000"},
               {"shadow atlas: size", "power of two", "1000"});
  expect_error(BAD_INPUT, {"bench", "plane", "--lights", "1", "--shadows", "pcf", "--atlas", "1000"},
               {"lamp: shadow atlas: size", "power of two", "1000"});
  write("mine.json", R"({"version": 1, "name": "mine", "series": [{"name": "s", "scenes": ["plane"], "lights": [1],
    "shadows": "pcf", "atlas": 1000}]})");
  expect_error(BAD_INPUT, {"bench", "mine.json"}, {"lamp: mine.json: series 's': shadow atlas: size", "1000"});
}

}  // namespace
}  // namespace lamp::cli
