// Results: files of other versions, going on with an earlier run, and the table.
// SPDX-License-Identifier: Apache-2.0
#include "bench/results.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>

#include "files/read_json.h"
#include "temporary_folder.h"
#include "unit/bench_runs.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class BenchResults : public ::testing::Test {
 protected:
  std::string load_error(const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "results.json";
    std::ofstream(file) << text;
    return test::error_of([&] { static_cast<void>(load_results(file)); });
  }
  TemporaryFolder folder_;
};

TEST_F(BenchResults, FilesThatAreNoneOrOfAnotherVersion) {
  EXPECT_NE(load_error("not json").find("is no JSON: "), std::string::npos);
  EXPECT_NE(load_error("{}").find("is no results file"), std::string::npos);
  json old = test::run_of(test::SWEEP);
  old["version"] = RESULTS_VERSION + 1;
  const std::string line = load_error(old.dump());
  EXPECT_NE(line.find("results.json: version: expected 1, got 2"), std::string::npos) << line;
  json damaged = test::run_of(test::SWEEP);
  damaged.erase("results");
  EXPECT_NE(load_error(damaged.dump()).find("results is missing, expected an array"), std::string::npos);
  EXPECT_EQ(load_error(test::run_of(test::SWEEP).dump()), "no error");
  EXPECT_THROW(static_cast<void>(load_results(folder_.path() / "nowhere.json")), Error);
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
           {"/results/1/stats/notes", "5", "result 1 stats: notes is 5, expected an array of strings"},
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
    json results = test::run_of(test::SWEEP);
    results[json::json_pointer(fault.pointer)] = json::parse(fault.value);
    const std::string line = load_error(results.dump());
    EXPECT_NE(line.find("results.json: " + fault.says), std::string::npos) << line;
  }
  json unchecked = test::run_of(test::SWEEP);
  unchecked["results"][0]["verdict"] = "could not check";
  EXPECT_EQ(load_error(unchecked.dump()), "no error");
  json untimed = test::run_of(test::SWEEP);
  untimed["results"][0]["times"] = nullptr;
  EXPECT_EQ(load_error(untimed.dump()), "no error");
}

TEST_F(BenchResults, ARunGoesOnWhereItStopped) {
  const std::vector<Group> groups = expand(test::SWEEP, {}).groups;
  json earlier = test::run_of(test::SWEEP);
  earlier["results"].erase(3);  // of the second group, one entry
  json results = new_results(test::RUN, test::SWEEP);
  EXPECT_EQ(take_over(results, earlier, groups), 1U);
  EXPECT_TRUE(has_group(results, groups[0]));
  EXPECT_FALSE(has_group(results, groups[1])) << "entries of a group were timed in the same rounds, or not at all";
  EXPECT_EQ(results["results"].size(), 3U) << "what is to be measured again stays until then";
}

TEST_F(BenchResults, ThatAreTakenOverHaveTheNamesOfNow) {
  std::vector<Group> groups = expand(test::SWEEP, {}).groups;
  for (Group& group : groups)
    for (GroupEntry& entry : group.entries) entry.label += ", renamed";
  json results = new_results(test::RUN, test::SWEEP);
  EXPECT_EQ(take_over(results, test::run_of(test::SWEEP), groups), 0U);
  ASSERT_EQ(results["results"].size(), 4U);
  for (const json& result : results["results"]) EXPECT_TRUE(result["label"].get<std::string>().ends_with(", renamed"));
}

TEST_F(BenchResults, OfAClockThatMovedAreMeasuredAgain) {
  const std::vector<Group> groups = expand(test::SWEEP, {}).groups;
  json earlier = test::run_of(test::SWEEP);
  earlier["results"][0]["clock_moved"] = true;
  json results = new_results(test::RUN, test::SWEEP);
  EXPECT_EQ(take_over(results, earlier, groups), 2U);
  EXPECT_FALSE(has_group(results, groups[0]));
}

TEST_F(BenchResults, OfFilesThatHaveChangedAreNotTakenOver) {
  std::vector<Group> groups = expand(test::SWEEP, {}).groups;
  json earlier = test::run_of(test::SWEEP);
  const auto left = [&] {
    json results = new_results(test::RUN, test::SWEEP);
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
  std::vector<Group> groups = expand(test::SWEEP, {}).groups;
  groups[0].scene = "caf\xe9 \x1b.glb";
  const GroupEntry& entry = groups[0].entries[0];
  json earlier = test::run_of(test::SWEEP);
  earlier["results"] = json::array();
  add_group(earlier, {test::result_of(groups[0], entry, 1.0), test::result_of(groups[0], groups[0].entries[1], 1.0)});
  EXPECT_TRUE(has_group(json::parse(json_text(earlier, 1)), groups[0]));
}

TEST_F(BenchResults, AnotherSuiteDeviceOrCommitIsRefused) {
  const std::vector<Group> groups = expand(test::SWEEP, {}).groups;
  const auto line = [&](const RunInfo& then, const std::string& suite) {
    json earlier = test::run_of(test::SWEEP, then);
    earlier["suite"]["name"] = suite;
    const json results = new_results(test::RUN, test::SWEEP);
    return test::error_of([&] { check_earlier(results, earlier, "out/results.json", groups); });
  };
  EXPECT_EQ(line(test::RUN, "mine"), "no error");
  EXPECT_NE(line(test::RUN, "other").find("out/results.json: holds the suite \"other\""), std::string::npos);
  RunInfo other = test::RUN;
  other.device = "Device 3";
  EXPECT_NE(line(other, "mine").find("device \"Device 3\""), std::string::npos);
  other = test::RUN;
  other.commit = "def";
  EXPECT_NE(line(other, "mine").find("another --out, or --overwrite"), std::string::npos);
  other = test::RUN;
  other.shaders = "0123456789abcdef";
  EXPECT_NE(line(other, "mine").find("measured with shaders \"0123456789abcdef\", and now it is \"built in\""),
            std::string::npos);
  other = test::RUN;
  other.pipeline_statistics = "on";
  EXPECT_NE(line(other, "mine").find("pipeline_statistics \"on\""), std::string::npos);
}

TEST_F(BenchResults, ARunThatDoesNotSayItsShadersHadThoseBuiltIn) {
  json earlier = test::run_of(test::SWEEP);
  earlier["run"].erase("shaders");
  earlier["run"].erase("pipeline_statistics");
  const json results = new_results(test::RUN, test::SWEEP);
  EXPECT_EQ(test::error_of([&] { check_earlier(results, earlier, "results.json", expand(test::SWEEP, {}).groups); }),
            "no error");
}

TEST_F(BenchResults, WhatWouldBeLostIsRefused) {
  const json earlier = test::run_of(test::SWEEP);
  const json results = new_results(test::RUN, test::SWEEP);
  const auto line = [&](const Limits& limits) {
    const std::vector<Group> groups = expand(test::SWEEP, limits).groups;
    return test::error_of([&] { check_earlier(results, earlier, "results.json", groups); });
  };
  EXPECT_EQ(line({}), "no error");
  const std::string fewer = line({.max_lights = 16});
  EXPECT_TRUE(fewer.starts_with("results.json: 2 of its 4 results would be lost")) << fewer;
  EXPECT_NE(fewer.find("'one: atrium 1280x720 lights=64 "), std::string::npos) << fewer;
  EXPECT_NE(fewer.find("expected another --out, or --overwrite"), std::string::npos) << fewer;
  EXPECT_TRUE(line({.frames = 500}).starts_with("results.json: 4 of its 4 results would be lost"));
}

TEST_F(BenchResults, TheTableHasARowAResult) {
  json results = test::run_of(test::SWEEP);
  results["results"][0]["label"] = "a \"label\", quoted";
  results["results"][0]["stats"]["notes"] = {"first, of a device", "second"};
  const std::string csv = results_csv(results);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 4);
  EXPECT_NE(csv.find("\"a \"\"label\"\", quoted\""), std::string::npos);
  EXPECT_NE(csv.substr(0, csv.find('\n')).find("cull_ms_median"), std::string::npos);
  EXPECT_NE(csv.find(",regret_factor,regret_best,notes\n"), std::string::npos);
  EXPECT_NE(csv.find(",\"first, of a device; second\"\n"), std::string::npos) << csv;
  results["results"][1]["verdict"] = "impossible";
  results["results"][1]["stats"] = json::object();
  results["results"][1]["times"] = nullptr;
  EXPECT_NE(results_csv(results).find(",impossible,,atrium,1280x720,"), std::string::npos) << results_csv(results);
}

}  // namespace
}  // namespace lamp::app
