// Normals from depth: the cross product of the steps to two neighbours, each the one that is nearer in depth, so that
// edges do not bend the surfaces beside them.
// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>

#include "scene/captured_frame.h"

namespace lamp::app {
namespace {

/// Positions of a depth buffer.
struct Relief {
  const View& view;
  const std::vector<float>& depth;

  /// View space; nothing for sky and beyond the edges.
  [[nodiscard]] std::optional<glm::dvec3> at(std::int64_t x, std::int64_t y) const {
    if (x < 0 || y < 0 || x >= view.width() || y >= view.height()) return std::nullopt;
    const float d = depth[static_cast<std::size_t>(y * view.width() + x)];
    if (d <= 0.0F) return std::nullopt;
    return view.view_position({static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}, view.z_view(d));
  }
};

/// From the middle to the neighbour ahead, or from the one behind: whichever is nearer in depth. 0 without both.
glm::dvec3 step(const glm::dvec3& middle, const std::optional<glm::dvec3>& behind,
                const std::optional<glm::dvec3>& ahead) {
  if (!behind && !ahead) return glm::dvec3(0.0);
  if (!behind) return *ahead - middle;
  if (!ahead) return middle - *behind;
  return std::abs(ahead->z - middle.z) < std::abs(behind->z - middle.z) ? *ahead - middle : middle - *behind;
}

glm::vec3 normal_at(const Relief& relief, std::int64_t x, std::int64_t y) {
  const std::optional<glm::dvec3> middle = relief.at(x, y);
  if (!middle) return glm::vec3(0.0F);
  const glm::dvec3 right = step(*middle, relief.at(x - 1, y), relief.at(x + 1, y));
  const glm::dvec3 down = step(*middle, relief.at(x, y - 1), relief.at(x, y + 1));
  const glm::dvec3 to_eye = relief.view.orthographic() ? glm::dvec3(0.0, 0.0, 1.0) : glm::normalize(-*middle);
  const glm::dvec3 across = glm::cross(right, down);
  const double length = glm::length(across);
  glm::dvec3 normal = length > 0.0 ? across / length : to_eye;
  if (glm::dot(normal, to_eye) < 0.0) normal = -normal;
  return glm::vec3(glm::normalize(glm::dmat3(relief.view.world_from_view()) * normal));
}

}  // namespace

std::vector<glm::vec3> normals_from_depth(const View& view, const std::vector<float>& depth) {
  const Relief relief{view, depth};
  std::vector<glm::vec3> normals(depth.size());
  tbb::parallel_for(std::uint32_t{0}, view.height(), [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < view.width(); ++x)
      normals[std::size_t{y} * view.width() + x] = normal_at(relief, x, y);
  });
  return normals;
}

}  // namespace lamp::app
