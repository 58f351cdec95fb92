// lamp verify --out: the picture of where lights are missed, by either verifier.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"
#include "image/image.h"

namespace lamp::cli {
namespace {

using Misses = CliTest;

// Too small for legends: a panel is the picture's size.
const Arguments MISSING{"verify", "plane",    "--lights", "32",       "--size",
                        "64x36",  "--method", "tiled",    "--option", "test=cone-approximate"};

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Pixels of `a` that are others in `b`.
std::vector<glm::uvec2> differing(const app::LdrImage& a, const app::LdrImage& b) {
  std::vector<glm::uvec2> pixels;
  for (std::uint32_t i = 0; i < a.pixels.size(); ++i)
    if (a.pixels[i] != b.pixels[i]) pixels.emplace_back(i % a.width, i / a.width);
  return pixels;
}

TEST_F(Misses, AreShownWhereTheyAre) {
  const nlohmann::json row = json_of(with(MISSING, {"--json", "-o", "missed.png"})).at(0);
  const std::string words =
      output_of({"verify", "plane", "--lights", "32", "--size", "64x36", "--method", "tiled", "--out", "none.png"});
  EXPECT_NE(words.find("\npicture: none.png\n"), std::string::npos) << words;
  const app::LdrImage none = app::read_png(path("none.png"));
  EXPECT_EQ(glm::uvec2(none.width, none.height), glm::uvec2(64, 36));
  const std::vector<glm::uvec2> pixels = differing(app::read_png(path("missed.png")), none);
  ASSERT_FALSE(pixels.empty());
  EXPECT_LE(pixels.size(), row.at("missed"));
  const std::string first = "pixel (" + std::to_string(pixels[0].x) + ", " + std::to_string(pixels[0].y) + ")";
  const std::string table = output_of(MISSING);
  EXPECT_NE(table.find("first miss: " + first), std::string::npos) << table;
}

TEST_F(Misses, AreTheSameByEitherVerifier) {
  for (const char* verifier : {"oracle", "gpu"})
    (void)output_of(with(MISSING, {"--verifier", verifier, "--out", std::string(verifier) + ".png"}));
  EXPECT_EQ(read("oracle.png"), read("gpu.png"));
}

TEST_F(Misses, HaveAPanelForEachMethodThatMisses) {
  (void)output_of({"verify", "plane", "--lights", "32", "--size", "64x36", "--out", "all.png"});
  const app::LdrImage all = app::read_png(path("all.png"));
  EXPECT_GE(all.width, 64U);
  EXPECT_EQ(all.height % 36, 0U);
  expect_error(BAD_INPUT, with(MISSING, {"--out", "misses.jpg"}), {"--out 'misses.jpg'", "ends in .png"});
}

}  // namespace
}  // namespace lamp::cli
