// Makes levels of images.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

namespace lamp::app {
namespace {

struct Level {
  std::uint32_t width = 1, height = 1;
  std::vector<glm::vec4> texels;  ///< linear
};

float linear_of_srgb(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

float srgb_of_linear(float value) {
  return value <= 0.0031308F ? value * 12.92F : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
}

std::array<float, 256> decoded(bool srgb) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float value = static_cast<float>(i) / 255.0F;
    table[i] = srgb ? linear_of_srgb(value) : value;
  }
  return table;
}

Level finest(const Image& image) {
  const std::array<float, 256> color = decoded(image.srgb);
  const std::array<float, 256> alpha = decoded(false);
  Level level{.width = image.width, .height = image.height, .texels = {}};
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
    level.texels.emplace_back(color[image.rgba[i]], color[image.rgba[i + 1]], color[image.rgba[i + 2]],
                              alpha[image.rgba[i + 3]]);
  return level;
}

Level halved(const Level& of) {
  Level level{.width = std::max(of.width / 2, 1U), .height = std::max(of.height / 2, 1U), .texels = {}};
  const auto at = [&](std::uint32_t x, std::uint32_t y) {
    return of.texels[std::size_t{std::min(y, of.height - 1)} * of.width + std::min(x, of.width - 1)];
  };
  for (std::uint32_t y = 0; y < level.height; ++y)
    for (std::uint32_t x = 0; x < level.width; ++x)
      level.texels.push_back(
          0.25F * (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1)));
  return level;
}

std::uint32_t packed(const glm::vec4& texel, bool srgb) {
  std::uint32_t word = 0;
  for (int i = 0; i < 4; ++i) {
    const float value = srgb && i < 3 ? srgb_of_linear(texel[i]) : texel[i];
    word |= static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F)) << (8 * i);
  }
  return word;
}

/// Of a level and all coarser ones.
std::uint64_t texel_count(const Image& image, std::uint32_t first) {
  std::uint64_t count = 0;
  for (std::uint32_t level = first;; ++level) {
    const std::uint32_t width = side_at(image.width, level);
    const std::uint32_t height = side_at(image.height, level);
    count += std::uint64_t{width} * height;
    if (width == 1 && height == 1) return count;
  }
}

}  // namespace

std::uint32_t side_at(std::uint32_t side, std::uint32_t level) { return std::max(side >> level, 1U); }

std::vector<bool> cuts_holes(const Scene& scene) {
  std::vector<bool> cuts(scene.images.size(), false);
  for (const Material& material : scene.materials)
    if (material.alpha_mode == AlphaMode::mask && material.base_color_texture.image >= 0)
      cuts[static_cast<std::size_t>(material.base_color_texture.image)] = true;
  return cuts;
}

std::vector<std::uint32_t> levels_that_fit(const Scene& scene, std::uint64_t most_texels) {
  const std::vector<bool> cuts = cuts_holes(scene);
  std::vector<std::uint32_t> firsts(scene.images.size(), 0);
  std::uint64_t sum = 0;
  for (const Image& image : scene.images) sum += texel_count(image, 0);
  for (const bool holes : {false, true}) {
    const auto to_lose = [&](std::size_t i) {
      const std::uint64_t texels = texel_count(scene.images[i], firsts[i]);
      return cuts[i] == holes && texels > 1 ? texels : 0;
    };
    while (sum > most_texels) {
      std::size_t largest = 0;
      for (std::size_t i = 1; i < firsts.size(); ++i)
        if (to_lose(i) > to_lose(largest)) largest = i;
      if (to_lose(largest) == 0) break;
      sum -= texel_count(scene.images[largest], firsts[largest]);
      sum += texel_count(scene.images[largest], ++firsts[largest]);
    }
  }
  return firsts;
}

std::vector<std::uint32_t> texels_of(const Image& image, std::uint32_t first, std::uint32_t& levels) {
  std::vector<std::uint32_t> words;
  Level level = finest(image);
  levels = 0;
  for (std::uint32_t number = 0;; ++number) {
    if (number >= first) {
      ++levels;
      for (const glm::vec4& texel : level.texels) words.push_back(packed(texel, image.srgb));
    }
    if (level.width == 1 && level.height == 1) break;
    level = halved(level);
  }
  return words;
}

Image image_at(const Image& image, std::uint32_t level) {
  std::uint32_t levels = 0;
  const std::vector<std::uint32_t> texels = texels_of(image, level, levels);
  Image made = image;
  made.width = side_at(image.width, level);
  made.height = side_at(image.height, level);
  made.rgba.resize(std::size_t{made.width} * made.height * 4);
  std::memcpy(made.rgba.data(), texels.data(), made.rgba.size());
  return made;
}

}  // namespace lamp::app
