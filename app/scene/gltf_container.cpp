// The two containers of glTF: JSON text as it is, or a .glb that wraps JSON and one binary buffer.
// Based on: Khronos, glTF 2.0 specification, section 4 (GLB file format).
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_container.h"

#include <fmt/format.h>

#include <cstdint>

#include "files/read_file.h"
#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t MAGIC = 0x46546C67;       // "glTF"
constexpr std::uint32_t CHUNK_JSON = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t CHUNK_BIN = 0x004E4942;   // "BIN"
constexpr std::size_t HEADER_BYTES = 12;
constexpr std::size_t CHUNK_HEADER_BYTES = 8;

std::uint32_t little_endian(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
  return value;
}

struct Chunk {
  std::uint32_t type = 0;
  std::span<const std::byte> bytes;
};

Chunk read_chunk(std::span<const std::byte> glb, std::size_t offset, const std::string& file) {
  const std::string element = fmt::format("GLB chunk at byte {}", offset);
  if (glb.size() - offset < CHUNK_HEADER_BYTES) {
    gltf_fail(file, element, fmt::format("{} bytes left, expected a chunk header of 8", glb.size() - offset));
  }
  const std::size_t length = little_endian(glb, offset);
  const std::size_t left = glb.size() - offset - CHUNK_HEADER_BYTES;
  if (length > left) {
    gltf_fail(file, element, fmt::format("a length of {} bytes, expected at most the {} bytes left", length, left));
  }
  return {little_endian(glb, offset + 4), glb.subspan(offset + CHUNK_HEADER_BYTES, length)};
}

GltfContainer split_glb(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.size() < HEADER_BYTES) {
    gltf_fail(file, "GLB header", fmt::format("{} bytes, expected at least {}", bytes.size(), HEADER_BYTES));
  }
  const std::uint32_t version = little_endian(bytes, 4);
  if (version != 2) gltf_fail(file, "GLB header", fmt::format("version {}, expected 2", version));
  const std::size_t length = little_endian(bytes, 8);
  if (length > bytes.size() || length < HEADER_BYTES) {
    gltf_fail(
        file, "GLB header",
        fmt::format("a length of {} bytes, expected {} .. {} (the file's size)", length, HEADER_BYTES, bytes.size()));
  }
  const std::span<const std::byte> glb = bytes.first(length);

  const Chunk json = read_chunk(glb, HEADER_BYTES, file);
  if (json.type != CHUNK_JSON) {
    gltf_fail(file, "GLB chunk 0", fmt::format("type {:#010x}, expected {:#010x} (JSON)", json.type, CHUNK_JSON));
  }
  GltfContainer container{.json = text_of(json.bytes)};
  // Some exporters fill the chunk up with NULs instead of spaces.
  while (container.json.ends_with('\0')) container.json.remove_suffix(1);

  const std::size_t next = HEADER_BYTES + CHUNK_HEADER_BYTES + json.bytes.size();
  if (next < glb.size()) {
    const Chunk binary = read_chunk(glb, next, file);
    // Chunks of other types belong to extensions; the specification has them ignored.
    if (binary.type == CHUNK_BIN) container.binary = binary.bytes;
  }
  return container;
}

}  // namespace

GltfContainer split_container(std::span<const std::byte> bytes, const std::string& file) {
  if (bytes.empty()) gltf_fail(file, "", "the file is empty, expected glTF 2.0");
  if (bytes.size() >= 4 && little_endian(bytes, 0) == MAGIC) return split_glb(bytes, file);
  return {.json = text_of(bytes), .binary = std::nullopt};
}

}  // namespace lamp::app
