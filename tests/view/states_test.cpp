// The states of docs/viewer.md against the page's pictures, so that neither they nor the screen change unseen.
// To accept a change: tools/viewer_pictures, then look at the new pictures.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "view/view_test.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr glm::uvec2 WITH_PANELS(1280, 760);  // as in tools/viewer_pictures
constexpr glm::uvec2 WITHOUT(960, 540);
constexpr std::uint32_t STATUS_PX = 24;  // at the bottom: times, which differ
constexpr std::uint32_t BLOCK_PX = 20;
// Of 255. Devices filter textures and cover edges differently, which averages out over a block; a panel, an overlay or
// a light does not.
constexpr double MEAN_LEVELS = 7.0;
constexpr double BLOCK_LEVELS = 5.0;

std::vector<std::string> state_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(LAMPLIGHT_SOURCE_DIR) / "docs/states"))
    names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

struct Difference {
  double mean = 0.0;
  double blocks = 0.0;  ///< root mean square, of blocks' means
};

Difference difference(const LdrImage& a, const LdrImage& b) {
  Difference found;
  const glm::uvec2 blocks(a.width / BLOCK_PX, (a.height - STATUS_PX) / BLOCK_PX);
  const double count = blocks.x * blocks.y;
  for (std::uint32_t block = 0; block < blocks.x * blocks.y; ++block) {
    glm::dvec3 sum(0.0);
    double levels = 0.0;
    for (std::uint32_t i = 0; i < BLOCK_PX * BLOCK_PX; ++i) {
      const std::uint32_t x = block % blocks.x * BLOCK_PX + i % BLOCK_PX;
      const std::uint32_t y = block / blocks.x * BLOCK_PX + i / BLOCK_PX;
      const glm::dvec3 of_pixel(glm::ivec3(a.pixels[y * a.width + x]) - glm::ivec3(b.pixels[y * a.width + x]));
      sum += of_pixel;
      levels += (std::abs(of_pixel.r) + std::abs(of_pixel.g) + std::abs(of_pixel.b)) / 3.0;
    }
    sum /= BLOCK_PX * BLOCK_PX;
    found.mean += levels / (BLOCK_PX * BLOCK_PX * count);
    found.blocks += glm::dot(sum, sum) / 3.0 / count;
  }
  found.blocks = std::sqrt(found.blocks);
  return found;
}

TEST(States, LookAsOnTheirPage) {
  std::optional<LdrImage> last;
  run_headless(view_context(), small_viewer(), [&](Player& player) {
    for (const std::string& name : state_names()) {
      const fs::path file = fs::path(LAMPLIGHT_SOURCE_DIR) / "docs/states" / (name + ".json");
      player.resize(load_state(file).panels ? WITH_PANELS : WITHOUT);
      player.input.dropped.push_back(file.string());
      play(player,
           parse_script("{\"wait\": 1}\n{\"wait\": \"idle\"}\n{\"wait\": 3}\n{\"expect\": {\"/error\": \"\"}}", name));
      const LdrImage stored = read_png(fs::path(LAMPLIGHT_SOURCE_DIR) / "docs/images" / ("viewer_" + name + ".png"));
      const LdrImage drawn = player.screen();
      ASSERT_EQ(stored.width, drawn.width);
      ASSERT_EQ(stored.height, drawn.height);
      const Difference found = difference(drawn, stored);
      EXPECT_LE(found.mean, MEAN_LEVELS) << name;
      EXPECT_LE(found.blocks, BLOCK_LEVELS) << name;
      // What is allowed does not let another state pass.
      if (last && last->width == drawn.width) {
        EXPECT_GT(difference(drawn, *last).mean, 2.0 * MEAN_LEVELS) << name;
      }
      last = stored;
    }
  });
}

}  // namespace
}  // namespace lamp::app
