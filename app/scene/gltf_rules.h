// What a value of a glTF document must be, as data: one rule for each value that the loader reads.
// Based on: Khronos, glTF 2.0 specification and its JSON schemas; KHR_lights_punctual; KHR_texture_transform;
// KHR_materials_emissive_strength.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace lamp::app {

enum class Want : std::uint8_t {
  object,
  objects,        ///< an array of objects
  index,          ///< an index into an array of the document
  indices,        ///< an array of them
  named_indices,  ///< an object whose values are indices
  natural,        ///< an integer >= 0
  number,
  numbers,  ///< an array of numbers
  text,
  texts,  ///< an array of strings
  flag,
};

struct Rule {
  std::string_view at;  ///< where, by keys and '*' for all elements of an array: "meshes/*/primitives/*"
  std::string_view key;
  Want want = Want::object;
  bool required = false;
  double min = -static_cast<double>(std::numeric_limits<float>::max());
  double max = static_cast<double>(std::numeric_limits<float>::max());
  std::size_t size = 0;    ///< numbers: exactly so many; objects: at most so many
  std::string_view words;  ///< natural, text: the values allowed, between spaces (empty: any)
  std::string_view into;   ///< index and its kin: where the array is
};

/// Containers come before what they contain.
[[nodiscard]] std::span<const Rule> gltf_rules();

/// The places where a material uses a texture, and what each such use may hold (`at` is below the place).
[[nodiscard]] std::span<const std::string_view> gltf_texture_places();
[[nodiscard]] std::span<const Rule> gltf_texture_rules();

}  // namespace lamp::app
