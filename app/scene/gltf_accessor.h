// Reads the elements of accessors, whatever their component type, stride, sparseness or buffer.
// Based on: Khronos, glTF 2.0 specification, section 3.6 (accessors, sparse accessors, data alignment, normalized
// integers). Promise: nothing is read outside a buffer view, and nothing allocated before the layout is known to fit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/gltf_document.h"

namespace lamp::app {

/// `width` floats an element, one element after the other.
struct GltfFloats {
  std::size_t width = 0;
  std::vector<float> values;

  [[nodiscard]] std::size_t count() const { return width == 0 ? 0 : values.size() / width; }
  [[nodiscard]] const float* operator[](std::size_t element) const { return values.data() + element * width; }
};

/// Scalars and vectors as floats; normalized integers become -1 .. 1 or 0 .. 1. Throws Error.
[[nodiscard]] GltfFloats read_floats(const GltfDocument& document, int accessor);

/// Unsigned scalars. Throws Error.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor);

/// 4 x 4 matrices of floats. Throws Error.
[[nodiscard]] std::vector<glm::dmat4> read_matrices(const GltfDocument& document, int accessor);

}  // namespace lamp::app
