// Reads the elements of accessors, whatever their component type, stride, sparseness or buffer.
// Based on: Khronos, glTF 2.0 specification, section 3.6 (accessors, sparse accessors, data alignment, normalized
// integers). Promise: nothing is read outside a buffer view, and nothing allocated before the layout is known to fit.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

/// Elements within bytes: `count` of them, each `element_bytes` long, `stride` apart.
struct Layout {
  std::span<const std::byte> bytes;
  std::size_t count = 0;
  std::size_t element_bytes = 0;
  std::size_t stride = 0;
};

std::size_t component_bytes(int type) {
  return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

/// Elements in a buffer view from `offset`; fails if the last one ends outside.
Layout layout_in_view(const GltfDocument& document, const std::string& element, int view, std::size_t offset,
                      Layout layout) {
  layout.bytes = document.view_bytes(view);
  const std::size_t size = layout.bytes.size();
  const bool fits = offset <= size && layout.element_bytes <= size - offset &&
                    layout.count - 1 <= (size - offset - layout.element_bytes) / layout.stride;
  if (!fits) {
    gltf_fail(document.origin.file, element,
              fmt::format("{} elements of {} bytes, {} apart, from byte {}, expected to end within the {} bytes of "
                          "bufferView {}",
                          layout.count, layout.element_bytes, layout.stride, offset, size, view));
  }
  layout.bytes = layout.bytes.subspan(offset);
  return layout;
}

template <class Number>
Number load(const std::byte* from) {
  Number number;
  std::memcpy(&number, from, sizeof number);
  return number;
}

template <class Integer>
float to_float(Integer integer, bool normalized) {
  const auto value = static_cast<float>(integer);
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<Integer>::max()), -1.0F);
}

float load_float(const std::byte* from, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return to_float(load<std::int8_t>(from), normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return to_float(load<std::uint8_t>(from), normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return to_float(load<std::int16_t>(from), normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return to_float(load<std::uint16_t>(from), normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return to_float(load<std::uint32_t>(from), normalized);
    default:
      return load<float>(from);
  }
}

std::uint32_t load_index(const std::byte* from, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

/// The elements that a sparse accessor replaces, strictly ascending as the specification demands.
std::vector<std::uint32_t> sparse_indices(const GltfDocument& document, const std::string& element,
                                          const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  const std::size_t bytes = component_bytes(sparse.indices.componentType);
  const Layout layout = layout_in_view(document, element + " sparse indices", sparse.indices.bufferView,
                                       static_cast<std::size_t>(sparse.indices.byteOffset),
                                       {{}, static_cast<std::size_t>(sparse.count), bytes, bytes});
  std::vector<std::uint32_t> indices(layout.count);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    indices[i] = load_index(layout.bytes.data() + i * layout.stride, sparse.indices.componentType);
    const bool ascends = i == 0 || indices[i] > indices[i - 1];
    if (!ascends || indices[i] >= accessor.count) {
      gltf_fail(document.origin.file, element + " sparse indices",
                fmt::format("index {} is {}, expected more than the one before and less than {}", i, indices[i],
                            accessor.count));
    }
  }
  return indices;
}

/// Where all elements of an accessor are; both layouts may be empty, then the elements are zero.
struct Located {
  Layout dense;
  Layout sparse;
  std::vector<std::uint32_t> sparse_at;  ///< the element that each element of `sparse` replaces
};

Located locate(const GltfDocument& document, int index, const tinygltf::Accessor& accessor) {
  const std::string element = fmt::format("accessor {}", index);
  const int width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  const std::size_t bytes = static_cast<std::size_t>(width) * component_bytes(accessor.componentType);
  Located located;
  if (accessor.bufferView >= 0) {
    const auto& view = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const std::size_t stride = view.byteStride == 0 ? bytes : view.byteStride;
    if (stride < bytes) {
      gltf_fail(document.origin.file, element,
                fmt::format("byteStride of bufferView {} is {}, expected at least {}, the size of an element",
                            accessor.bufferView, stride, bytes));
    }
    located.dense = layout_in_view(document, element, accessor.bufferView, accessor.byteOffset,
                                   {{}, accessor.count, bytes, stride});
  }
  if (accessor.sparse.isSparse) {
    located.sparse_at = sparse_indices(document, element, accessor);
    located.sparse = layout_in_view(document, element + " sparse values", accessor.sparse.values.bufferView,
                                    static_cast<std::size_t>(accessor.sparse.values.byteOffset),
                                    {{}, located.sparse_at.size(), bytes, bytes});
  }
  return located;
}

/// Calls put(element, bytes) for every element that has bytes; those that replace others come last.
template <class Put>
void for_each_element(const Located& located, const Put& put) {
  for (std::size_t i = 0; i < located.dense.count; ++i) put(i, located.dense.bytes.data() + i * located.dense.stride);
  for (std::size_t i = 0; i < located.sparse.count; ++i) {
    put(located.sparse_at[i], located.sparse.bytes.data() + i * located.sparse.stride);
  }
}

}  // namespace

GltfFloats read_floats(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  if (accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
      accessor.type == TINYGLTF_TYPE_MAT4) {
    gltf_fail(document.origin.file, fmt::format("accessor {}", index),
              "type is a matrix, expected SCALAR or VEC2 .. VEC4");
  }
  const Located located = locate(document, index, accessor);
  const std::size_t bytes = component_bytes(accessor.componentType);
  GltfFloats floats;
  floats.width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  floats.values.resize(accessor.count * floats.width);
  for_each_element(located, [&](std::size_t element, const std::byte* from) {
    for (std::size_t i = 0; i < floats.width; ++i) {
      floats.values[element * floats.width + i] =
          load_float(from + i * bytes, accessor.componentType, accessor.normalized);
    }
  });
  return floats;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  const int type = accessor.componentType;
  const bool is_unsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_unsigned) {
    gltf_fail(document.origin.file, fmt::format("accessor {}", index),
              fmt::format("componentType is {}, expected a SCALAR of 5121, 5123 or 5125, as it holds indices", type));
  }
  const Located located = locate(document, index, accessor);
  std::vector<std::uint32_t> indices(accessor.count);
  for_each_element(located,
                   [&](std::size_t element, const std::byte* from) { indices[element] = load_index(from, type); });
  return indices;
}

std::vector<glm::dmat4> read_matrices(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  const auto fail = [&](const std::string& problem) {
    gltf_fail(document.origin.file, fmt::format("accessor {}", index), problem);
  };
  if (accessor.type != TINYGLTF_TYPE_MAT4) fail("type is not MAT4, expected that, as it holds matrices");
  if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    fail(fmt::format("componentType is {}, expected 5126, as it holds matrices", accessor.componentType));
  const Located located = locate(document, index, accessor);
  std::vector<glm::dmat4> matrices(accessor.count, glm::dmat4(0.0));
  for_each_element(located, [&](std::size_t element, const std::byte* from) {
    for (int i = 0; i < 16; ++i) matrices[element][i / 4][i % 4] = load<float>(from + sizeof(float) * i);
  });
  return matrices;
}

}  // namespace lamp::app
