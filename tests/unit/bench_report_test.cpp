// What is made of results: words, two runs compared, and the page.
// SPDX-License-Identifier: Apache-2.0
#include "bench/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

#include "bench/comparison.h"
#include "bench/summary.h"
#include "image/image.h"
#include "temporary_folder.h"
#include "unit/bench_runs.h"
#include "unit/this_system.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class BenchReport : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(BenchReport, WordsComeFromTheNumbers) {
  const json results = test::run_of(test::SWEEP);
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

TEST_F(BenchReport, WhatMayBeNoiseIsLevel) {
  json results = test::run_of(test::SWEEP);
  for (json& result : results["results"]) result["times"]["cull+shade"]["p95"] = 100.0;
  const std::vector<std::string> words = panel_summary(results, chart_panels(results, "results.json").at(0));
  EXPECT_EQ(words, (std::vector<std::string>{"cull and shade, with 64 lights: tiled and tight are level with 6 ms."}));
}

TEST_F(BenchReport, NumbersInWords) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(1234.5), "1234");
  EXPECT_EQ(short_number(12.34), "12.3");
  EXPECT_EQ(short_number(0.01), "0.01");
  EXPECT_EQ(short_number(0.0045678), "0.00457");
}

TEST_F(BenchReport, TwoRunsGiveRatios) {
  const json a = test::run_of(test::SWEEP);
  json b = test::run_of(test::suite_of(R"("methods": ["tiled", "tight"], "lights": [16, 64], "frames": 500)"),
                        test::RUN, 0.5);
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

/// Brute force has no cull.
TEST_F(BenchReport, TimesOfNothingHaveNoRatio) {
  json a = test::run_of(test::SWEEP);
  json b = test::run_of(test::SWEEP, test::RUN, 0.5);
  for (json* run : {&a, &b}) (*run)["results"][0]["times"]["cull"]["median"] = 0.0;
  const Comparison compared = compare_runs(a, b);
  EXPECT_EQ(compared.rows[0].cull_ratio, 0.0);
  EXPECT_DOUBLE_EQ(compared.lines[0].cull_ratio, 0.5) << "the mean of the others";
  EXPECT_TRUE(compared.rows[0].cull_shade_ratio > 0.0);
}

TEST_F(BenchReport, TimesOfAFileThatChangedAreNotCompared) {
  json a = test::run_of(test::SWEEP);
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

TEST_F(BenchReport, ThePageIsWholeAndNothingInTheDataEndsItsScript) {
  json results = test::run_of(test::SWEEP);
  results["suite"]["title"] = "a </script> & more";
  const ReportRun run{.results = results, .file = folder_.path() / "results.json"};
  const std::string page = report_html({&run, 1});
  EXPECT_NE(page.find("<title>a &lt;/script> &amp; more - Lamplight</title>"), std::string::npos);
  EXPECT_EQ(page.find("a </script>"), std::string::npos);
  EXPECT_NE(page.find("Chart.js v3.9.1"), std::string::npos) << "the chart library is inlined";
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const char* left : {"@TITLE@", "@DATA@", "@SCRIPT@"}) EXPECT_EQ(page.find(left), std::string::npos) << left;
}

TEST_F(BenchReport, ThePageTakesPicturesOfItsFolderAlone) {
  if (!test::has_links()) GTEST_SKIP() << test::NO_LINKS;
  const fs::path elsewhere = folder_.path() / "elsewhere";
  const fs::path own = folder_.path() / "own";
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
    json results = test::run_of(test::SWEEP);
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
    const std::string line = test::error_of([&] { static_cast<void>(page_of(name)); });
    EXPECT_NE(line.find("results.json: result 1: pictures picture is '" + name +
                        "', expected the name of a PNG file below the folder of results.json"),
              std::string::npos)
        << line;
  }
  for (const auto& [name, says] :
       {std::pair{"pictures", "is a folder"}, {"large.png", "has 67108865 bytes, expected"}}) {
    const std::string line = test::error_of([&] { static_cast<void>(page_of(name)); });
    EXPECT_NE(line.find(says), std::string::npos) << line;
  }
}

TEST_F(BenchReport, ADamagedRunIsNamed) {
  json results = test::run_of(test::SWEEP);
  results["results"][1].erase("parameters");
  const ReportRun run{.results = results, .file = "far/results.json"};
  const std::string line = test::error_of([&] { static_cast<void>(report_html({&run, 1})); });
  EXPECT_NE(line.find("far/results.json: is damaged"), std::string::npos) << line;
}

}  // namespace
}  // namespace lamp::app
