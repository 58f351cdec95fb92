// Poses meshes once, when they are loaded: nothing moves them afterwards.
// Based on: Khronos, glTF 2.0 specification, section 3.7.3 (skins), linear blend skinning.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_skins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <utility>

#include "scene/gltf_error.h"
#include "scene/normal_matrix.h"

namespace lamp::app {
namespace {

constexpr std::size_t SETS_MAX = 8;  // attributes may share one accessor: a bound on what they add up to

/// Four joints for each vertex, and the weight of each.
struct JointSet {
  GltfFloats joints;
  GltfFloats weights;
};

/// The inverse bind matrices of a skin, which are the identity where it has none.
std::vector<glm::dmat4> inverse_bind_matrices(const GltfDocument& document, const tinygltf::Skin& skin,
                                              const std::string& element) {
  if (skin.inverseBindMatrices < 0) return std::vector<glm::dmat4>(skin.joints.size(), glm::dmat4(1.0));
  std::vector<glm::dmat4> matrices = read_matrices(document, skin.inverseBindMatrices);
  const auto fail = [&](const std::string& problem) {
    gltf_fail(document.origin.file, element,
              fmt::format("inverseBindMatrices (accessor {}) {}", skin.inverseBindMatrices, problem));
  };
  if (matrices.size() < skin.joints.size())
    fail(fmt::format("has {} elements, expected {}, one for each joint", matrices.size(), skin.joints.size()));
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const double* numbers = glm::value_ptr(matrices[i]);
    for (std::size_t k = 0; k < 16; ++k)
      if (!(std::abs(numbers[k]) <= FURTHEST_M))
        fail(fmt::format("of joint {} holds {}, expected finite numbers up to {:g}", i, numbers[k], FURTHEST_M));
    constexpr glm::dvec4 AFFINE(0.0, 0.0, 0.0, 1.0);
    const glm::dvec4 last_row(matrices[i][0][3], matrices[i][1][3], matrices[i][2][3], matrices[i][3][3]);
    if (glm::distance(last_row, AFFINE) > 1e-5)  // exporters invert in 32 bits
      fail(fmt::format("of joint {} has a last row that is not 0 0 0 1, expected an affine one", i));
    for (int column = 0; column < 4; ++column) matrices[i][column][3] = AFFINE[column];
  }
  return matrices;
}

JointSet read_set(const PrimitiveReader& reader, const std::string& joints, const std::string& weights,
                  std::size_t vertices) {
  if (!reader.has(joints)) reader.fail(fmt::format("{} is missing, expected it, as a skin poses the mesh", joints));
  if (!reader.has(weights)) reader.fail(fmt::format("{} is missing, expected it beside {}", weights, joints));
  return {read_attribute(reader, {joints, 4, 4, Integers::indices}, vertices),
          read_attribute(reader, {weights, 4, 4, Integers::normalized}, vertices)};
}

void check_set(const PrimitiveReader& reader, const JointSet& set, std::size_t number, std::size_t joints) {
  const auto fail = [&](const char* name, std::size_t at, float value, const std::string& expected) {
    const std::string attribute = fmt::format("{}_{}", name, number);
    reader.fail(fmt::format("{} (accessor {}) of vertex {} holds {}, expected {}", attribute,
                            reader.primitive.attributes.at(attribute), at / 4, value, expected));
  };
  for (std::size_t i = 0; i < set.joints.values.size(); ++i) {
    if (set.joints.values[i] >= static_cast<float>(joints))
      fail("JOINTS", i, set.joints.values[i], fmt::format("less than the {} joints of the skin", joints));
    if (set.weights.values[i] < 0.0F) fail("WEIGHTS", i, set.weights.values[i], "0 or more");
  }
}

std::vector<JointSet> read_sets(const PrimitiveReader& reader, std::size_t vertices, std::size_t joints) {
  std::vector<JointSet> sets;
  // One at least, which a skin asks for.
  do {
    const std::size_t number = sets.size();
    if (number == SETS_MAX) reader.fail(fmt::format("JOINTS_{} is there, expected at most {} sets", number, SETS_MAX));
    sets.push_back(read_set(reader, fmt::format("JOINTS_{}", number), fmt::format("WEIGHTS_{}", number), vertices));
    check_set(reader, sets.back(), number, joints);
  } while (reader.has(fmt::format("JOINTS_{}", sets.size())) || reader.has(fmt::format("WEIGHTS_{}", sets.size())));
  return sets;
}

/// The mean of the matrices of a vertex's joints by their weights, which integers cannot always make add up to 1.
/// Nothing where all weights are 0.
std::optional<glm::dmat4> blended(const GltfPose& pose, std::span<const JointSet> sets, std::size_t vertex) {
  glm::dmat4 sum(0.0);
  double weights = 0.0;
  for (const JointSet& set : sets)
    for (std::size_t i = 0; i < 4; ++i) {
      const double weight = set.weights[vertex][i];
      sum += weight * pose[static_cast<std::size_t>(set.joints[vertex][i])];
      weights += weight;
    }
  if (weights == 0.0) return std::nullopt;
  return sum / weights;
}

/// The unit vector that points this way; 0 stays 0, and is repaired with those of the file.
glm::vec3 direction(const glm::dvec3& vector) {
  const double length = glm::length(vector);
  return length > 0.0 ? glm::vec3(vector / length) : glm::vec3(0.0F);
}

void pose_vertex(const PrimitiveReader& reader, std::size_t number, const glm::dmat4& world_from_vertex,
                 Vertex& vertex) {
  const glm::dvec3 position(world_from_vertex * glm::dvec4(vertex.position, 1.0));
  const glm::dvec3 reach = glm::abs(position);
  const double furthest = std::max({reach.x, reach.y, reach.z});
  if (!(furthest <= FURTHEST_M)) {
    reader.fail(fmt::format("its skin takes vertex {} {:g} m away, expected at most {:g} m from the origin", number,
                            furthest, FURTHEST_M));
  }
  const glm::mat4 matrix(world_from_vertex);
  vertex.position = glm::vec3(position);
  vertex.normal = direction(glm::dmat3(normal_matrix(matrix)) * glm::dvec3(vertex.normal));
  const float handedness = is_mirroring(matrix) ? -vertex.tangent.w : vertex.tangent.w;
  vertex.tangent = glm::vec4(direction(glm::dmat3(world_from_vertex) * glm::dvec3(vertex.tangent)), handedness);
}

}  // namespace

GltfPoses::GltfPoses(const GltfDocument& document, std::span<const PlacedNode> nodes)
    : document_(document), placed_(document.model.nodes.size(), nullptr) {
  for (const PlacedNode& placed : nodes) placed_[static_cast<std::size_t>(placed.node)] = &placed;
}

GltfPose GltfPoses::make(int skin) const {
  const std::string element = fmt::format("skin {}", skin);
  const tinygltf::Skin& from = document_.model.skins[static_cast<std::size_t>(skin)];
  const std::vector<glm::dmat4> inverse_bind = inverse_bind_matrices(document_, from, element);
  GltfPose pose;
  for (std::size_t i = 0; i < from.joints.size(); ++i) {
    const PlacedNode* joint = placed_[static_cast<std::size_t>(from.joints[i])];
    if (joint == nullptr)
      gltf_fail(document_.origin.file, element,
                fmt::format("joint {} is node {}, expected one that is in the scene", i, from.joints[i]));
    pose.push_back(joint->world_from_node * inverse_bind[i]);
  }
  return pose;
}

const GltfPose& GltfPoses::of(int skin) {
  if (skin != made_of_) made_ = make(skin);
  made_of_ = skin;
  return made_;
}

void pose_triangles(const PrimitiveReader& reader, const GltfPose& pose, Triangles& triangles,
                    std::vector<std::string>& notes) {
  const std::vector<JointSet> sets = read_sets(reader, triangles.vertices.size(), pose.size());
  std::vector<bool> mirrored;
  std::size_t without = 0;
  for (std::size_t i = 0; i < triangles.vertices.size(); ++i) {
    const std::optional<glm::dmat4> mean = blended(pose, sets, i);
    if (!mean) ++without;
    const glm::dmat4& matrix = mean ? *mean : pose[static_cast<std::size_t>(sets.front().joints[i][0])];
    pose_vertex(reader, i, matrix, triangles.vertices[i]);
    mirrored.push_back(is_mirroring(glm::mat4(matrix)));
  }
  for (std::size_t i = 0; i + 3 <= triangles.indices.size(); i += 3)
    if (mirrored[triangles.indices[i]]) std::swap(triangles.indices[i + 1], triangles.indices[i + 2]);
  if (without > 0)
    notes.push_back(fmt::format("{}: {} vertices without weights follow their first joint", reader.element, without));
}

}  // namespace lamp::app
