// Pictures on the CPU: linear HDR in, files out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamp::app {

/// Linear Rec. 709 radiance, row by row from the top. Alpha: how much of the pixel surfaces cover, 0 (sky) to 1; glass
/// does not count.
struct HdrImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::vec4> pixels;
};

/// sRGB-encoded eight bit, row by row from the top.
struct LdrImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::u8vec4> pixels;
};

/// A colour's grey, 0 .. 255. ITU-R BT.709.
[[nodiscard]] inline float luma(glm::u8vec4 color) {
  return glm::dot(glm::vec3(color), glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// Pictures of one height, from left to right.
[[nodiscard]] HdrImage side_by_side(std::span<const HdrImage> images);

/// Of linear Rec. 709 radiance or reflectance.
[[nodiscard]] double luminance(const glm::vec3& linear);

/// Exposure that puts the log-average luminance at middle grey (Reinhard et al. 2002), from surfaces alone, as far as
/// they are not black: a dark sky would else overexpose what stands before it. 1 where no lit surface is seen.
[[nodiscard]] float automatic_exposure(const HdrImage& image);

/// Exposure, a filmic tone curve (cited in the .cpp), sRGB encoding. Alpha becomes 255. A pixel that is not
/// a number becomes magenta, an infinite one white.
[[nodiscard]] LdrImage tone_map(const HdrImage& image, float exposure);

/// Writes next to `file` under a temporary name, then renames: nothing half-written stays behind.
/// Throws Error (file, what is wrong) when the folder is missing or not writable.
void write_png(const std::filesystem::path& file, const LdrImage& image);
/// EXR, 32-bit float R, G, B.
void write_exr(const std::filesystem::path& file, const HdrImage& image);
/// Text (JSON, CSV) the same way.
void write_text(const std::filesystem::path& file, std::string_view text);

/// Reads an 8-bit PNG (golden pictures). Throws Error.
[[nodiscard]] LdrImage read_png(const std::filesystem::path& file);

/// Pictures side by side, tops aligned, with a few pixels between; what a lower one leaves free is dark.
[[nodiscard]] LdrImage side_by_side(std::span<const LdrImage> images);

/// Pictures below each other, left edges aligned; what a narrower one leaves free is dark.
[[nodiscard]] LdrImage stacked(std::span<const LdrImage> images);

/// Draws `text` (ASCII, one line or more; other letters show as '?') with its top left at (x, y); `scale` 1 is about 7
/// pixels high.
void draw_text(LdrImage& image, std::int32_t x, std::int32_t y, std::string_view text, glm::u8vec3 color,
               std::uint32_t scale = 1);
/// The size in pixels that draw_text takes.
[[nodiscard]] glm::uvec2 text_size(std::string_view text, std::uint32_t scale = 1);

/// Fills a rectangle, clipped to the picture; its alpha stays.
void fill_rect(LdrImage& image, glm::ivec2 min, glm::ivec2 size, glm::u8vec3 color);

}  // namespace lamp::app
