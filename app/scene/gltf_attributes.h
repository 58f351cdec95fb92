// The attributes of a primitive: numbers for each vertex, as its accessors have them.
// Based on: Khronos, glTF 2.0 specification, section 3.7.2.1 (meshes); KHR_mesh_quantization.
// Promise: as many elements as there are vertices, every number finite.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scene/gltf_accessor.h"
#include "scene/gltf_document.h"

namespace lamp::app {

/// The primitive that is read, and how to speak of it.
struct PrimitiveReader {
  const GltfDocument& document;
  const tinygltf::Primitive& primitive;
  std::string element;  ///< "mesh 0 primitive 2"

  /// Throws Error.
  [[noreturn]] void fail(const std::string& problem) const;
  [[nodiscard]] bool has(std::string_view attribute) const {
    return primitive.attributes.contains(std::string(attribute));
  }
};

/// Which integers an attribute may hold.
enum class Integers : std::uint8_t {
  normalized,  ///< or floats
  any,         ///< or floats: those that are not normalized have a meaning (KHR_mesh_quantization)
  indices,     ///< of 8 or 16 bits without a sign, and no floats
};

/// What the elements of an attribute must be.
struct AttributeWant {
  std::string_view name;
  std::size_t min_width;
  std::size_t max_width;
  Integers integers;
};

/// An attribute that is there. `vertices`: how many elements it must have; 0: any. Throws Error.
[[nodiscard]] GltfFloats read_attribute(const PrimitiveReader& reader, const AttributeWant& want, std::size_t vertices);

}  // namespace lamp::app
