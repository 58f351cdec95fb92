// PNG through stb: encoded to memory, then written whole; read back for golden pictures.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cassert>
#include <cstring>
#include <memory>
#include <string>

#include "error.h"
#include "files/read_file.h"
#include "image/image.h"
#include "image/write_file.h"

// Other libraries of the program carry stb too: these copies stay inside this file.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace lamp::app {
namespace {

constexpr int RGBA = 4;

void append(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

void write_png(const std::filesystem::path& file, const LdrImage& image) {
  assert(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height && "fill every pixel");
  const auto width = static_cast<int>(image.width);
  const auto height = static_cast<int>(image.height);
  std::string bytes;
  if (image.pixels.empty() ||
      stbi_write_png_to_func(append, &bytes, width, height, RGBA, image.pixels.data(), RGBA * width) == 0) {
    throw Error(fmt::format("{}: cannot be encoded as PNG: the picture is {} x {}, expected at least 1 x 1",
                            file.string(), image.width, image.height));
  }
  write_file(file, bytes);
}

LdrImage read_png(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file, {.expected = "a PNG file"});
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> data(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width,
                            &height, &channels, RGBA),
      stbi_image_free);
  if (data == nullptr) {
    throw Error(fmt::format("{}: {}; expected an 8-bit PNG", file.string(), stbi_failure_reason()));
  }
  LdrImage image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::memcpy(image.pixels.data(), data.get(), image.pixels.size() * sizeof(glm::u8vec4));
  return image;
}

}  // namespace lamp::app
