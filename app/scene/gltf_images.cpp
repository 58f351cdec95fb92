// Decodes the images that materials use, in parallel.
// Based on: stb_image (PNG and JPEG, the two formats of glTF 2.0).
// Promise: an image that cannot be read or decoded is an Error that names it, never a blank.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_images.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <exception>
#include <limits>
#include <memory>

#include "scene/gltf_error.h"

// Private to this file, and without the formats that glTF does not have.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>

namespace lamp::app {
namespace {

constexpr int SIDE_MAX = STBI_MAX_DIMENSIONS;
constexpr std::uint64_t PIXELS_MAX = std::uint64_t{1} << 30;  // of all images together: 4 GiB

struct FreePixels {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

/// The header's size, before anything is allocated for it.
glm::ivec2 checked_size(std::span<const std::byte> bytes, const std::string& file, const std::string& element) {
  int width = 0;
  int height = 0;
  int channels = 0;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const bool small = bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (!small || stbi_info_from_memory(data, static_cast<int>(bytes.size()), &width, &height, &channels) == 0) {
    gltf_fail(file, element, "cannot be decoded, expected a PNG or JPEG");
  }
  if (width < 1 || height < 1 || width > SIDE_MAX || height > SIDE_MAX) {
    gltf_fail(file, element, fmt::format("{} x {} pixels, expected 1 .. {} a side", width, height, SIDE_MAX));
  }
  return {width, height};
}

Image decode(std::span<const std::byte> bytes, const std::string& file, const std::string& element,
             std::atomic<std::uint64_t>& total_pixels) {
  const glm::ivec2 size = checked_size(bytes, file, element);
  const auto pixel_count = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
  if (total_pixels.fetch_add(pixel_count) + pixel_count > PIXELS_MAX) {
    gltf_fail(file, element, fmt::format("more than {} pixels in all images, expected fewer", PIXELS_MAX));
  }
  int width = 0;
  int height = 0;
  int channels = 0;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const std::unique_ptr<stbi_uc, FreePixels> pixels(
      stbi_load_from_memory(data, static_cast<int>(bytes.size()), &width, &height, &channels, STBI_rgb_alpha));
  if (!pixels) {
    gltf_fail(file, element,
              fmt::format("cannot be decoded ({}), expected a whole PNG or JPEG", stbi_failure_reason()));
  }
  Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.rgba.assign(pixels.get(), pixels.get() + pixel_count * 4);
  return image;
}

Image read_image(const GltfDocument& document, GltfImageUse use, std::atomic<std::uint64_t>& total_pixels) {
  const GltfImage& from = document.images[static_cast<std::size_t>(use.image)];
  const std::string& file = document.origin.file;
  std::string element = fmt::format("image {}", use.image);
  if (from.name != element && from.name != from.uri) element += fmt::format(" '{}'", from.name);
  Image image = from.uri.empty() ? decode(document.view_bytes(from.buffer_view), file, element, total_pixels)
                                 : decode(read_uri(from.uri, document.origin, element), file, element, total_pixels);
  image.name = from.name;
  image.srgb = use.srgb;
  return image;
}

}  // namespace

std::vector<Image> read_images(const GltfDocument& document, std::span<const GltfImageUse> uses) {
  std::vector<Image> images(uses.size());
  std::vector<std::exception_ptr> failures(uses.size());
  std::atomic<std::uint64_t> total_pixels = 0;
  tbb::parallel_for(std::size_t{0}, uses.size(), [&](std::size_t i) {
    try {
      images[i] = read_image(document, uses[i], total_pixels);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  // The first in order, so that the message does not depend on which thread was faster.
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return images;
}

}  // namespace lamp::app
