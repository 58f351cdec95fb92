// Reads attributes, and says what is wrong with one.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_attributes.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

constexpr float LARGEST = 1e15F;  // products of two stay well within floats

bool may_hold(Integers integers, int type, bool normalized) {
  if (integers == Integers::indices)
    return !normalized &&
           (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) return true;
  return type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT && (normalized || integers == Integers::any);
}

std::string_view expectation(Integers integers) {
  if (integers == Integers::indices) return "5121 or 5123";
  return integers == Integers::any ? "floats or 8 or 16 bit integers" : "floats or normalized 8 or 16 bit integers";
}

}  // namespace

void PrimitiveReader::fail(const std::string& problem) const { gltf_fail(document.origin.file, element, problem); }

GltfFloats read_attribute(const PrimitiveReader& reader, const AttributeWant& want, std::size_t vertices) {
  const int index = reader.primitive.attributes.at(std::string(want.name));
  const tinygltf::Accessor& accessor = reader.document.model.accessors[static_cast<std::size_t>(index)];
  if (!may_hold(want.integers, accessor.componentType, accessor.normalized)) {
    reader.fail(fmt::format("{} (accessor {}) has componentType {}{}, expected {}", want.name, index,
                            accessor.componentType, accessor.normalized ? " normalized" : "",
                            expectation(want.integers)));
  }
  if (vertices != 0 && accessor.count != vertices) {
    reader.fail(fmt::format("{} (accessor {}) has {} elements, expected {}, as many as POSITION", want.name, index,
                            accessor.count, vertices));
  }
  GltfFloats floats = read_floats(reader.document, index);
  if (floats.width < want.min_width || floats.width > want.max_width) {
    reader.fail(fmt::format("{} (accessor {}) has {} components an element, expected {}", want.name, index,
                            floats.width, want.max_width));
  }
  for (std::size_t i = 0; i < floats.values.size(); ++i) {
    if (!(std::abs(floats.values[i]) <= LARGEST)) {
      reader.fail(fmt::format("{} (accessor {}) of vertex {} holds {}, expected finite numbers up to {:g}", want.name,
                              index, i / floats.width, floats.values[i], LARGEST));
    }
  }
  return floats;
}

}  // namespace lamp::app
