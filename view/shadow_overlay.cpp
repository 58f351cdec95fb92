// Texels to colours.
// SPDX-License-Identifier: Apache-2.0
#include "view/shadow_overlay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "commands/pictures.h"
#include "render/shaders/shadow_heat_data.h"
#include "render/shadow_squares.h"
#include "view/overlay_colors.h"

namespace lamp::app {
namespace {

using shared::LEAST_SQUARE;
using shared::ShadowMap;

constexpr std::uint32_t NOBODY = ~0U;
constexpr std::uint32_t BEHIND = 0xE0000000U;  // black that lets a little of the picture through
constexpr std::uint32_t FREE = 0xFF202020U;
constexpr std::uint32_t EDGE = 0xFF808080U;

std::uint32_t color_of(Palette palette, const ShadowMap& map, float texel) {
  if (!(texel > 0.0F)) return 0xFF000000U;
  // Of a light without a range, a hundred times the nearest distance stands for it.
  const double far = map.range_m < shared::INFINITE_RADIUS ? map.range_m : 100.0 * map.near_m;
  const double share = std::clamp(map.near_m / static_cast<double>(texel) / far, 0.0, 1.0);
  const glm::u8vec3 color = palette_color(palette, 1.0 - share);
  return color.r | static_cast<std::uint32_t>(color.g) << 8U | static_cast<std::uint32_t>(color.b) << 16U | 0xFF000000U;
}

/// Whose each block of LEAST_SQUARE texels is.
std::vector<std::uint32_t> owners_of(const AtlasSeen& seen) {
  const std::uint32_t blocks = seen.side / LEAST_SQUARE;
  std::vector<std::uint32_t> owners(std::size_t{blocks} * blocks, NOBODY);
  for (std::uint32_t light = 0; light < seen.maps.size(); ++light)
    for (std::uint32_t square = 0; square < squares_of(seen.maps[light]); ++square) {
      const glm::uvec2 first = glm::uvec2(square_at(seen.maps[light], square).corner) / LEAST_SQUARE;
      const std::uint32_t count = seen.maps[light].side / LEAST_SQUARE;
      for (std::uint32_t y = first.y; y < std::min(first.y + count, blocks); ++y)
        for (std::uint32_t x = first.x; x < std::min(first.x + count, blocks); ++x)
          owners[x + std::size_t{blocks} * y] = light;
    }
  return owners;
}

/// A grid of squares in the middle of the picture.
struct Board {
  glm::uvec2 picture;
  glm::uvec2 squares{1};

  /// Of a square, pixels.
  [[nodiscard]] std::uint32_t side() const {
    return std::max(1U, std::min(picture.x / squares.x, picture.y / squares.y));
  }
  /// The square of a pixel, and where in it the pixel lies, 0 .. 1; nothing beside the board.
  struct Spot {
    std::uint32_t square = 0;
    glm::vec2 place{0.0F};
  };
  [[nodiscard]] std::optional<Spot> at(glm::uvec2 pixel) const {
    const glm::ivec2 first = (glm::ivec2(picture) - glm::ivec2(squares * side())) / 2;
    const glm::ivec2 in = glm::ivec2(pixel) - first;
    if (in.x < 0 || in.y < 0) return std::nullopt;
    const glm::uvec2 square = glm::uvec2(in) / side();
    if (square.x >= squares.x || square.y >= squares.y) return std::nullopt;
    const glm::vec2 place = (glm::vec2(glm::uvec2(in) % side()) + 0.5F) / static_cast<float>(side());
    return Spot{.square = square.x + squares.x * square.y, .place = place};
  }
};

template <class Color>
Overlaid draw(const Board& board, const Color& color) {
  Overlaid made;
  made.pixels.reserve(std::size_t{board.picture.x} * board.picture.y);
  for (std::uint32_t y = 0; y < board.picture.y; ++y)
    for (std::uint32_t x = 0; x < board.picture.x; ++x) {
      const auto spot = board.at({x, y});
      made.pixels.push_back(spot ? color(*spot) : BEHIND);
    }
  return made;
}

std::size_t number_of(const AtlasSeen& seen, glm::uvec2 texel) {
  const glm::uvec2 inside = glm::min(texel, glm::uvec2(seen.side - 1));
  return inside.x + std::size_t{seen.side} * inside.y;
}

Overlaid draw_light(Palette palette, const AtlasSeen& seen, const ShadowMap& map) {
  const Board board{.picture = seen.picture, .squares = squares_of(map) == 1 ? glm::uvec2(1) : glm::uvec2(3, 2)};
  Overlaid made = draw(board, [&](const Board::Spot& spot) {
    const glm::uvec2 texel =
        glm::uvec2(square_at(map, spot.square).corner) + glm::uvec2(spot.place * static_cast<float>(map.side));
    return color_of(palette, map, seen.texels[number_of(seen, texel)]);
  });
  made.legend.max = map.side;
  return made;
}

Overlaid draw_all(Palette palette, const AtlasSeen& seen) {
  const std::vector<std::uint32_t> owners = owners_of(seen);
  const std::uint32_t blocks = seen.side / LEAST_SQUARE;
  const auto owner_at = [&](glm::uvec2 texel) {
    const glm::uvec2 block = glm::min(texel / LEAST_SQUARE, glm::uvec2(blocks - 1));
    return owners[block.x + std::size_t{blocks} * block.y];
  };
  const Board board{.picture = seen.picture};
  const std::uint32_t step = std::max(1U, seen.side / board.side());
  Overlaid made = draw(board, [&](const Board::Spot& spot) {
    const glm::uvec2 texel(spot.place * static_cast<float>(seen.side));
    const std::uint32_t owner = owner_at(texel);
    if (owner == NOBODY) return FREE;
    const glm::uvec2 before = texel - glm::min(texel, glm::uvec2(step));
    if (owner_at({before.x, texel.y}) != owner || owner_at({texel.x, before.y}) != owner) return EDGE;
    return color_of(palette, seen.maps[owner], seen.texels[number_of(seen, texel)]);
  });
  made.legend.max = seen.side;
  return made;
}

}  // namespace

Overlaid make_shadow_overlay(Palette palette, const AtlasSeen& seen) {
  const bool one = seen.record && *seen.record < seen.maps.size() && squares_of(seen.maps[*seen.record]) != 0;
  Overlaid made = one ? draw_light(palette, seen, seen.maps[*seen.record]) : draw_all(palette, seen);
  made.legend.overlay = Overlay::shadow_atlas;
  made.legend.cells = static_cast<std::uint64_t>(
      std::ranges::count_if(seen.maps, [](const ShadowMap& map) { return squares_of(map) != 0; }));
  return made;
}

std::vector<std::uint32_t> picture_of_square(Palette palette, const ShadowMap& map, std::span<const float> texels,
                                             std::uint32_t side) {
  std::vector<std::uint32_t> picture;
  picture.reserve(std::size_t{side} * side);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::size_t row = (2 * y + 1) * map.side / (2 * side);
      picture.push_back(color_of(palette, map, texels[(2 * x + 1) * map.side / (2 * side) + row * map.side]));
    }
  return picture;
}

Overlaid make_shadow_heat(Overlay overlay, Palette palette, std::span<const std::uint32_t> worst, double scale_least) {
  Overlaid made = heat_over(palette, worst, scale_least, [](std::uint32_t word) -> std::optional<glm::u8vec3> {
    if (word == gpu::WITHOUT_SHADOW) return WITHOUT_COLOR;
    if (word == gpu::WAITS_FOR_REDRAWING) return WAITS_COLOR;
    return std::nullopt;
  });
  made.legend.overlay = overlay;
  return made;
}

LeakColors leak_colors(Palette palette) {
  switch (palette) {
    case Palette::rainbow:
      break;
    case Palette::blue_yellow:
      return {.leaked = palette_color(palette, 1.0),
              .lost = {0, 80, 220}};  // brighter than the scale's, to show beside grey
    case Palette::grey:
      return {.leaked = glm::u8vec3(255), .lost = glm::u8vec3(0)};
  }
  return {};
}

Overlaid make_shadow_leaks(Palette palette, std::span<const gpu::ShadowLeak> pixels) {
  const LeakColors colors = leak_colors(palette);
  const std::vector<std::uint8_t> greys = grey_of(pixels);
  Overlaid made{.pixels = {}, .legend = {.overlay = Overlay::shadow_leaks, .leaks = sum_of(pixels)}};
  made.pixels.reserve(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    made.pixels.push_back(rgba(leak_color(pixels[i], greys[i], colors), 1.0F));
  return made;
}

}  // namespace lamp::app
