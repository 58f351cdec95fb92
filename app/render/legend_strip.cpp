// Draws letters and rectangles at the scale of a strip.
// SPDX-License-Identifier: Apache-2.0
#include "render/legend_strip.h"

namespace lamp::app {
namespace {

constexpr glm::u8vec4 PANEL{18, 18, 22, 255};

}  // namespace

std::int32_t text_width(std::string_view text, std::int32_t scale) {
  return static_cast<std::int32_t>(text_size(text, static_cast<std::uint32_t>(scale)).x);
}

void LegendStrip::text(std::int32_t x, std::int32_t font_y, std::string_view what, glm::u8vec3 color) const {
  draw_text(image, x, y(font_y), what, color, static_cast<std::uint32_t>(scale));
}

void LegendStrip::rect(std::int32_t x, std::int32_t font_y, glm::ivec2 size, glm::u8vec3 color) const {
  fill_rect(image, {x, y(font_y)}, size, color);
}

std::string fitting(std::string text, std::int32_t room, std::int32_t scale) {
  constexpr std::string_view LEFT_OUT = "..";
  if (text_width(text, scale) <= room) return text;
  while (!text.empty() && text_width(text + std::string(LEFT_OUT), scale) > room) text.erase(text.size() / 2, 1);
  return text.insert((text.size() + 1) / 2, LEFT_OUT);
}

std::int32_t legend_scale(std::uint32_t width) { return static_cast<std::int32_t>(1 + width / 640); }

LegendStrip append_strip(LdrImage& image, std::int32_t font_pixels, std::int32_t scale) {
  const LegendStrip strip{image, static_cast<std::int32_t>(image.height), scale};
  image.height += static_cast<std::uint32_t>(font_pixels * strip.scale);
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height, PANEL);
  return strip;
}

}  // namespace lamp::app
