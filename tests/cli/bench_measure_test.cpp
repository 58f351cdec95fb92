// lamp bench: what configurations of a group have of each other, which is nothing, and what ends a run.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using nlohmann::json;

class BenchMeasure : public CliTest {
 protected:
  /// A suite of one series with pictures of 32 x 18 pixels and these members besides.
  void write_suite(const std::string& members) const {
    write("mine.json",
          R"({"version": 1, "name": "mine", "series": [{"name": "small", "scenes": ["plane"], "sizes": ["32x18"],
      "frames": 3, )" +
              members + "}]}");
  }
  [[nodiscard]] json measured(const std::string& members) const {
    write_suite(members);
    const std::string text = output_of({"bench", "mine.json", "--out", "out"});
    EXPECT_NE(text.find("2 configurations measured, 0 wrong"), std::string::npos) << text;
    return json::parse(read("out/results.json")).at("results");
  }
};

/// Lights move in every frame, and so all methods draw their maps in it: none is given those of the one before.
TEST_F(BenchMeasure, EveryMethodDrawsItsShadowMaps) {
  const json results =
      measured(R"("lights": [4], "methods": ["tiled", "clustered"], "shadows": "hard", "atlas": 512, "verify": false)");
  ASSERT_EQ(results.size(), 2U);
  for (const json& result : results)
    EXPECT_TRUE(std::ranges::any_of(result.at("stats").at("passes"), [](const json& pass) {
      return pass.at("name") == "shadow maps";
    })) << result.at("key");
}

TEST_F(BenchMeasure, MirrorsBesideProbes) {
  const json results = measured(R"("lights": [4], "methods": ["tiled", "clustered"], "mirror": 0.5, "probes": [2])");
  EXPECT_EQ(results.size(), 2U);
}

/// The lists of one entry are not those of another's picture.
TEST_F(BenchMeasure, PicturesAreOfEachEntrysOwnLists) {
  const json results =
      measured(R"("lights": [8], "methods": [{"name": "tiled", "still_lists": "world-tree"}, "clustered"],
      "still": 0.5, "pictures": true, "decals": [2], "shadows": "hard", "atlas": 512)");
  const auto picture = [&](std::size_t i) {
    return read("out/" + results.at(i).at("pictures").at("picture").get<std::string>());
  };
  EXPECT_EQ(picture(0), picture(1));
}

TEST_F(BenchMeasure, AShaderThatDoesNotCompileEndsIt) {
  write_suite(R"("lights": [4], "methods": ["tiled"])");
  const Outcome run = lamp({"bench", "mine.json", "--out", "out", "--shader-dir", "nowhere"});
  EXPECT_EQ(run.exit_code, BAD_INPUT);
  EXPECT_NE(run.err.find("--shader-dir nowhere: has no source"), std::string::npos) << run.err;
}

TEST_F(BenchMeasure, OneRunAtATimeWritesToAFolder) {
  write_suite(R"("lights": [4], "methods": ["tiled"])");
  const Outcome run = shell("mkdir out; flock out \"$LAMP\" bench mine.json --out out");
  EXPECT_EQ(run.exit_code, BAD_INPUT);
  EXPECT_NE(run.err.find("another lamp bench writes to it"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace lamp::cli
