// Rectangles, and pictures side by side.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "image/image.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GAP_PX = 4;
constexpr glm::u8vec4 GAP_COLOR{24, 24, 28, 255};

}  // namespace

void fill_rect(LdrImage& image, glm::ivec2 min, glm::ivec2 size, glm::u8vec3 color) {
  using Wide = glm::i64vec2;  // min + size may leave 32 bits
  const Wide end = glm::min(Wide(min) + Wide(size), Wide(image.width, image.height));
  const Wide begin = glm::max(Wide(min), Wide(0));
  for (std::int64_t y = begin.y; y < end.y; ++y) {
    for (std::int64_t x = begin.x; x < end.x; ++x) {
      glm::u8vec4& pixel = image.pixels[static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)];
      pixel = {color, pixel.a};
    }
  }
}

LdrImage side_by_side(std::span<const LdrImage> images) {
  LdrImage all;
  for (const LdrImage& image : images) {
    all.width += image.width + (all.width == 0 ? 0 : GAP_PX);
    all.height = std::max(all.height, image.height);
  }
  all.pixels.assign(static_cast<std::size_t>(all.width) * all.height, GAP_COLOR);
  std::size_t left = 0;
  for (const LdrImage& image : images) {
    for (std::size_t y = 0; y < image.height; ++y) {
      const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y * image.width);
      std::copy_n(row, image.width, all.pixels.begin() + static_cast<std::ptrdiff_t>(y * all.width + left));
    }
    left += image.width + GAP_PX;
  }
  return all;
}

LdrImage stacked(std::span<const LdrImage> images) {
  LdrImage all;
  for (const LdrImage& image : images) all.width = std::max(all.width, image.width);
  for (const LdrImage& image : images) {
    for (std::size_t y = 0; y < image.height; ++y) {
      const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y * image.width);
      all.pixels.insert(all.pixels.end(), row, row + image.width);
      all.pixels.resize(std::size_t{all.width} * ++all.height, GAP_COLOR);
    }
  }
  return all;
}

HdrImage side_by_side(std::span<const HdrImage> images) {
  HdrImage all{.height = images.front().height};
  for (const HdrImage& image : images) all.width += image.width;
  all.pixels.reserve(std::size_t{all.width} * all.height);
  for (std::uint32_t y = 0; y < all.height; ++y)
    for (const HdrImage& image : images) {
      const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * image.width);
      all.pixels.insert(all.pixels.end(), row, row + image.width);
    }
  return all;
}

}  // namespace lamp::app
