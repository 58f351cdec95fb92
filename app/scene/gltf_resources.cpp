// Where the bytes of buffers and images come from: data URIs and files next to the scene.
// Based on: RFC 2397 (data URIs), RFC 3986 (percent encoding), RFC 4648 (base64).
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "files/read_file.h"
#include "files/utf8_path.h"
#include "scene/gltf_error.h"
#include "system/letter_case.h"

namespace lamp::app {
namespace {

constexpr std::uint64_t LARGEST_FILE = std::uint64_t{1} << 32;  // bytes; a .glb can be no larger

constexpr std::uint8_t NOT_BASE64 = 0xFF;

constexpr std::array<std::uint8_t, 256> base64_values() {
  constexpr std::string_view ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> values{};
  values.fill(NOT_BASE64);
  for (std::size_t i = 0; i < ALPHABET.size(); ++i) {
    values[static_cast<unsigned char>(ALPHABET[i])] = static_cast<std::uint8_t>(i);
  }
  return values;
}

/// Nothing if `text` is not base64, with or without its padding.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
  static constexpr auto VALUES = base64_values();
  for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;

  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char character : text) {
    const std::uint8_t value = VALUES[static_cast<unsigned char>(character)];
    if (value == NOT_BASE64) return std::nullopt;
    bits = bits << 6 | value;
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> count & 0xFFU));
    }
  }
  return bytes;
}

std::optional<std::uint32_t> hex_digit(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return std::nullopt;
}

/// %XX to bytes; a % that starts no such code stays, as many exporters do not encode at all.
std::string decode_percent(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) && hex_digit(text[i + 2]);
    if (code) {
      decoded += static_cast<char>(*hex_digit(text[i + 1]) << 4 | *hex_digit(text[i + 2]));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// The begin of it, as it may be long.
std::string_view shown(std::string_view uri) { return uri.substr(0, 60); }

std::vector<std::byte> read_data_uri(const std::string& uri, const GltfOrigin& origin, const std::string& element) {
  const std::size_t comma = uri.find(',');
  const std::string_view head = std::string_view(uri).substr(0, comma);
  if (comma == std::string::npos || !head.ends_with(";base64")) {
    gltf_fail(origin.file, element, fmt::format("uri begins '{}', expected 'data:TYPE;base64,'", shown(head)));
  }
  std::optional<std::vector<std::byte>> bytes = decode_base64(std::string_view(uri).substr(comma + 1));
  if (!bytes) gltf_fail(origin.file, element, "the data URI cannot be decoded, expected base64");
  return std::move(*bytes);
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  constexpr std::string_view SCHEME = "data:";
  return std::ranges::equal(uri.substr(0, SCHEME.size()), SCHEME, {}, small_letter);  // schemes ignore case
}

std::optional<std::filesystem::path> external_file(const std::string& uri, const GltfOrigin& origin,
                                                   const std::string& element) {
  if (is_data_uri(uri)) return std::nullopt;
  const std::filesystem::path relative = utf8_path(decode_percent(uri));
  if (!stays_below(relative) || uri.find("://") != std::string::npos) {
    gltf_fail(origin.file, element,
              fmt::format("uri is '{}', expected a data URI or a path below the file's own folder", shown(uri)));
  }
  if (origin.folder.empty()) {
    gltf_fail(origin.file, element,
              fmt::format("uri is '{}', expected a data URI, as the scene does not come from a folder", shown(uri)));
  }
  return origin.folder / relative.lexically_normal();
}

std::vector<std::byte> read_uri(const std::string& uri, const GltfOrigin& origin, const std::string& element,
                                std::size_t limit) {
  const std::optional<std::filesystem::path> file = external_file(uri, origin, element);
  if (!file) {
    std::vector<std::byte> bytes = read_data_uri(uri, origin, element);
    if (bytes.size() > limit) bytes.resize(limit);
    return bytes;
  }
  return read_file(*file, {.name = fmt::format("{}: {}: file '{}'", origin.file, element, file->string()),
                           .most_bytes = LARGEST_FILE,
                           .first_bytes = limit});
}

}  // namespace lamp::app
