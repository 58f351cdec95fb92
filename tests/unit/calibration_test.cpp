// Calibrations as files: what is damaged or another device's is not trusted, and what cannot be kept says why.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "bench/calibration_file.h"
#include "error.h"
#include "temporary_folder.h"
#include "unit/this_system.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Calibration some_calibration() {
  Calibration calibration{.device = "Some GPU", .driver = "1.2"};
  double cost = 0.25;
  for (std::size_t i = 0; i < auto_candidates().size(); ++i) {
    CandidateCost& made = calibration.costs.emplace_back();
    for (double& term : made.cull) term = cost += 0.125;
    for (double& term : made.shade) term = cost += 0.5;
  }
  return calibration;
}

void expect_same(const Calibration& a, const Calibration& b) {
  EXPECT_EQ(a.device, b.device);
  EXPECT_EQ(a.driver, b.driver);
  ASSERT_EQ(a.costs.size(), b.costs.size());
  for (std::size_t i = 0; i < a.costs.size(); ++i) {
    EXPECT_EQ(a.costs[i].cull, b.costs[i].cull);
    EXPECT_EQ(a.costs[i].shade, b.costs[i].shade);
  }
}

class CalibrationFile : public testing::Test {
 protected:
  TemporaryFolder folder_;
  test::Variable caches_{"XDG_CACHE_HOME", folder_.path().string()};
};

TEST_F(CalibrationFile, ComesBackAsItWent) {
  const std::string file = cached_calibration_file("Some GPU", "1.2");
  EXPECT_EQ(std::filesystem::path(file).parent_path(), folder_.path() / "lamplight") << file;
  EXPECT_FALSE(read_cached_calibration(file, "Some GPU", "1.2").has_value()) << "is not there yet";
  EXPECT_EQ(keep_calibration(file, some_calibration()), "");
  const auto back = read_cached_calibration(file, "Some GPU", "1.2");
  ASSERT_TRUE(back.has_value());
  expect_same(*back, some_calibration());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "lamplight"), fs::directory_iterator()), 1)
      << "leaves nothing beside it";
}

TEST_F(CalibrationFile, IsKeyedByDeviceAndDriver) {
  const std::string file = cached_calibration_file("Some GPU", "1.2");
  EXPECT_NE(file, cached_calibration_file("Some GPU", "1.3"));
  EXPECT_NE(file, cached_calibration_file("Other GPU", "1.2"));
  EXPECT_EQ(keep_calibration(file, some_calibration()), "");
  // A file that was moved to another device's name is still not that device's.
  EXPECT_FALSE(read_cached_calibration(file, "Some GPU", "1.3").has_value());
  EXPECT_FALSE(read_cached_calibration(file, "Other GPU", "1.2").has_value());
}

TEST_F(CalibrationFile, WhatIsDamagedIsNotTrusted) {
  const std::string file = (folder_.path() / "calibration.json").string();
  const std::string whole = to_json(some_calibration()).dump(1);
  struct Bad {
    std::string text, error;
  };
  std::vector<Bad> bad{{"", ""},
                       {whole.substr(0, whole.size() / 2), ""},
                       {"{}", "format is missing, expected \"lamplight-calibration\""},
                       {"[]", "is [], expected an object"},
                       {"3", "is 3, expected an object"}};
  const auto with = [&](const std::string& error, const std::function<void(json&)>& change) {
    json document = json::parse(whole);
    change(document);
    bad.push_back({document.dump(), error});
  };
  with("version is 1, expected 5", [](json& d) { d["version"] = 1; });
  with("format is \"lamplight-results\", expected ", [](json& d) { d["format"] = "lamplight-results"; });
  with("device is 5, expected a name", [](json& d) { d["device"] = 5; });
  with("candidates is missing, expected an array of ", [](json& d) { d.erase("candidates"); });
  with("candidates is an array of 10, expected an array of 11 ", [](json& d) { d["candidates"].erase(0); });
  with("candidates[0]: candidate is \"tiled\", expected \"all\"",
       [](json& d) { std::swap(d["candidates"][0], d["candidates"][1]); });
  with("candidates[2]: is 7, expected an object", [](json& d) { d["candidates"][2] = 7; });
  with("candidates[2]: cull[1] is -1.0, expected a number >= 0", [](json& d) { d["candidates"][2]["cull"][1] = -1.0; });
  with("candidates[2]: cull[1] is \"1\", expected a finite ", [](json& d) { d["candidates"][2]["cull"][1] = "1"; });
  with("candidates[2]: shade has 3 elements, expected 4 numbers",
       [](json& d) { d["candidates"][2]["shade"].erase(0); });
  with("candidates[2]: shade is missing, expected 4 numbers", [](json& d) { d["candidates"][2].erase("shade"); });
  for (const auto& [text, problem] : bad) {
    std::ofstream(file, std::ios::binary) << text;
    EXPECT_FALSE(read_cached_calibration(file, "Some GPU", "1.2").has_value()) << text.substr(0, 200);
    try {
      static_cast<void>(parse_calibration(text, "mine.json"));
      ADD_FAILURE() << "was taken: " << text.substr(0, 200);
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("mine.json: " + problem)) << error.what();
    }
  }
  std::ofstream(file, std::ios::binary) << whole;
  EXPECT_TRUE(read_cached_calibration(file, "Some GPU", "1.2").has_value()) << "else the test shows nothing";
}

TEST_F(CalibrationFile, WithoutAFolderItSaysSo) {
  EXPECT_NE(keep_calibration("", some_calibration()), "");
  std::ofstream(folder_.path() / "file") << "x";
  EXPECT_NE(keep_calibration((folder_.path() / "file" / "calibration.json").string(), some_calibration()), "");
  test::Variable::set("XDG_CACHE_HOME", "relative");  // to be ignored, says the specification
  EXPECT_FALSE(cached_calibration_file("a", "b").starts_with("relative"));
}

// What tests and documents go by.
TEST(FixedCalibration, IsOne) {
  const std::string file = LAMPLIGHT_SOURCE_DIR "/tests/calibration.json";
  EXPECT_EQ(load_calibration(file, file).costs.size(), auto_candidates().size());
}

}  // namespace
}  // namespace lamp::app
