// One primitive of a glTF mesh as a triangle list: attributes, indices, strips and fans, missing normals and tangents.
// Based on: Khronos, glTF 2.0 specification, section 3.7.2 (meshes); KHR_mesh_quantization.
// Promise: every index is below the vertex count, every number is finite.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "scene/gltf_attributes.h"

namespace lamp::app {
namespace {

constexpr AttributeWant POSITION{"POSITION", 3, 3, Integers::any};
constexpr AttributeWant NORMAL{"NORMAL", 3, 3, Integers::normalized};
constexpr AttributeWant TANGENT{"TANGENT", 4, 4, Integers::normalized};
constexpr AttributeWant TEXCOORD_0{"TEXCOORD_0", 2, 2, Integers::any};
constexpr AttributeWant TEXCOORD_1{"TEXCOORD_1", 2, 2, Integers::any};
constexpr AttributeWant COLOR_0{"COLOR_0", 3, 4, Integers::normalized};

/// Calls put(vertex, floats of the element) for all vertices, if the attribute is there.
template <class Put>
void for_attribute(const PrimitiveReader& reader, const AttributeWant& want, std::vector<Vertex>& vertices,
                   const Put& put) {
  if (!reader.has(want.name)) return;
  const GltfFloats floats = read_attribute(reader, want, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) put(vertices[i], floats[i], floats.width);
}

/// Eight bits hold 0 .. 1; what lies outside is counted.
void read_colors(const PrimitiveReader& reader, std::vector<Vertex>& vertices, std::vector<std::string>& notes) {
  std::size_t outside = 0;
  for_attribute(reader, COLOR_0, vertices, [&outside](Vertex& vertex, const float* from, std::size_t width) {
    const glm::vec4 color(from[0], from[1], from[2], width == 4 ? from[3] : 1.0F);
    const glm::vec4 clamped = glm::clamp(color, 0.0F, 1.0F);
    if (clamped != color) ++outside;
    vertex.color = glm::u8vec4(clamped * 255.0F + 0.5F);
  });
  if (outside > 0) notes.push_back(fmt::format("{}: {} colors clamped to 0 .. 1", reader.element, outside));
}

std::vector<Vertex> read_vertices(const PrimitiveReader& reader, std::vector<std::string>& notes) {
  const GltfFloats positions = read_attribute(reader, POSITION, 0);
  std::vector<Vertex> vertices(positions.count());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].position = {positions[i][0], positions[i][1], positions[i][2]};
  }
  for_attribute(reader, NORMAL, vertices,
                [](Vertex& vertex, const float* from, std::size_t) { vertex.normal = {from[0], from[1], from[2]}; });
  for_attribute(reader, TANGENT, vertices, [](Vertex& vertex, const float* from, std::size_t) {
    vertex.tangent = {from[0], from[1], from[2], from[3]};
  });
  for_attribute(reader, TEXCOORD_0, vertices,
                [](Vertex& vertex, const float* from, std::size_t) { vertex.uv[0] = {from[0], from[1]}; });
  for_attribute(reader, TEXCOORD_1, vertices,
                [](Vertex& vertex, const float* from, std::size_t) { vertex.uv[1] = {from[0], from[1]}; });
  read_colors(reader, vertices, notes);
  return vertices;
}

std::vector<std::uint32_t> read_corners(const PrimitiveReader& reader, std::size_t vertices) {
  if (reader.primitive.indices < 0) {
    std::vector<std::uint32_t> indices(vertices);
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
  }
  std::vector<std::uint32_t> indices = read_indices(reader.document, reader.primitive.indices);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices) {
      reader.fail(fmt::format("index {} (accessor {}) is {}, expected less than the {} vertices", i,
                              reader.primitive.indices, indices[i], vertices));
    }
  }
  return indices;
}

/// Strips and fans to lists, every triangle facing the way it did.
std::vector<std::uint32_t> to_triangle_list(const PrimitiveReader& reader, std::vector<std::uint32_t> corners) {
  const char* const what = reader.primitive.indices < 0 ? "vertices" : "indices";
  if (reader.primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    if (corners.size() % 3 != 0) {
      reader.fail(fmt::format("{} {}, expected a multiple of 3 for triangles", corners.size(), what));
    }
    return corners;
  }
  if (corners.size() < 3) {
    reader.fail(fmt::format("{} {}, expected at least 3 for a strip or fan", corners.size(), what));
  }
  const bool strip = reader.primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  std::vector<std::uint32_t> list;
  list.reserve((corners.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = i % 2;
    if (strip) list.insert(list.end(), {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
    if (!strip) list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
  }
  return list;
}

void note_repairs(const PrimitiveReader& reader, std::size_t count, std::string_view what,
                  std::vector<std::string>& notes) {
  if (count > 0) notes.push_back(fmt::format("{}: {} {} of length 0 replaced", reader.element, count, what));
}

/// repair_tangents() makes 1 or -1 of it.
void note_handedness(const PrimitiveReader& reader, const Triangles& triangles, std::vector<std::string>& notes) {
  const auto is_odd = [](const Vertex& vertex) { return std::abs(std::abs(vertex.tangent.w) - 1.0F) > 1e-3F; };
  const auto count = std::ranges::count_if(triangles.vertices, is_odd);
  if (count > 0)
    notes.push_back(
        fmt::format("{}: {} tangents with a w that is not 1 or -1: its sign is taken", reader.element, count));
}

}  // namespace

std::optional<Triangles> read_primitive(const GltfDocument& document, GltfPrimitive where,
                                        std::optional<std::uint32_t> normal_uv, std::vector<std::string>& notes) {
  const PrimitiveReader reader{document, document.model.meshes[where.mesh].primitives[where.primitive],
                               fmt::format("mesh {} primitive {}", where.mesh, where.primitive)};
  if (reader.primitive.mode < TINYGLTF_MODE_TRIANGLES || !reader.has(POSITION.name)) return std::nullopt;

  Triangles triangles;
  triangles.vertices = read_vertices(reader, notes);
  triangles.indices = to_triangle_list(reader, read_corners(reader, triangles.vertices.size()));
  if (where.pose != nullptr) pose_triangles(reader, *where.pose, triangles, notes);

  const bool has_normals = reader.has(NORMAL.name);
  if (has_normals) {
    note_repairs(reader, repair_normals(triangles), "normals", notes);
  } else {
    make_flat_normals(triangles);
  }
  // Tangents without normals mean nothing; the specification has them ignored.
  if (has_normals && reader.has(TANGENT.name)) {
    note_handedness(reader, triangles, notes);
    note_repairs(reader, repair_tangents(triangles), "tangents", notes);
  } else if (normal_uv) {
    make_tangents(triangles, *normal_uv);
  }
  return triangles;
}

}  // namespace lamp::app
