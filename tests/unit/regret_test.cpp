// The regret of `auto` from results: against whom, by how much, and in words.
// SPDX-License-Identifier: Apache-2.0
#include "bench/regret.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace lamp::app {
namespace {

using nlohmann::json;

json result(const std::string& method, double ms, int lights, const std::string& verdict = "exact") {
  return {{"series", "one"},
          {"label", method},
          {"verdict", verdict},
          {"parameters", {{"scene", "atrium"}, {"size", "64x36"}, {"lights", lights}, {"method", method}}},
          {"stats", {{"method", method == "auto" ? "tight" : method}}},
          {"times", {{"cull+shade", {{"median", ms}}}}}};
}

TEST(Regret, IsAgainstTheBestForTheSameFrames) {
  json results{{"run", json::object()}, {"results", json::array()}};
  json untimed = result("clustered", 0.0, 8);
  untimed["times"] = nullptr;
  for (const json& one : {result("auto", 2.0, 8), result("tiled", 1.0, 8), result("tight", 2.1, 8), untimed,
                          result("primal", 0.1, 8, "approximate"), result("tiled", 0.2, 16), result("auto", 3.0, 32),
                          result("tiled", 4.0, 32)})
    results["results"].push_back(one);
  results["results"][1]["parameters"]["option:tile"] = "8";  // an option does not make other frames
  add_regret(results);
  const json& first = results["results"][0]["regret"];
  EXPECT_EQ(first["factor"], 2.0);
  EXPECT_EQ(first["best"], "tiled");
  EXPECT_EQ(first["best_ms"], 1.0);
  EXPECT_EQ(results["results"][6]["regret"]["factor"], 1.0) << "auto itself is the best";
  EXPECT_FALSE(results["results"][1].contains("regret"));
  const json& all = results["run"]["regret"];
  EXPECT_EQ(all["count"], 2);
  EXPECT_NEAR(all["mean"].get<double>(), std::sqrt(2.0), 1e-9);
  EXPECT_EQ(all["worst"], 2.0);
  EXPECT_EQ(regret_words(results),
            "auto took 1.41 times the best method's time of cull and shading on average (geometric mean of 2 "
            "configurations), at worst 2 times: atrium 64x36 8 lights: tight instead of tiled.");
}

// Half of the rounds at a third of the clock: medians would fall on either side.
TEST(Regret, ComparesWithinARound) {
  json results{{"run", json::object()}, {"results", {result("auto", 3.3, 8), result("tiled", 1.0, 8)}}};
  results["results"][0]["rounds"] = {1.1, 3.3, 3.3, 1.1, 3.3};
  results["results"][1]["rounds"] = {1.0, 3.0, 3.0, 1.0, 1.0};
  add_regret(results);
  EXPECT_NEAR(results["results"][0]["regret"]["factor"].get<double>(), 1.1, 1e-9);
  EXPECT_EQ(results["results"][0]["regret"]["best"], "tiled");
  results["results"][1]["rounds"] = {1.0, 3.0};  // not the same rounds
  add_regret(results);
  EXPECT_NEAR(results["results"][0]["regret"]["factor"].get<double>(), 3.3, 1e-9);
}

TEST(Regret, NothingWithoutAuto) {
  json results{{"run", json::object()}, {"results", {result("tiled", 1.0, 8)}}};
  add_regret(results);
  EXPECT_FALSE(results["run"].contains("regret"));
  EXPECT_EQ(regret_words(results), "");
}

}  // namespace
}  // namespace lamp::app
