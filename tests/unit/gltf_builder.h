// Small glTF files made in memory, for the tests of the loader.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "error.h"
#include "scene/gltf.h"

namespace lamp::test {

using nlohmann::json;

inline constexpr int BYTE = 5120;
inline constexpr int UNSIGNED_BYTE = 5121;
inline constexpr int SHORT = 5122;
inline constexpr int UNSIGNED_SHORT = 5123;
inline constexpr int UNSIGNED_INT = 5125;
inline constexpr int FLOAT = 5126;

/// A 2 x 2 RGBA PNG: red, green / blue, white with alpha 128.
inline constexpr std::string_view PNG =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwHwyBNAg0AABJSQl4nFEXkgAAAABJRU5ErkJggg==";

inline std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? ALPHABET[bits >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

/// A document with one buffer that grows.
struct GltfBuilder {
  json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  std::vector<std::byte> bytes;

  /// Appends `values` as a buffer view, 4-byte aligned; a stride of 0 is left out.
  template <class T>
  int view(const std::vector<T>& values, int stride = 0) {
    const std::size_t offset = bytes.size();
    const std::size_t size = values.size() * sizeof(T);
    bytes.resize(offset + (size + 3) / 4 * 4);
    std::memcpy(bytes.data() + offset, values.data(), size);
    json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (stride != 0) view["byteStride"] = stride;
    return add("bufferViews", view);
  }

  int accessor(int buffer_view, int component, std::size_t count, const char* type, bool normalized = false) {
    return add("accessors", {{"bufferView", buffer_view},
                             {"componentType", component},
                             {"count", count},
                             {"type", type},
                             {"normalized", normalized}});
  }

  /// A tightly packed float accessor.
  int floats(const std::vector<float>& values, const char* type, std::size_t width) {
    return accessor(view(values), FLOAT, values.size() / width, type);
  }

  int add(const char* array, const json& element) {
    document[array].push_back(element);
    return static_cast<int>(document[array].size() - 1);
  }

  /// A mesh of one primitive.
  int mesh(const json& primitive) { return add("meshes", {{"primitives", json::array({primitive})}}); }

  /// A node that is a root of scene 0.
  int root(const json& node) {
    const int index = add("nodes", node);
    document["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  /// Adds a light definition; the result is what a node's `extensions` must hold.
  json light(const json& definition) {
    json& lights = document["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(definition);
    return {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}};
  }

  [[nodiscard]] std::string gltf() const {
    json whole = document;
    whole["buffers"][0] = {{"byteLength", bytes.size()},
                           {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
    return whole.dump();
  }

  [[nodiscard]] std::string glb() const {
    json whole = document;
    whole["buffers"][0] = {{"byteLength", bytes.size()}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
      std::string out;
      for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xFFU);
      return out;
    };
    const std::string binary(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string body = word(text.size()) + "JSON" + text + word(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(12 + body.size()) + body;
  }
};

/// The triangle (0,0,0), (1,0,0), (0,1,0) as mesh 0, placed by node 0.
inline GltfBuilder triangle() {
  GltfBuilder builder;
  const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  builder.root({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}}})}});
  return builder;
}

inline app::Scene load_text(std::string_view text, const std::filesystem::path& folder = {}) {
  return app::load_gltf(std::as_bytes(std::span(text)), folder, "test.gltf");
}

inline app::Scene load(const GltfBuilder& builder) { return load_text(builder.gltf()); }

/// What the loader says to `text`; empty if it loads.
inline std::string error_text(std::string_view text, const std::filesystem::path& folder = {}) {
  try {
    static_cast<void>(load_text(text, folder));
  } catch (const app::Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace lamp::test
