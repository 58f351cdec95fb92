// Decodes the images that materials use, in parallel.
// Based on: stb_image (PNG and JPEG, the two formats of glTF 2.0).
// Promise: an image that cannot be read or decoded is an Error that names it, never a blank.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_images.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "files/read_file.h"
#include "scene/gltf_error.h"

// Private to this file, and without the formats that glTF does not have.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb_image.h>

namespace lamp::app {
namespace {

constexpr std::uint32_t SIDE_MAX = 16384;
constexpr std::uint64_t PIXELS_MAX = std::uint64_t{1} << 30;  // of all images together: 4 GiB
constexpr std::uint64_t LARGE = std::uint64_t{1} << 24;       // pixels; such an image is decoded alone
constexpr std::size_t BYTES_MAX = std::size_t{1} << 31;       // of all files; stb counts bytes in an int

struct FreePixels {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

/// An image of the file before it is decoded. What holds its bytes is the document or `owned`.
struct Encoded {
  const GltfImage* image = nullptr;
  std::string element;
  std::vector<std::byte> owned;
  std::span<const std::byte> bytes;
  glm::uvec2 size{0};

  [[nodiscard]] std::uint64_t pixels() const { return std::uint64_t{size.x} * size.y; }
};

const stbi_uc* data_of(std::span<const std::byte> bytes) { return reinterpret_cast<const stbi_uc*>(bytes.data()); }

/// What the header of a PNG says, also where stb would say no more than that it does not like the file.
std::optional<glm::uvec2> png_size(std::span<const std::byte> bytes) {
  constexpr std::string_view BEGIN("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  if (!text_of(bytes).starts_with(BEGIN) || bytes.size() < BEGIN.size() + 8) return std::nullopt;
  glm::uvec2 size(0);
  for (std::size_t i = 0; i < 8; ++i) {
    std::uint32_t& side = i < 4 ? size.x : size.y;
    side = side << 8U | std::to_integer<std::uint32_t>(bytes[BEGIN.size() + i]);
  }
  return size;
}

/// The header's size, before anything is allocated for it.
glm::uvec2 checked_size(const Encoded& encoded, const std::string& file) {
  std::optional<glm::uvec2> size = png_size(encoded.bytes);
  glm::ivec2 sides(0);
  int channels = 0;
  if (!size && stbi_info_from_memory(data_of(encoded.bytes), static_cast<int>(encoded.bytes.size()), &sides.x, &sides.y,
                                     &channels) != 0)
    size = glm::uvec2(sides);
  if (!size) gltf_fail(file, encoded.element, "cannot be decoded, expected a PNG or JPEG");
  if (size->x < 1 || size->y < 1 || size->x > SIDE_MAX || size->y > SIDE_MAX) {
    gltf_fail(file, encoded.element,
              fmt::format("{} x {} pixels, expected 1 .. {} a side", size->x, size->y, SIDE_MAX));
  }
  return *size;
}

Encoded read_image(const GltfDocument& document, int index) {
  const std::string& file = document.origin.file;
  Encoded encoded{.image = &document.images[static_cast<std::size_t>(index)],
                  .element = fmt::format("image {}", index)};
  const GltfImage& from = *encoded.image;
  if (from.name != encoded.element && from.name != from.uri) encoded.element += fmt::format(" '{}'", from.name);
  const bool is_view = from.buffer_view >= 0;
  if (!is_view) encoded.owned = read_uri(from.uri, document.origin, encoded.element);
  encoded.bytes = is_view ? document.view_bytes(from.buffer_view) : encoded.owned;
  if (encoded.bytes.size() >= BYTES_MAX)
    gltf_fail(file, encoded.element, fmt::format("{} bytes, expected less than {}", encoded.bytes.size(), BYTES_MAX));
  encoded.size = checked_size(encoded, file);
  return encoded;
}

std::vector<std::uint8_t> decode(const Encoded& encoded, const std::string& file) {
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, FreePixels> pixels(stbi_load_from_memory(
      data_of(encoded.bytes), static_cast<int>(encoded.bytes.size()), &width, &height, &channels, STBI_rgb_alpha));
  if (!pixels) {
    gltf_fail(file, encoded.element,
              fmt::format("cannot be decoded ({}), expected a whole PNG or JPEG", stbi_failure_reason()));
  }
  if (glm::uvec2(width, height) != encoded.size)
    gltf_fail(file, encoded.element,
              fmt::format("{} x {} pixels, expected the {} x {} of its header", width, height, encoded.size.x,
                          encoded.size.y));
  return {pixels.get(), pixels.get() + encoded.pixels() * 4};
}

/// The sources of all uses, each once, after the check of what they add up to. `places`: where each use has its own.
std::vector<Encoded> read_sources(const GltfDocument& document, std::span<const GltfImageUse> uses,
                                  std::vector<std::size_t>& places) {
  std::vector<Encoded> sources;
  std::map<int, std::size_t> known;
  std::uint64_t pixels = 0;
  std::size_t bytes = 0;
  for (const GltfImageUse& use : uses) {
    const auto [found, added] = known.try_emplace(use.image, sources.size());
    if (added) sources.push_back(read_image(document, use.image));
    places.push_back(found->second);
    const Encoded& source = sources[found->second];
    pixels += source.pixels();
    if (added) bytes += source.owned.size();
    if (pixels > PIXELS_MAX || bytes > BYTES_MAX)
      gltf_fail(document.origin.file, source.element,
                fmt::format("all images up to it have {} pixels and {} bytes, expected at most {} and {}", pixels,
                            bytes, PIXELS_MAX, BYTES_MAX));
  }
  return sources;
}

}  // namespace

std::vector<Image> read_images(const GltfDocument& document, std::span<const GltfImageUse> uses) {
  std::vector<std::size_t> places;
  std::vector<Encoded> sources = read_sources(document, uses, places);
  std::vector<std::vector<std::uint8_t>> decoded(sources.size());
  std::vector<std::exception_ptr> failures(sources.size());
  std::mutex large;  // large ones are decoded one at a time, as that takes three times their memory
  tbb::parallel_for(std::size_t{0}, sources.size(), [&](std::size_t i) {
    try {
      std::unique_lock alone(large, std::defer_lock);
      if (sources[i].pixels() > LARGE) alone.lock();
      decoded[i] = decode(sources[i], document.origin.file);
      sources[i].owned = {};
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  // The first in order, so that the message does not depend on which thread was faster.
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  std::vector<std::size_t> uses_left(sources.size());
  for (const std::size_t place : places) ++uses_left[place];
  std::vector<Image> images;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const std::size_t place = places[i];
    images.push_back({.name = sources[place].image->name,
                      .width = sources[place].size.x,
                      .height = sources[place].size.y,
                      .rgba = --uses_left[place] > 0 ? decoded[place] : std::move(decoded[place]),
                      .srgb = uses[i].srgb});
  }
  return images;
}

}  // namespace lamp::app
