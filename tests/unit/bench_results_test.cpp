// Results: files of other versions, going on with an earlier run, the table, two runs compared, and the page.
// SPDX-License-Identifier: Apache-2.0
#include "bench/results.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>

#include "bench/comparison.h"
#include "bench/report.h"
#include "bench/summary.h"
#include "error.h"
#include "files/read_json.h"
#include "image/image.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const RunInfo RUN{.command = "lamp bench mine.json",
                  .device = "Device <1>",
                  .device_kind = "discrete GPU",
                  .driver = "driver 2",
                  .commit = "abc",
                  .date = "today"};

Suite suite_of(const std::string& members) {
  return parse_suite(R"({"version": 1, "name": "mine", "series": [{"name": "one", )" + members + "}]}", "mine.json");
}

const Suite SWEEP = suite_of(R"("methods": ["tiled", "tight"], "lights": [16, 64])");

/// A result with these times of the cull, 2 ms of shading besides.
json result_of(const Group& group, const GroupEntry& entry, double cull_ms) {
  const json cull = to_json(Spread{cull_ms, cull_ms, cull_ms, cull_ms, 0.0});
  const json shade = to_json(Spread{2.0, 2.0, 2.0, 2.0, 0.0});
  const json both = to_json(Spread{cull_ms + 2.0, cull_ms + 2.0, cull_ms + 2.0, cull_ms + 2.0, 0.0});
  return {{"series", group.series},
          {"key", key_of(group, entry)},
          {"label", entry.label},
          {"parameters",
           {{"scene", group.scene},
            {"size", group.size},
            {"lights", group.lights},
            {"spots", group.spots},
            {"range", "automatic"},
            {"camera", "first"},
            {"projection", group.projection},
            {"path", entry.path},
            {"method", entry.method}}},
          {"verdict", "exact"},
          {"reason", ""},
          {"times", {{"cull", cull}, {"shade", shade}, {"cull+shade", both}, {"frame", both}}},
          {"stats",
           {{"passes", json::array()},
            {"bytes", {{"total", 100}}},
            {"missed", 0},
            {"useful", 5},
            {"options", {{"tile", "16"}}}}}};
}

/// A whole run; the cull of `tight` takes as many milliseconds as there are lights / 8, that of `tiled` 4.
json run_of(const Suite& suite, const RunInfo& run = RUN, double factor = 1.0) {
  json results = new_results(run, suite);
  for (const Group& group : expand(suite, {}).groups) {
    std::vector<json> entries;
    for (const GroupEntry& entry : group.entries)
      entries.push_back(result_of(group, entry, factor * (entry.method == "tight" ? group.lights / 8.0 : 4.0)));
    add_group(results, entries);
  }
  results["run"]["complete"] = true;
  return results;
}

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class BenchResults : public ::testing::Test {
 protected:
  BenchResults() { std::filesystem::create_directories(folder_); }
  ~BenchResults() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::string load_error(const std::string& text) const {
    const std::filesystem::path file = folder_ / "results.json";
    std::ofstream(file) << text;
    return error_of([&] { static_cast<void>(load_results(file)); });
  }
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("lamp-results-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(BenchResults, FilesThatAreNoneOrOfAnotherVersion) {
  EXPECT_NE(load_error("not json").find("is no JSON: "), std::string::npos);
  EXPECT_NE(load_error("{}").find("is no results file"), std::string::npos);
  json old = run_of(SWEEP);
  old["version"] = RESULTS_VERSION + 1;
  const std::string line = load_error(old.dump());
  EXPECT_NE(line.find("results.json: version: expected 1, got 2"), std::string::npos) << line;
  json damaged = run_of(SWEEP);
  damaged.erase("results");
  EXPECT_NE(load_error(damaged.dump()).find("results is missing, expected an array"), std::string::npos);
  EXPECT_EQ(load_error(run_of(SWEEP).dump()), "no error");
  EXPECT_THROW(static_cast<void>(load_results(folder_ / "nowhere.json")), Error);
}

/// Replaces the value at a pointer.
struct Fault {
  std::string pointer;
  std::string value;
  std::string says;
};

TEST_F(BenchResults, WhatNoBenchWritesIsNamed) {
  for (const Fault& fault : std::vector<Fault>{
           {"/results/1/times/cull/median", "-1", "result 1 times cull: median is -1, expected a number >= 0"},
           {"/results/1/times/frame/p95", "\"1\"", "result 1 times frame: p95 is \"1\", expected a number >= 0"},
           {"/results/1/times/cull+shade", "null", "result 1 times: cull+shade is null, expected an object"},
           {"/results/1/times", "[]", "result 1: times is [], expected an object"},
           {"/results/1/verdict", "\"fine\"", "result 1: verdict is \"fine\", expected one of exact, approximate"},
           {"/results/1/key", "5", "result 1: key is 5, expected a string"},
           {"/results/1/parameters/lights", "-1", "result 1 parameters: lights is -1, expected an integer 0 .. "},
           {"/results/1/parameters/spots", "2", "result 1 parameters: spots is 2, expected a number 0 .. 1"},
           {"/results/1/stats/options/tile", "16",
            "result 1 stats: options is an object, expected an object of strings"},
           {"/results/1/stats/missed", "-5", "result 1 stats: missed is -5, expected an integer 0 .. "},
           {"/results/1/samples", R"([{"frame": 0, "lights": 1, "cull": 1, "shade": -2, "frame_ms": 3}])",
            "result 1 sample 0: shade is -2, expected a number >= 0"},
           {"/results/1/rounds", "[1, -1]", "result 1: rounds is [1,-1], expected numbers >= 0"},
           {"/results/1/pictures", R"({"picture": 1})",
            "result 1: pictures is an object, expected an object of strings"},
           {"/results/1", "7", "results is [{\"key\":"},
           {"/results", "7", "results is 7, expected an array of objects, at most 65536 in the file"},
           {"/suite/series/0/chart/x", "1", "series 0 chart: x is 1, expected a string"},
           {"/run/complete", "1", "run: complete is 1, expected true or false"},
           {"/run/device", "null", "run: device is null, expected a string"}}) {
    SCOPED_TRACE(fault.pointer + " = " + fault.value);
    json results = run_of(SWEEP);
    results[json::json_pointer(fault.pointer)] = json::parse(fault.value);
    const std::string line = load_error(results.dump());
    EXPECT_NE(line.find("results.json: " + fault.says), std::string::npos) << line;
  }
  json unchecked = run_of(SWEEP);
  unchecked["results"][0]["verdict"] = "could not check";
  EXPECT_EQ(load_error(unchecked.dump()), "no error");
  json untimed = run_of(SWEEP);
  untimed["results"][0]["times"] = nullptr;
  EXPECT_EQ(load_error(untimed.dump()), "no error");
}

TEST_F(BenchResults, ARunGoesOnWhereItStopped) {
  const std::vector<Group> groups = expand(SWEEP, {}).groups;
  json earlier = run_of(SWEEP);
  earlier["results"].erase(3);  // of the second group, one entry
  json results = new_results(RUN, SWEEP);
  EXPECT_EQ(take_over(results, earlier, groups), 1U);
  EXPECT_TRUE(has_group(results, groups[0]));
  EXPECT_FALSE(has_group(results, groups[1])) << "entries of a group were timed in the same rounds, or not at all";
  EXPECT_EQ(results["results"].size(), 3U) << "what is to be measured again stays until then";
}

TEST_F(BenchResults, ThatAreTakenOverHaveTheNamesOfNow) {
  std::vector<Group> groups = expand(SWEEP, {}).groups;
  for (Group& group : groups)
    for (GroupEntry& entry : group.entries) entry.label += ", renamed";
  json results = new_results(RUN, SWEEP);
  EXPECT_EQ(take_over(results, run_of(SWEEP), groups), 0U);
  ASSERT_EQ(results["results"].size(), 4U);
  for (const json& result : results["results"]) EXPECT_TRUE(result["label"].get<std::string>().ends_with(", renamed"));
}

TEST_F(BenchResults, OfAClockThatMovedAreMeasuredAgain) {
  const std::vector<Group> groups = expand(SWEEP, {}).groups;
  json earlier = run_of(SWEEP);
  earlier["results"][0]["clock_moved"] = true;
  json results = new_results(RUN, SWEEP);
  EXPECT_EQ(take_over(results, earlier, groups), 2U);
  EXPECT_FALSE(has_group(results, groups[0]));
}

TEST_F(BenchResults, OfFilesThatHaveChangedAreNotTakenOver) {
  std::vector<Group> groups = expand(SWEEP, {}).groups;
  json earlier = run_of(SWEEP);
  const auto left = [&] {
    json results = new_results(RUN, SWEEP);
    check_earlier(results, earlier, "results.json", groups);  // the keys are the same
    return take_over(results, earlier, groups);
  };
  EXPECT_EQ(left(), 0U);
  groups[0].scene_hash = "1";
  EXPECT_EQ(left(), 2U) << "nobody knows of which files they are";
  for (int i : {0, 1}) earlier["results"][i]["hashes"] = {{"scene", "1"}};
  EXPECT_EQ(left(), 0U);
  groups[0].scene_hash = "2";
  EXPECT_EQ(left(), 2U);
  groups[0].scene_hash = "1";
  groups[1].entries[1].calibration_hash = "3";
  EXPECT_EQ(left(), 2U) << "both of the group";
  earlier["results"][3]["hashes"] = {{"calibration", "3"}};
  EXPECT_EQ(left(), 0U);
  EXPECT_EQ(load_error(earlier.dump()), "no error");
}

// No JSON can hold bytes that are no UTF-8.
TEST_F(BenchResults, OfASceneWithAnyNameAreFoundAgain) {
  std::vector<Group> groups = expand(SWEEP, {}).groups;
  groups[0].scene = "caf\xe9 \x1b.glb";
  const GroupEntry& entry = groups[0].entries[0];
  json earlier = run_of(SWEEP);
  earlier["results"] = json::array();
  add_group(earlier, {result_of(groups[0], entry, 1.0), result_of(groups[0], groups[0].entries[1], 1.0)});
  EXPECT_TRUE(has_group(json::parse(json_text(earlier, 1)), groups[0]));
}

TEST_F(BenchResults, AnotherSuiteDeviceOrCommitIsRefused) {
  const std::vector<Group> groups = expand(SWEEP, {}).groups;
  const auto line = [&](const RunInfo& then, const std::string& suite) {
    json earlier = run_of(SWEEP, then);
    earlier["suite"]["name"] = suite;
    const json results = new_results(RUN, SWEEP);
    return error_of([&] { check_earlier(results, earlier, "out/results.json", groups); });
  };
  EXPECT_EQ(line(RUN, "mine"), "no error");
  EXPECT_NE(line(RUN, "other").find("out/results.json: holds the suite \"other\""), std::string::npos);
  RunInfo other = RUN;
  other.device = "Device 3";
  EXPECT_NE(line(other, "mine").find("device \"Device 3\""), std::string::npos);
  other = RUN;
  other.commit = "def";
  EXPECT_NE(line(other, "mine").find("another --out, or --overwrite"), std::string::npos);
  other = RUN;
  other.shaders = "0123456789abcdef";
  EXPECT_NE(line(other, "mine").find("measured with shaders \"0123456789abcdef\", and now it is \"built in\""),
            std::string::npos);
  other = RUN;
  other.pipeline_statistics = "on";
  EXPECT_NE(line(other, "mine").find("pipeline_statistics \"on\""), std::string::npos);
}

TEST_F(BenchResults, ARunThatDoesNotSayItsShadersHadThoseBuiltIn) {
  json earlier = run_of(SWEEP);
  earlier["run"].erase("shaders");
  earlier["run"].erase("pipeline_statistics");
  const json results = new_results(RUN, SWEEP);
  EXPECT_EQ(error_of([&] { check_earlier(results, earlier, "results.json", expand(SWEEP, {}).groups); }), "no error");
}

TEST_F(BenchResults, WhatWouldBeLostIsRefused) {
  const json earlier = run_of(SWEEP);
  const json results = new_results(RUN, SWEEP);
  const auto line = [&](const Limits& limits) {
    const std::vector<Group> groups = expand(SWEEP, limits).groups;
    return error_of([&] { check_earlier(results, earlier, "results.json", groups); });
  };
  EXPECT_EQ(line({}), "no error");
  const std::string fewer = line({.max_lights = 16});
  EXPECT_TRUE(fewer.starts_with("results.json: 2 of its 4 results would be lost")) << fewer;
  EXPECT_NE(fewer.find("'one: atrium 1280x720 lights=64 "), std::string::npos) << fewer;
  EXPECT_NE(fewer.find("expected another --out, or --overwrite"), std::string::npos) << fewer;
  EXPECT_TRUE(line({.frames = 500}).starts_with("results.json: 4 of its 4 results would be lost"));
}

TEST_F(BenchResults, TheTableHasARowAResult) {
  json results = run_of(SWEEP);
  results["results"][0]["label"] = "a \"label\", quoted";
  const std::string csv = results_csv(results);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 4);
  EXPECT_NE(csv.find("\"a \"\"label\"\", quoted\""), std::string::npos);
  EXPECT_NE(csv.substr(0, csv.find('\n')).find("cull_ms_median"), std::string::npos);
  results["results"][1]["verdict"] = "impossible";
  results["results"][1]["stats"] = json::object();
  results["results"][1]["times"] = nullptr;
  EXPECT_NE(results_csv(results).find(",impossible,,atrium,1280x720,"), std::string::npos) << results_csv(results);
}

TEST_F(BenchResults, WordsComeFromTheNumbers) {
  const json results = run_of(SWEEP);
  const std::vector<ChartPanel> panels = chart_panels(results, "results.json");
  ASSERT_EQ(panels.size(), 1U);
  ASSERT_EQ(panels[0].lines.size(), 2U);
  EXPECT_EQ(panels[0].lines[0].points.size(), 2U);
  const std::vector<std::string> words = panel_summary(results, panels[0]);
  ASSERT_EQ(words.size(), 2U);
  EXPECT_EQ(words[0], "cull and shade, with 64 lights: tiled is ahead with 6 ms; next is tight (1.67×).");
  EXPECT_EQ(words[1], "The lead changes: tight up to 16 lights, then tiled.");
  EXPECT_NE(run_summary(results).at(0).find("4 missed no light"), std::string::npos);
  json alone = results;
  alone["results"][0]["verified"] = "picture, lists alone, by gpu";
  EXPECT_NE(run_summary(alone).at(0).find("1 missed no light (too many for brute force"), std::string::npos);
}

TEST_F(BenchResults, WhatMayBeNoiseIsLevel) {
  json results = run_of(SWEEP);
  for (json& result : results["results"]) result["times"]["cull+shade"]["p95"] = 100.0;
  const std::vector<std::string> words = panel_summary(results, chart_panels(results, "results.json").at(0));
  EXPECT_EQ(words, (std::vector<std::string>{"cull and shade, with 64 lights: tiled and tight are level with 6 ms."}));
}

TEST_F(BenchResults, NumbersInWords) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(1234.5), "1234");
  EXPECT_EQ(short_number(12.34), "12.3");
  EXPECT_EQ(short_number(0.01), "0.01");
  EXPECT_EQ(short_number(0.0045678), "0.00457");
}

TEST_F(BenchResults, TwoRunsGiveRatios) {
  const json a = run_of(SWEEP);
  json b = run_of(suite_of(R"("methods": ["tiled", "tight"], "lights": [16, 64], "frames": 500)"), RUN, 0.5);
  b["results"].erase(3);
  const Comparison compared = compare_runs(a, b);
  EXPECT_EQ(compared.rows.size(), 3U) << "the number of frames may differ";
  EXPECT_EQ(compared.only_a, 1U);
  EXPECT_EQ(compared.only_b, 0U);
  ASSERT_EQ(compared.lines.size(), 2U);
  EXPECT_EQ(compared.lines[0].label, "tiled");
  EXPECT_DOUBLE_EQ(compared.lines[0].cull_ratio, 0.5);
  EXPECT_DOUBLE_EQ(compared.lines[0].cull_shade_ratio, 4.0 / 6.0);
}

TEST_F(BenchResults, TimesOfAFileThatChangedAreNotCompared) {
  json a = run_of(SWEEP);
  json b = a;
  const std::size_t timed = compare_runs(a, b).rows.size();
  ASSERT_GT(timed, 1U);
  a["results"][0]["hashes"] = {{"scene", "one"}};
  EXPECT_EQ(compare_runs(a, b).rows.size(), timed) << "an older run has no hashes";
  b["results"][0]["hashes"] = {{"scene", "other"}};
  const Comparison compared = compare_runs(a, b);
  EXPECT_EQ(compared.rows.size(), timed - 1);
  EXPECT_EQ(compared.other_scene, 1U);
  EXPECT_EQ(compared.only_a + compared.only_b, 0U);
}

TEST_F(BenchResults, ThePageIsWholeAndNothingInTheDataEndsItsScript) {
  json results = run_of(SWEEP);
  results["suite"]["title"] = "a </script> & more";
  const ReportRun run{.results = results, .file = folder_ / "results.json"};
  const std::string page = report_html({&run, 1});
  EXPECT_NE(page.find("<title>a &lt;/script> &amp; more - Lamplight</title>"), std::string::npos);
  EXPECT_EQ(page.find("a </script>"), std::string::npos);
  EXPECT_NE(page.find("Chart.js v3.9.1"), std::string::npos) << "the chart library is inlined";
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const char* left : {"@TITLE@", "@DATA@", "@SCRIPT@"}) EXPECT_EQ(page.find(left), std::string::npos) << left;
}

TEST_F(BenchResults, ThePageTakesPicturesOfItsFolderAlone) {
  const fs::path elsewhere = folder_ / "elsewhere";
  const fs::path own = folder_ / "own";
  for (const fs::path& folder : {elsewhere, own / "pictures"}) fs::create_directories(folder);
  write_png(own / "pictures" / "a.png", {1, 1, {glm::u8vec4(255)}});
  write_png(elsewhere / "a.png", {1, 1, {glm::u8vec4(0)}});
  std::ofstream(own / "secret.png") << "root:x:0:0";
  fs::create_symlink(elsewhere / "a.png", own / "link.png");
  fs::create_symlink(elsewhere, own / "links");
  fs::create_symlink("pictures/a.png", own / "within.png");
  fs::copy_file(own / "pictures" / "a.png", own / "large.png");
  fs::resize_file(own / "large.png", (std::uintmax_t{1} << 26U) + 1);
  const auto page_of = [&](const std::string& name) {
    json results = run_of(SWEEP);
    results["results"][1]["pictures"] = {{"picture", name}};
    const ReportRun run{.results = results, .file = own / "results.json"};
    return report_html({&run, 1});
  };
  for (const char* name : {"pictures/a.png", "./pictures/../pictures/a.png", "within.png"})
    EXPECT_NE(page_of(name).find("data:image/png;base64,iVBORw0KGgo"), std::string::npos) << name;
  EXPECT_EQ(page_of("pictures/gone.png").find("data:image/png"), std::string::npos);
  for (const std::string& name : {(elsewhere / "a.png").string(), std::string("../elsewhere/a.png"),
                                  std::string("pictures/../../elsewhere/a.png"), std::string("link.png"),
                                  std::string("links/a.png"), std::string("secret.png"), std::string("")}) {
    const std::string line = error_of([&] { static_cast<void>(page_of(name)); });
    EXPECT_NE(line.find("results.json: result 1: pictures picture is '" + name +
                        "', expected the name of a PNG file below the folder of results.json"),
              std::string::npos)
        << line;
  }
  for (const auto& [name, says] :
       {std::pair{"pictures", "is a folder"}, {"large.png", "has 67108865 bytes, expected"}}) {
    const std::string line = error_of([&] { static_cast<void>(page_of(name)); });
    EXPECT_NE(line.find(says), std::string::npos) << line;
  }
}

TEST_F(BenchResults, ADamagedRunIsNamed) {
  json results = run_of(SWEEP);
  results["results"][1].erase("parameters");
  const ReportRun run{.results = results, .file = "far/results.json"};
  const std::string line = error_of([&] { static_cast<void>(report_html({&run, 1})); });
  EXPECT_NE(line.find("far/results.json: is damaged"), std::string::npos) << line;
}

}  // namespace
}  // namespace lamp::app
