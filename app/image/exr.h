// OpenEXR files with channels of any name: depth, normals, factors of materials.
// Based on: Academy Software Foundation, OpenEXR 3 (https://openexr.com).
// Promise: 32-bit values are stored and read bit for bit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace lamp::app {

/// Pixels in memory: row by row from the top, channel c of a pixel at its first value + c.
struct ExrPixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::string_view> channels;  ///< names
  const float* first = nullptr;
  std::size_t floats_per_pixel = 1;  ///< from one pixel to the next, >= channels
};

/// Writes 32-bit channels, whole or not at all. Throws Error (file, what is wrong).
void write_exr(const std::filesystem::path& file, const ExrPixels& pixels);

struct ExrWanted {
  std::uint32_t width = 0;  ///< that the file must have
  std::uint32_t height = 0;
  std::span<const std::string_view> channels;  ///< that the file must have; others are not read
  bool full_precision = false;                 ///< half floats will not do
};

/// Reads channels, interleaved in the order of their names, row by row from the top. Throws Error: the file, the
/// channel or the size, what was expected; truncated files included.
[[nodiscard]] std::vector<float> read_exr(const std::filesystem::path& file, const ExrWanted& wanted);

}  // namespace lamp::app
