// The strip below a picture that a legend is drawn into. Measures are in pixels of the font, which grow with the
// picture. Promise: it is appended below the picture and hides no pixel of it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "image/image.h"

namespace lamp::app {

/// Pictures narrower than this get no legend.
inline constexpr std::uint32_t LEGEND_MIN_WIDTH = 200;

/// Where it is and how large its letters are, in pixels of the picture.
struct LegendStrip {
  static constexpr glm::u8vec3 BRIGHT{240, 240, 240};  ///< of letters
  static constexpr glm::u8vec3 QUIET{176, 176, 184};
  static constexpr std::int32_t PAD = 4;

  LdrImage& image;
  std::int32_t top;
  std::int32_t scale;

  [[nodiscard]] std::int32_t left() const { return PAD * scale; }
  [[nodiscard]] std::int32_t right() const { return static_cast<std::int32_t>(image.width) - PAD * scale; }
  [[nodiscard]] std::int32_t y(std::int32_t font_pixels) const { return top + font_pixels * scale; }
  void text(std::int32_t x, std::int32_t font_y, std::string_view what, glm::u8vec3 color) const;
  void rect(std::int32_t x, std::int32_t font_y, glm::ivec2 size, glm::u8vec3 color) const;
};

/// Pixels of a picture for one of the font.
[[nodiscard]] std::int32_t legend_scale(std::uint32_t width);

/// Makes the picture higher by so many pixels of the font.
[[nodiscard]] LegendStrip append_strip(LdrImage& image, std::int32_t font_pixels, std::int32_t scale);

/// Pixels of a line.
[[nodiscard]] std::int32_t text_width(std::string_view text, std::int32_t scale);

/// As much of it as there is room for, with ".." in the middle where some is left out.
[[nodiscard]] std::string fitting(std::string text, std::int32_t room, std::int32_t scale);

}  // namespace lamp::app
