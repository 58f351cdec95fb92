// A tile's depth bounds on the device against a reduction on the host, bit for bit.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "gpu/dispatch.h"

namespace lamp::app {
namespace {

struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> depth;
  float sky = 0.0F;  ///< depth of the sky: 0, or 1 where depth is not reversed
};

/// Device depths of many magnitudes, without denormal numbers, which a device may flush; `sky` is the share of sky.
Picture random_picture(std::uint32_t width, std::uint32_t height, double sky, std::uint32_t seed,
                       float sky_depth = 0.0F) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Picture picture{width, height, std::vector<float>(std::size_t{width} * height), sky_depth};
  for (float& depth : picture.depth) {
    const double exponent = unit(random) < 0.05 ? -30.0 * unit(random) : -4.0 * unit(random);
    depth = unit(random) < sky ? sky_depth : static_cast<float>(std::pow(10.0, exponent));
  }
  return picture;
}

/// Nearest and farthest of a tile; (sky, the other end) when it is all sky.
glm::vec2 reduce(const Picture& picture, glm::uvec2 tile, std::uint32_t tile_px) {
  const bool reversed = picture.sky == 0.0F;
  glm::vec2 found(picture.sky, 1.0F - picture.sky);
  for (std::uint32_t y = tile.y * tile_px; y < std::min((tile.y + 1) * tile_px, picture.height); ++y) {
    for (std::uint32_t x = tile.x * tile_px; x < std::min((tile.x + 1) * tile_px, picture.width); ++x) {
      const float depth = picture.depth[std::size_t{y} * picture.width + x];
      if (depth == picture.sky) continue;
      found = reversed ? glm::vec2(std::max(found.x, depth), std::min(found.y, depth))
                       : glm::vec2(std::min(found.x, depth), std::max(found.y, depth));
    }
  }
  return found;
}

void expect_bounds(const Picture& picture, std::uint32_t tile_px, std::uint32_t threads) {
  shared::Frame frame{};
  frame.size_px = {picture.width, picture.height};
  frame.sky_bits = std::bit_cast<std::uint32_t>(picture.sky);
  const glm::uvec2 tiles = (glm::uvec2(frame.size_px) + tile_px - 1U) / tile_px;
  const vulkan::Buffer frames = host_buffer_of("frame", std::vector{frame});
  const vulkan::Buffer bounds = host_buffer("bounds", std::uint64_t{tiles.x} * tiles.y * sizeof(glm::vec2));
  const GpuImage image = depth_image(picture.width, picture.height, picture.depth);
  dispatch({.shader = "tile_depth",
            .constants = {threads, tile_px},
            .resources = {vulkan::Resource::storage(frames.handle()), image.sampled(),
                          vulkan::Resource::storage(bounds.handle())},
            .groups = {tiles, 1}});
  const std::vector<glm::uvec2> found = contents<glm::uvec2>(bounds);
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    const glm::vec2 expected = reduce(picture, {i % tiles.x, i / tiles.x}, tile_px);
    ASSERT_EQ(found[i].x, std::bit_cast<std::uint32_t>(expected.x)) << "nearest of tile " << i;
    // All sky: the contract is that nearest is sky; farthest then means nothing.
    if (expected.x != picture.sky) {
      ASSERT_EQ(found[i].y, std::bit_cast<std::uint32_t>(expected.y)) << "farthest of tile " << i;
    }
  }
}

class TileDepth : public GpuTest {};

TEST_F(TileDepth, EqualsTheReductionOnTheHostForAllSizes) {
  std::uint32_t seed = 1;
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(17, 31), glm::uvec2(64, 64), glm::uvec2(257, 129)}) {
    for (const std::uint32_t tile_px : {8U, 16U, 32U}) {
      for (const std::uint32_t threads : {32U, 256U}) {
        SCOPED_TRACE(fmt::format("{}x{}, tile {}, {} threads", size.x, size.y, tile_px, threads));
        expect_bounds(random_picture(size.x, size.y, /*sky=*/0.3, seed++), tile_px, threads);
      }
    }
  }
}

TEST_F(TileDepth, SkyIsLeftOutHoweverMuchThereIs) {
  for (const double sky : {0.0, 0.97, 0.999, 1.0}) {
    SCOPED_TRACE(sky);
    expect_bounds(random_picture(131, 67, sky, 7), 16, 256);
  }
}

TEST_F(TileDepth, StandardDepthRunsTheOtherWay) {
  for (const double sky : {0.0, 0.97, 1.0}) {
    SCOPED_TRACE(sky);
    expect_bounds(random_picture(131, 67, sky, 8, /*sky_depth=*/1.0F), 16, 256);
  }
}

TEST_F(TileDepth, OnePixelDecides) {
  Picture picture{48, 48, std::vector<float>(48 * 48, 0.5F)};
  picture.depth[20 * 48 + 20] = std::nextafter(0.5F, 1.0F);  // nearest of the middle tile, by one bit
  picture.depth[31 * 48 + 31] = std::nextafter(0.5F, 0.0F);  // farthest, in its last pixel
  picture.depth[0] = 1.0F;                                   // on the near plane
  expect_bounds(picture, 16, 256);
}

}  // namespace
}  // namespace lamp::app
