// Where an instance's matrix sends normals, of any matrix: those that flatten a mesh have no inverse to make it from.
// Based on: Inigo Quilez, Normals and the Inverse Transpose (2017): the matrix of cofactors, which every matrix has.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace lamp::app {

/// Whether it turns counter-clockwise triangles clockwise. The glTF loader turns such a mesh's triangles round, so all
/// who ask must find the same: it is decided of the 32-bit matrix, in 64 bits. False for one that flattens exactly.
[[nodiscard]] bool is_mirroring(const glm::mat4& world_from_object);

/// A multiple of the transposed inverse, which points out of what normals of the mesh point out of; its largest element
/// is about 1, however small or large the mesh is made. Of a matrix that flattens: the limit for a mesh that gets ever
/// thinner, so that what is left of it keeps its two sides. Finite, and a normal does not become 0, so that corners of
/// faces that collapsed to a line have one, too. The matrix's own elements must be finite.
[[nodiscard]] glm::mat3 normal_matrix(const glm::mat4& world_from_object);

}  // namespace lamp::app
