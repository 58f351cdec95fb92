// Vertices so ordered that a triangle's first corner tells its number: a flat attribute of the vertex, which every
// device has (gl_PrimitiveID in fragment shaders needs the feature geometryShader), for at most one more vertex a
// triangle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace lamp::app {

/// Each mesh gets vertices of its own; the first corner of its triangle t is its vertex t. Triangles stay in their
/// order and turn the same way, but may begin at another of their corners.
void number_triangles(Scene& scene);

}  // namespace lamp::app
