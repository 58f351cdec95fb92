// lamp bench and lamp report, as their users run them: what they write, how they stop and go on, what they refuse.
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int CHECK_FAILED = 1;

class Bench : public CliTest {
 protected:
  /// A suite that takes a second: pictures of 32 x 18 pixels.
  void write_suite(const std::string& lights, const std::string& more = "") const {
    write("mine.json", R"({"version": 1, "name": "mine", "series": [{"name": "small", "methods": ["tiled", "clustered"],
      "scenes": ["plane"], "sizes": ["32x18"], "frames": 3, "lights": )" +
                           lights + more + "}]}");
  }
  [[nodiscard]] json results() const { return json::parse(read("out/results.json")); }

  /// Runs a script of sh in the test's folder, with `lamp` as $LAMP; its exit code.
  [[nodiscard]] int script(const std::string& text) const {
    write("script.sh", "cd '" + path("").string() + "'\nLAMP='" + LAMP_EXECUTABLE + "'\n" + text + "\n");
    return std::system(("sh '" + path("script.sh").string() + "' >/dev/null 2>&1").c_str()) >> 8;
  }
};

const Arguments MINE{"bench", "mine.json", "--out", "out"};

TEST_F(Bench, ASuiteGivesResultsTableAndReport) {
  write_suite("[4, 8]", R"(, "pictures": true)");
  const std::string text = output_of(MINE);
  EXPECT_NE(text.find("4 configurations measured, 0 wrong"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos) << "progress in a pipe";
  const json all = results();
  EXPECT_EQ(all.at("format"), "lamplight-results");
  EXPECT_EQ(all.at("version"), 1);
  EXPECT_TRUE(all.at("run").at("complete"));
  EXPECT_EQ(all.at("run").at("command").get<std::string>().find("lamp bench mine.json --out out"), 0);
  ASSERT_EQ(all.at("results").size(), 4U);
  for (const json& result : all.at("results")) {
    SCOPED_TRACE(result.at("key").get<std::string>());
    EXPECT_EQ(result.at("verdict"), "exact");
    EXPECT_EQ(result.at("stats").at("missed"), 0);
    const json& cull = result.at("times").at("cull");
    EXPECT_LE(cull.at("p5"), cull.at("median"));
    EXPECT_LE(cull.at("median"), cull.at("p95"));
    for (const json& pass : result.at("stats").at("passes")) {
      if (pass.at("part") != "cull") continue;
      EXPECT_GE(cull.at("p95"), pass.at("ms_p5")) << "the cull holds its passes";
    }
    if (result.at("parameters").at("lights") != 8) continue;
    for (const char* kind : {"picture", "heatmap"})
      EXPECT_TRUE(fs::exists(path("out") / result.at("pictures").at(kind).get<std::string>()));
  }
  const std::string csv = read("out/results.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
  EXPECT_NE(read("out/report.html").find("</html>"), std::string::npos);
}

TEST_F(Bench, ItGoesOnInTheSameFolder) {
  write_suite("[4]");
  (void)output_of(MINE);
  const json first = results();
  (void)output_of(MINE);
  EXPECT_EQ(results().at("results"), first.at("results")) << "measured again";
  write_suite("[4, 8]");
  (void)output_of(MINE);
  const json more = results();
  ASSERT_EQ(more.at("results").size(), 4U);
  EXPECT_EQ(more.at("results")[0], first.at("results")[0]);
}

TEST_F(Bench, InterruptedItKeepsWhatItHasAndGoesOn) {
  std::string lights = "[1";
  for (int i = 2; i <= 60; ++i) lights += ", " + std::to_string(i);
  write_suite(lights + "]");
  Running running = start(MINE);
  for (int i = 0; i < 60'000 && !fs::exists(path("out/results.json")); ++i) usleep(1000);
  for (int i = 0; i < 2; ++i) running.send(SIGINT);  // a terminal and a shell may send it twice
  const Outcome outcome = running.finish();
  EXPECT_EQ(outcome.signal, SIGINT) << outcome.err;
  EXPECT_NE(outcome.out.find("stopped before its end; the same command goes on\n"), std::string::npos) << outcome.out;
  const json some = results();
  EXPECT_FALSE(some.at("run").at("complete"));
  ASSERT_FALSE(some.at("results").empty());
  EXPECT_LT(some.at("results").size(), 120U);
  EXPECT_TRUE(fs::exists(path("out/report.html")));
  // Groups are of 1 light, 2 lights and so on.
  const std::size_t wanted = std::min<std::size_t>(some.at("results").size() / 2 + 3, 60);
  (void)output_of({"bench", "mine.json", "--out", "out", "--max-lights", std::to_string(wanted)});
  EXPECT_EQ(results().at("results")[0], some.at("results")[0]);
  EXPECT_EQ(results().at("results").size(), 2 * wanted);
}

// A look-up that finds nothing: the method's times would be the best of all.
TEST_F(Bench, AMethodWhoseOutputIsWrongGetsNoTime) {
  for (const char* folder : {"lib/shaders", "lib/include", "app/render/shaders"}) {
    fs::create_directories(path("tree") / folder);
    fs::copy(fs::path(LAMPLIGHT_SOURCE_DIR) / folder, path("tree") / folder, fs::copy_options::recursive);
  }
  const std::string lookup = "tree/lib/shaders/lookup/parts/cluster_lists.glsl";
  std::string text = read(lookup);
  const std::string whole = "if (range.y != NO_RANGE) return walk_from(first, first + range.y, LOOKUP_NO_WORD);";
  const std::size_t at = text.find(whole);
  ASSERT_NE(at, std::string::npos);
  write(lookup,
        text.replace(at, whole.size(), "if (range.y != NO_RANGE) return walk_from(first, first, LOOKUP_NO_WORD);"));
  write_suite("[8]");
  Arguments broken = MINE;
  broken.insert(broken.end(), {"--shader-dir", "tree"});
  const Outcome outcome = lamp(broken);
  EXPECT_EQ(outcome.exit_code, CHECK_FAILED) << outcome.err;
  EXPECT_NE(outcome.out.find("misses"), std::string::npos) << outcome.out;
  const json all = results();
  EXPECT_EQ(all.at("results")[0].at("verdict"), "exact");
  EXPECT_FALSE(all.at("results")[0].at("times").is_null());
  const json& wrong = all.at("results")[1];
  EXPECT_EQ(wrong.at("verdict"), "wrong");
  EXPECT_NE(wrong.at("reason").get<std::string>().find("misses"), std::string::npos);
  EXPECT_TRUE(wrong.at("times").is_null());
  EXPECT_TRUE(wrong.at("stats").at("cull_ms").is_null());
  EXPECT_TRUE(wrong.at("stats").at("passes").empty());
}

// A method whose walks a software device ends may be right: it keeps its times.
TEST_F(Bench, WhatCouldNotBeCheckedKeepsItsTimesAndSaysSo) {
  const Outcome outcome = lamp({"bench", "plane", "--size", "16x9", "--lights", "66000", "--method", "tiled",
                                "--option", "capacity=16", "--frames", "1", "--warm-up", "0", "--out", "out"});
  if (outcome.exit_code == 0) GTEST_SKIP() << "the device ends no loops";
  EXPECT_EQ(outcome.exit_code, UNCHECKED) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("0 wrong, 1 could not be checked"), std::string::npos) << outcome.out;
  const json result = results().at("results")[0];
  EXPECT_EQ(result.at("verdict"), "could not check");
  EXPECT_TRUE(result.at("reason").get<std::string>().starts_with("the device ended the light walks of "));
  EXPECT_FALSE(result.at("times").is_null());
  EXPECT_NE(read("out/results.csv").find(",could not check,"), std::string::npos);
  EXPECT_NE(read("out/report.html").find("1 could not be checked on this device, and have their times"),
            std::string::npos);
}

TEST_F(Bench, ASceneWithOptionsOfTheCommandLine) {
  (void)output_of({"bench", "plane", "--size", "32x18", "--lights", "8", "--method", "tiled", "--option", "tile=8",
                   "--frames", "2", "--out", "out"});
  const json all = results();
  ASSERT_EQ(all.at("results").size(), 1U);
  EXPECT_EQ(all.at("results")[0].at("stats").at("options").at("tile"), "8");
  EXPECT_EQ(all.at("results")[0].at("stats").at("frames"), 2);
}

TEST_F(Bench, ASceneWithShadowsAndLightsThatStandStill) {
  (void)output_of({"bench",    "posts", "--size",    "32x18", "--lights",        "8",  "--still",         "0.5",
                   "--method", "tiled", "--shadows", "pcf",   "--shadow-lights", "3",  "--shadow-budget", "65536",
                   "--atlas",  "256",   "--frames",  "1",     "--out",           "out"});
  const json parameters = results().at("results").at(0).at("parameters");
  EXPECT_EQ(parameters.at("still"), 0.5);
  EXPECT_EQ(parameters.at("shadows"), "pcf");
  EXPECT_EQ(parameters.at("shadow_lights"), "3");
  EXPECT_EQ(parameters.at("shadow_budget"), "65536");
  EXPECT_EQ(parameters.at("atlas"), 256);
}

/// Lights move from the last frame that warms up to the first that is timed.
TEST_F(Bench, EveryTimedFrameDrawsTheShadowMapsOfLightsThatMove) {
  (void)output_of({"bench", "posts", "--size", "32x18", "--lights", "2", "--method", "tiled", "--shadows", "hard",
                   "--atlas", "256", "--warm-up", "1", "--frames", "1", "--out", "out"});
  const json passes = results().at("results").at(0).at("stats").at("passes");
  EXPECT_TRUE(std::ranges::any_of(passes, [](const json& pass) { return pass.at("name") == "shadow maps"; })) << passes;
}

TEST_F(Bench, ASceneWithDecalsAndProbesHoldsThoseAgainstTheOracleToo) {
  (void)output_of({"bench", "atrium", "--size", "64x36", "--lights", "8", "--decals", "16", "--probes", "12",
                   "--method", "tiled", "--frames", "1", "--out", "out"});
  const json result = results().at("results").at(0);
  EXPECT_EQ(result.at("verdict"), "exact");
  EXPECT_EQ(result.at("parameters").at("decals"), 16);
  EXPECT_EQ(result.at("parameters").at("probes"), 12);
  const json& stats = result.at("stats");
  EXPECT_EQ(stats.at("decals_missed"), 0);
  EXPECT_GT(stats.at("decals_useful"), 0);
  EXPECT_EQ(stats.at("probes_missed"), 0);
  EXPECT_GT(stats.at("probes_useful"), 0);
}

TEST_F(Bench, ASuiteSweepsDecalsAndProbes) {
  write("boxes.json",
        R"({"version": 1, "name": "boxes", "series": [{"name": "s", "methods": ["tiled"], "scenes": ["atrium"],
    "sizes": ["64x36"], "lights": [8], "decals": [0, 8], "probes": [0, 6], "chart": {"x": "probes", "y": "cull"},
    "frames": 1, "warm_up": 0}]})");
  (void)output_of({"bench", "boxes.json", "--out", "out"});
  const json all = results().at("results");
  ASSERT_EQ(all.size(), 4U);
  std::vector<std::pair<unsigned, unsigned>> counts;
  for (const json& result : all) {
    EXPECT_EQ(result.at("verdict"), "exact");
    const json& parameters = result.at("parameters");
    counts.emplace_back(parameters.value("decals", 0U), parameters.value("probes", 0U));
  }
  const std::vector<std::pair<unsigned, unsigned>> expected{{0, 0}, {0, 6}, {8, 0}, {8, 6}};
  EXPECT_EQ(counts, expected);
  EXPECT_NE(read("out/report.html").find("8 decals"), std::string::npos);
  const std::string csv = read("out/results.csv");
  EXPECT_NE(csv.find(",camera=first decals=8 probes=6 projection=camera,"), std::string::npos) << csv;
}

TEST_F(Bench, HostPassesHaveATimeOfTheirOwn) {
  (void)output_of({"bench", "plane", "--size", "32x18", "--lights", "3000", "--method", "drobot-zbin", "--option",
                   "sort=cpu", "--frames", "3", "--out", "out"});
  const json stats = results().at("results").at(0).at("stats");
  std::size_t hosts = 0;
  for (const json& pass : stats.at("passes")) {
    if (pass.at("part") != "host") continue;
    ++hosts;
    EXPECT_EQ(pass.at("name"), "sort and bins");
    EXPECT_GT(pass.at("ms_p5"), 0.0);
    EXPECT_LE(pass.at("ms_p5"), pass.at("ms_median"));
    EXPECT_LE(pass.at("ms_median"), pass.at("ms_p95"));
  }
  EXPECT_EQ(hosts, 1U);
}

// A driver may have none to give, as Mesa's llvmpipe; what it gives must be whole, and nothing may come unasked.
TEST_F(Bench, PipelineStatisticsComeWhenAskedFor) {
  const Arguments command{"bench",    "plane", "--size",   "32x18", "--lights", "8",
                          "--method", "tiled", "--frames", "2",     "--out",    "out"};
  (void)output_of(command);
  for (const json& pass : results().at("results").at(0).at("stats").at("passes")) {
    EXPECT_FALSE(pass.contains("statistics"));
    EXPECT_FALSE(pass.contains("registers"));
  }
  fs::remove_all(path("out"));
  Arguments asking = command;
  asking.emplace_back("--pipeline-statistics");
  (void)output_of(asking);
  for (const json& pass : results().at("results").at(0).at("stats").at("passes")) {
    if (!pass.contains("statistics")) continue;
    EXPECT_NE(pass.at("part"), "host");
    for (const json& statistic : pass.at("statistics")) {
      EXPECT_FALSE(statistic.at("executable").get<std::string>().empty());
      EXPECT_FALSE(statistic.at("name").get<std::string>().empty());
      EXPECT_TRUE(statistic.at("value").is_number());
    }
    if (pass.contains("registers")) {
      EXPECT_GT(pass.at("registers"), 0);
    }
  }
}

TEST_F(Bench, DrobotsTablesStandBesideOurs) {
  (void)output_of({"bench", "drobot-memory", "--max-size", "1920x1080", "--max-lights", "256", "--out", "out"});
  const json all = results();
  for (const json& result : all.at("results")) {
    EXPECT_TRUE(result.at("times").is_null());
    EXPECT_EQ(result.at("verdict"), "unverified");
  }
  const std::string tool = (fs::path(LAMPLIGHT_SOURCE_DIR) / "tools/drobot_tables").string();
  ASSERT_EQ(script("'" + tool + "' out/results.json >table.md"), 0);
  EXPECT_NE(read("table.md").find("| tiles | 240x135 | 1 | 1036 KB | 1036.8 KB |"), std::string::npos)
      << read("table.md");
  EXPECT_EQ(script("'" + tool + "' script.sh"), BAD_INPUT);
  const std::string walks = (fs::path(LAMPLIGHT_SOURCE_DIR) / "docs/results/h100/drobot-scalarisation.json").string();
  ASSERT_EQ(script("'" + tool + "' '" + walks + "' >table.md"), 0);
  EXPECT_NE(read("table.md").find("| bits, scalar | 32 | 8 | 72 % |"), std::string::npos) << read("table.md");
  EXPECT_EQ(read("table.md").find("| 72 % |  |"), std::string::npos) << "of a suite with several paths";
}

TEST_F(Bench, ACapturedFrameIsAScene) {
  (void)output_of({"capture", "plane", "--size", "48x27", "--lights", "8", "--out", "frame"});
  (void)output_of({"bench", "frame", "--method", "tiled", "--method", "clustered", "--frames", "2", "--out", "out"});
  const json all = results();
  ASSERT_EQ(all.at("results").size(), 2U);
  for (const json& result : all.at("results")) {
    EXPECT_EQ(result.at("verdict"), "exact") << result.at("reason");
    EXPECT_EQ(result.at("stats").at("width"), 48);
  }
}

// The second needs more room for its lists than many devices have.
TEST_F(Bench, WhatIsImpossibleIsNotCountedAsMeasured) {
  write("mine.json", R"({"version": 1, "name": "mine", "series": [{"name": "memory", "methods": ["tiled"],
    "options": {"tile": ["8"], "mean_capacity": ["1024"]}, "scenes": ["plane"], "sizes": ["64x36", "7680x4320"],
    "lights": [16], "timed": false}]})");
  const std::string text = output_of(MINE);
  const json all = results().at("results");
  const auto impossible =
      std::ranges::count_if(all, [](const json& result) { return result.at("verdict") == "impossible"; });
  const std::string line = std::to_string(2 - impossible) +
                           " configurations measured, 0 wrong, 0 could not be checked, " + std::to_string(impossible) +
                           " impossible, 0 beyond the limits: out/report.html\n";
  EXPECT_TRUE(text.ends_with(line)) << text << "expected " << line;
}

TEST_F(Bench, AFlightHasASampleAFrame) {
  write("mine.json",
        R"({"version": 1, "name": "mine", "series": [{"name": "flight", "methods": ["tiled"], "scenes": ["posts"],
    "sizes": ["32x18"], "ranges": ["1:2"], "flight": {"from": 1, "to": 9}}]})");
  (void)output_of({"bench", "mine.json", "--frames", "6", "--out", "out"});
  const json samples = results().at("results")[0].at("samples");
  ASSERT_EQ(samples.size(), 6U);
  EXPECT_EQ(samples[0].at("lights"), 1);
  EXPECT_EQ(samples[3].at("lights"), 9);
}

TEST_F(Bench, ReportsAreMadeAgainAndCompared) {
  write_suite("[4]");
  (void)output_of(MINE);
  (void)output_of({"report", "out/results.json", "--out", "again.html"});
  EXPECT_EQ(read("again.html").find("\"comparison\":"), std::string::npos);
  (void)output_of({"report", "out/results.json", "out/results.json", "--out", "pages/two.html"});
  EXPECT_NE(read("pages/two.html").find("\"comparison\":"), std::string::npos);
}

TEST_F(Bench, SuitesAreListed) {
  const json suites = json_of({"list", "suites", "--json"});
  EXPECT_TRUE(std::ranges::any_of(suites, [](const json& suite) { return suite.at("name") == "quick"; }));
  EXPECT_NE(output_of({"list", "suites"}).find("stewart-flight"), std::string::npos);
}

TEST_F(Bench, BadInput) {
  expect_error(BAD_INPUT, {"bench", "quik"}, {"'quik'", "nearest are quick"});
  expect_error(BAD_INPUT, {"bench", "nowhere.json"}, {"nowhere.json: is not there"});
  expect_error(BAD_INPUT, {"bench", "world", "--series", "light"},
               {"--series 'light': the suite world has none", "expected one of lights, memory"});
  expect_error(BAD_INPUT, {"bench", "plane", "--series", "lights"},
               {"--series: belongs to a suite, and plane is a scene"});
  expect_error(BAD_INPUT, {"bench", "quick", "--size", "8x8"}, {"--size", "quick is a suite", "--max-size"});
  for (const Arguments& of_scene :
       {Arguments{"--still", "0.5"}, Arguments{"--shadows", "pcf"}, Arguments{"--path", "forward"}})
    expect_error(BAD_INPUT, {"bench", "quick", of_scene[0], of_scene[1]}, {of_scene[0] + ": belongs to a scene"});
  expect_error(BAD_INPUT, {"bench", "plane", "--shadows", "soft"}, {"--shadows 'soft'", "pcf"});
  expect_error(BAD_INPUT, {"bench", "plane", "--method", "tild"}, {"method 'tild'", "tiled"});
  expect_error(BAD_INPUT, {"bench", "plane", "--option", "tile=8"}, {"--option", "--method"});
  expect_error(BAD_INPUT, {"bench", "plane", "--frames", "0"}, {"--frames", "from 1"});
  expect_error(BAD_INPUT, {"bench", "quick", "--max-size", "big"}, {"--max-size 'big'"});
  expect_error(BAD_INPUT, {"bench", "quick", "--scale", "2"}, {"--scale"});
  write_suite("[4]", R"(, "lihgts": [5])");
  expect_error(BAD_INPUT, MINE, {"mine.json: series 'small': key 'lihgts'", "lights"});
  write_suite("[4]", R"(, "cameras": ["nowhere"])");
  expect_error(BAD_INPUT, MINE, {"lamp: mine.json: series 'small': plane: camera 'nowhere'", "front"});
  write_suite("[4]", R"(, "frame": 300)");
  expect_error(BAD_INPUT, MINE, {"lamp: mine.json: series 'small': frame 300", "0 to 299"});
  write("mine.json", R"({"version": 1, "name": "mine", "series": [{"name": "small", "scenes": ["nowhere"]}]})");
  expect_error(BAD_INPUT, MINE, {"lamp: mine.json: series 'small': scene 'nowhere'", "nearest are"});
  expect_error(BAD_INPUT, {"bench", "plane", "--camera", "nowhere"}, {"lamp: plane: camera 'nowhere'"});
  write_suite("[4]", R"(, "options": {"tile": ["9"]})");
  expect_error(BAD_INPUT, MINE, {"mine.json: series 'small'", "tile", "'9'"});
  write("out", "a file");
  write_suite("[4]");
  expect_error(BAD_INPUT, MINE, {"--out 'out'", "folder"});
}

TEST_F(Bench, EarlierResultsAreKept) {
  write_suite("[4]");
  (void)output_of(MINE);
  json earlier = results();
  earlier["version"] = 9;
  write("out/results.json", earlier.dump());
  expect_error(BAD_INPUT, MINE, {"results.json: version: expected 1, got 9"});
  EXPECT_EQ(results(), earlier);
  earlier["version"] = 1;
  earlier["run"]["device"] = "another";
  write("out/results.json", earlier.dump());
  expect_error(BAD_INPUT, MINE, {"results.json", "device \"another\"", "another --out"});
  EXPECT_EQ(results(), earlier);
  write("out/results.json", "torn {");
  expect_error(BAD_INPUT, MINE, {"results.json: is no JSON: "});
  EXPECT_EQ(read("out/results.json"), "torn {");
}

TEST_F(Bench, ReportOfWhatIsNone) {
  expect_error(BAD_INPUT, {"report"}, {"lamp report --help"});
  expect_error(BAD_INPUT, {"report", "nowhere.json"}, {"nowhere.json: is not there"});
  write("old.json", R"({"format": "lamplight-results", "version": 0})");
  expect_error(BAD_INPUT, {"report", "old.json"}, {"old.json: version: expected 1, got 0"});
  write("odd.json", R"({"format": "lamplight-results", "version": 1, "run": {}, "suite": {}, "results": []})");
  expect_error(BAD_INPUT, {"report", "odd.json"}, {"odd.json: run: command is missing, expected a string"});
  expect_error(BAD_INPUT, {"report", "old.json", "--out", "page.txt"}, {"--out 'page.txt'", ".html"});
}

}  // namespace
}  // namespace lamp::cli
