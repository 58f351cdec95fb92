// Collects triangles with their normals, as mesh.vert and material.glsl have them.
// SPDX-License-Identifier: Apache-2.0
#include "scene/still_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/normal_matrix.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

/// World space; tangent.w as the vertex has it.
struct Frame {
  glm::vec3 normal{0.0F};
  glm::vec4 tangent{0.0F};
};

/// Whether all frames that are interpolated between these have three axes at right angles, as material.glsl makes them
/// of a tangent that is not along the normal.
bool keep_apart(const std::array<Frame, 3>& frames) {
  constexpr float MOST_ALONG = 0.3F;   // cosine between a normal and a tangent
  constexpr float LEAST_ALIKE = 0.5F;  // and between two normals or two tangents
  for (const Frame& a : frames) {
    if (std::abs(a.tangent.w) != 1.0F) return false;
    for (const Frame& b : frames) {
      const glm::vec3 normal = glm::normalize(b.normal);
      const glm::vec3 tangent = glm::normalize(glm::vec3(b.tangent));
      const glm::vec3 of_a = glm::normalize(glm::vec3(a.tangent));
      const bool apart = std::abs(glm::dot(of_a, normal)) <= MOST_ALONG;  // not of what is no number
      const bool alike =
          glm::dot(of_a, tangent) >= LEAST_ALIKE && glm::dot(glm::normalize(a.normal), normal) >= LEAST_ALIKE;
      if (!apart || !alike) return false;
    }
  }
  return true;
}

}  // namespace

float normal_tilt(const Scene& scene, const Material& material) {
  if (material.double_sided) return ANY_NORMAL;
  if (material.normal_texture.image < 0) return 0.0F;
  const Image& image = scene.images[static_cast<std::size_t>(material.normal_texture.image)];
  if (image.srgb) return ANY_NORMAL;
  // Texels within a cone, and what filters mix of them lies in it too.
  float steepest = 0.0F;
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const glm::vec3 read = glm::vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) / 127.5F - 1.0F;
    steepest = std::max(steepest, std::atan2(std::abs(material.normal_scale) * glm::length(glm::vec2(read)), read.z));
  }
  constexpr float ROUNDED = 0.01F;  // of filters, whose weights have 8 bits
  return steepest + ROUNDED < std::numbers::pi_v<float> / 2.0F ? steepest + ROUNDED : ANY_NORMAL;
}

std::vector<StillTriangle> still_surfaces(const Scene& scene, bool painted) {
  std::vector<float> tilts;
  for (const Mesh& mesh : scene.meshes)
    tilts.push_back(painted ? ANY_NORMAL : normal_tilt(scene, scene.materials[mesh.material]));
  std::vector<StillTriangle> triangles;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::mat3 world_from_normal = normal_matrix(instance.world_from_object);
    for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
      StillTriangle& triangle = triangles.emplace_back();
      triangle.normal_tilt = tilts[instance.mesh];
      std::array<Frame, 3> frames;
      const std::array<const Vertex*, 3> corners = corners_of(scene, mesh, t);
      const auto positions = world_triangle<double>(scene, instance, t);
      for (std::size_t i = 0; i < 3; ++i) {
        const Vertex& vertex = *corners[i];
        frames[i].normal = world_from_normal * vertex.normal;
        frames[i].tangent =
            glm::vec4(glm::mat3(instance.world_from_object) * glm::vec3(vertex.tangent), vertex.tangent.w);
        triangle.corners[i] = DVec3(positions[i]);
        triangle.normals[i] = Vec3(frames[i].normal);
      }
      if (triangle.normal_tilt > 0.0F && !keep_apart(frames)) triangle.normal_tilt = ANY_NORMAL;
    }
  }
  return triangles;
}

std::vector<std::uint32_t> first_triangles(const Scene& scene) {
  std::vector<std::uint32_t> firsts;
  std::uint32_t next = 0;
  for (const Instance& instance : scene.instances) {
    firsts.push_back(next);
    next += triangle_count(scene.meshes[instance.mesh]);
  }
  return firsts;
}

}  // namespace lamp::app
