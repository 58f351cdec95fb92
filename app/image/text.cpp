// Text in pictures: a fixed-width bitmap font, enlarged by whole factors so that it stays sharp.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "image/font_5x7.h"
#include "image/image.h"

namespace lamp::app {
namespace {

/// Letters that the font does not have (control characters, beyond ASCII) are shown as a question mark.
std::string_view glyph(char letter) {
  const bool known = letter >= ' ' && letter <= '~';
  return GLYPHS[static_cast<std::size_t>((known ? letter : '?') - ' ')];
}

void draw_glyph(LdrImage& image, glm::ivec2 top_left, char letter, glm::u8vec3 color, std::int32_t scale) {
  constexpr std::size_t STRIDE = GLYPH_WIDTH + 1;  // a row and the blank after it
  const std::string_view art = glyph(letter);
  for (std::size_t i = 0; i < art.size(); ++i) {
    if (art[i] == '#') {
      const glm::ivec2 dot(i % STRIDE, i / STRIDE);
      fill_rect(image, top_left + scale * dot, glm::ivec2(scale), color);
    }
  }
}

}  // namespace

void draw_text(LdrImage& image, std::int32_t x, std::int32_t y, std::string_view text, glm::u8vec3 color,
               std::uint32_t scale) {
  const auto factor = static_cast<std::int32_t>(scale);
  glm::ivec2 pen(x, y);
  for (const char letter : text) {
    if (letter == '\n') {
      pen = {x, pen.y + factor * static_cast<std::int32_t>(LINE_ADVANCE)};
      continue;
    }
    draw_glyph(image, pen, letter, color, factor);
    pen.x += factor * static_cast<std::int32_t>(GLYPH_ADVANCE);
  }
}

glm::uvec2 text_size(std::string_view text, std::uint32_t scale) {
  if (text.empty()) return {0, 0};
  std::uint32_t lines = 1;
  std::uint32_t columns = 0;
  std::uint32_t longest = 0;
  for (const char letter : text) {
    columns = letter == '\n' ? 0 : columns + 1;
    longest = std::max(longest, columns);
    lines += letter == '\n' ? 1 : 0;
  }
  const std::uint32_t width = longest == 0 ? 0 : longest * GLYPH_ADVANCE - (GLYPH_ADVANCE - GLYPH_WIDTH);
  return scale * glm::uvec2(width, (lines - 1) * LINE_ADVANCE + GLYPH_HEIGHT);
}

}  // namespace lamp::app
