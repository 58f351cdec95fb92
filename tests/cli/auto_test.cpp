// `--method auto`, as its users meet it: the default, explained, measured once, checked by every command.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Auto : public CliTest {
 protected:
  /// An environment without the tests' calibration, whose cache is a folder or file of the test's; only Mesa's stays.
  [[nodiscard]] Environment first_use(const std::string& cache) const {
    const char* caches = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const fs::path of_user =
        caches != nullptr ? fs::path(caches) : fs::path(home != nullptr ? home : "/tmp") / ".cache";
    return {{"LAMPLIGHT_CALIBRATION", ""},
            {"XDG_CACHE_HOME", path(cache).string()},
            {"MESA_SHADER_CACHE_DIR", of_user.string()}};
  }
};

void expect_explained(const std::string& text) {
  for (const char* part :
       {"auto: 64x36, ", "candidate", "cull ms", "shade ms", "together", "\nall ", "\ntiled ", "\ntiled-bits ",
        "\nclustered ", "\ntight ", "\nlamplight tile=8", "\ndrobot-zbin ", "\ntakes ", "\ncalibration: "})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in:\n" << text;
}

TEST_F(Auto, IsTheDefaultAndSaysWhatItTook) {
  const json stats = json_of(small({"render", "--json"}));
  EXPECT_NE(stats.at("method"), "auto");
  const std::string text = output_of(small({"render"}));
  EXPECT_NE(text.find(stats.at("method").get<std::string>()), std::string::npos) << text;
  EXPECT_NE(text.find(", chosen by auto"), std::string::npos) << text;
  const json named = json_of(small({"render", "--method", stats.at("method"), "--json"}));
  EXPECT_EQ(named.at("evaluations"), stats.at("evaluations"));
  EXPECT_EQ(output_of(small({"render", "--method", "tiled"})).find("chosen by auto"), std::string::npos);
}

TEST_F(Auto, Explains) {
  expect_explained(output_of(small({"render", "--explain"})));
  expect_explained(output_of(small({"verify", "--explain", "--method", "tiled"})));
  expect_explained(output_of(small({"compare", "auto", "tiled", "--explain"})));
  const Outcome with_json = lamp(small({"render", "--explain", "--json"}));
  EXPECT_EQ(with_json.exit_code, 0);
  EXPECT_TRUE(json::parse(with_json.out, nullptr, false).is_object()) << with_json.out;
  expect_explained(with_json.err);
}

TEST_F(Auto, GathersBoxesToo) {
  for (const char* kind : {"--decals", "--probes"}) {
    const std::string text = output_of(small({"render", "--explain", kind, "2"}));
    EXPECT_NE(text.find("lamplight cells=gather "), std::string::npos) << text;
    EXPECT_EQ(text.find("lamplight cells=gather   cannot run: "), std::string::npos) << text;
  }
}

TEST_F(Auto, IsCheckedLikeAnyMethod) {
  const json rows = json_of(small({"verify", "--method", "auto", "--method", "tiled", "--json"}));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NE(rows[0].at("method"), "auto");
  EXPECT_EQ(rows[0].at("missed"), 0);
}

TEST_F(Auto, ItsRegretStandsInTheResults) {
  write("mine.json", R"({"version": 1, "name": "mine", "series": [{"name": "small", "methods": ["auto", "all", "tiled"],
    "scenes": ["plane"], "sizes": ["32x18"], "frames": 2, "lights": [4, 8]}]})");
  const std::string text = output_of({"bench", "mine.json", "--out", "out", "--explain"});
  EXPECT_NE(text.find("auto took "), std::string::npos) << text;
  EXPECT_NE(text.find("auto: 32x18, 9 lights"), std::string::npos) << text;
  const json results = json::parse(read("out/results.json"));
  ASSERT_EQ(results.at("results").size(), 6U);
  for (const json& result : results.at("results")) {
    const bool is_auto = result.at("parameters").at("method") == "auto";
    EXPECT_EQ(result.contains("regret"), is_auto);
    EXPECT_EQ(result.at("verdict"), "exact");
    EXPECT_NE(result.at("stats").at("method"), "auto");
    if (is_auto) {
      EXPECT_GE(result.at("regret").at("factor"), 1.0);
    }
  }
  EXPECT_EQ(results.at("run").at("regret").at("count"), 2);
  EXPECT_NE(read("out/results.csv").find("regret_factor,regret_best"), std::string::npos);
  EXPECT_NE(read("out/report.html").find("auto took "), std::string::npos);
}

TEST_F(Auto, RefusesWhatMakesNoSense) {
  expect_error(BAD_INPUT, small({"render", "--option", "tile=8"}), {"--option", "auto chooses its own", "--method"});
  expect_error(BAD_INPUT, small({"render", "--calibration", "nowhere.json"}), {"--calibration 'nowhere.json'"});
  const std::vector<Arguments> without{{"render", "--method", "tiled"}, {"verify"},
                                       {"compare", "tiled", "all"},     {"compare", "--panels"},
                                       {"verify", "--points", "9"},     {"bench", "plane", "--method", "tiled"}};
  for (Arguments command : without) {
    command.insert(command.end(), {"--lights", "8", "--calibration", "nowhere.json"});
    expect_error(BAD_INPUT, command, {"--calibration nowhere.json: is of auto alone", "expected --method auto"});
  }
  write("bad.json", R"({"format": "lamplight-calibration", "version": 99})");
  expect_error(BAD_INPUT, small({"render", "--calibration", "bad.json"}),
               {"--calibration 'bad.json'", "version is 99, expected 5"});
  write("mine.json", R"({"version": 1, "name": "mine", "series": [{"name": "small",
    "methods": [{"name": "auto", "options": ["tile=8"]}]}]})");
  expect_error(BAD_INPUT, {"bench", "mine.json"}, {"mine.json", "auto"});
}

// A software device goes by a calibration that is built in: measuring takes it some ten seconds.
TEST_F(Auto, IsMeasuredOnceAndKept) {
  const Arguments explain = small({"render", "--explain"});
  const Outcome built_in = lamp(explain, first_use("cache"));
  EXPECT_EQ(built_in.exit_code, 0) << built_in.err;
  EXPECT_NE(built_in.out.find("calibration: built in, of "), std::string::npos) << built_in.out;
  EXPECT_FALSE(fs::exists(path("cache/lamplight")));

  const Outcome first = lamp(small({"render", "--explain", "--calibration", "measure"}), first_use("cache"));
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.err, "");
  expect_explained(first.out);
  EXPECT_NE(first.out.find("calibration: measured just now in "), std::string::npos) << first.out;
  ASSERT_TRUE(fs::is_directory(path("cache/lamplight")));
  const fs::path kept = fs::directory_iterator(path("cache/lamplight"))->path();
  EXPECT_NE(first.out.find("kept in " + kept.string()), std::string::npos) << first.out;

  const Outcome second = lamp(explain, first_use("cache"));
  EXPECT_NE(second.out.find("calibration: " + kept.string() + "\n"), std::string::npos) << second.out;

  write("cache/lamplight/" + kept.filename().string(), "broken");
  const Outcome third = lamp(explain, first_use("cache"));
  EXPECT_TRUE(third.err.starts_with("auto: " + kept.string() + " is damaged")) << third.err;
  EXPECT_NE(third.out.find("calibration: built in, of "), std::string::npos) << third.out;
}

TEST_F(Auto, WorksWithoutACache) {
  write("file", "no folder");
  const Outcome outcome = lamp(small({"render", "--calibration", "measure"}), first_use("file"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.err.starts_with("auto: the calibration could not be kept, and is measured again next time: "))
      << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
}

}  // namespace
}  // namespace lamp::cli
