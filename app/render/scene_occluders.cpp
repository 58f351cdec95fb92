// Collects triangles, and reads the alpha of masked ones.
// SPDX-License-Identifier: Apache-2.0
#include "render/scene_occluders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "render/mirror_images.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

/// Where a triangle comes from.
struct Origin {
  const Mesh* mesh = nullptr;
  std::uint32_t triangle = 0;
};

std::uint32_t wrapped(std::int64_t at, std::uint32_t size, Wrap wrap) {
  const auto n = static_cast<std::int64_t>(size);
  if (wrap == Wrap::clamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(at, 0, n - 1));
  const std::int64_t period = wrap == Wrap::repeat ? n : 2 * n;
  const std::int64_t in_period = (at % period + period) % period;
  return static_cast<std::uint32_t>(in_period < n ? in_period : period - 1 - in_period);
}

/// Between the four texels around a place, as the sampler does at the finest level.
double alpha_at(const Image& image, const Texture& texture, const glm::dvec2& uv) {
  const double c = std::cos(texture.rotation);
  const double s = std::sin(texture.rotation);
  const glm::dvec2 scaled = glm::dvec2(texture.scale) * uv;
  const glm::dvec2 turned(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
  const glm::dvec2 place = (turned + glm::dvec2(texture.offset)) * glm::dvec2(image.width, image.height) - 0.5;
  const glm::dvec2 corner = glm::floor(place);
  const auto texel = [&](int dx, int dy) {
    const std::uint32_t x = wrapped(static_cast<std::int64_t>(corner.x) + dx, image.width, texture.wrap_u);
    const std::uint32_t y = wrapped(static_cast<std::int64_t>(corner.y) + dy, image.height, texture.wrap_v);
    return image.rgba[(std::size_t{y} * image.width + x) * 4 + 3] / 255.0;
  };
  const glm::dvec2 between = place - corner;
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), between.x), glm::mix(texel(0, 1), texel(1, 1), between.x),
                  between.y);
}

/// By images' numbers: those that are read from a coarser level.
using CoarserImages = std::map<std::size_t, Image>;

bool is_there(const Scene& scene, const CoarserImages& coarser, const Origin& origin, double u, double v) {
  const Material& material = scene.materials[origin.mesh->material];
  if (material.alpha_mode != AlphaMode::mask) return true;
  glm::dvec2 uv(0.0);
  double alpha = 0.0;
  const double weights[] = {1.0 - u - v, u, v};
  const std::array<const Vertex*, 3> corners = corners_of(scene, *origin.mesh, origin.triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& vertex = *corners[i];
    uv += weights[i] * glm::dvec2(vertex.uv[material.base_color_texture.uv]);
    alpha += weights[i] * vertex.color.a / 255.0;
  }
  alpha *= material.base_color.a;
  if (const Texture& texture = material.base_color_texture; texture.image >= 0) {
    const auto number = static_cast<std::size_t>(texture.image);
    const auto found = coarser.find(number);
    alpha *= alpha_at(found == coarser.end() ? scene.images[number] : found->second, texture, uv);
  }
  return alpha >= drawn_alpha(material);
}

template <class Use>
void for_each_occluder(const Scene& scene, Use use) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].alpha_mode == AlphaMode::blend) continue;
    for (std::uint32_t t = 0; t < triangle_count(mesh); ++t)
      use(instance, t, world_triangle<double>(scene, instance, t));
  }
}

}  // namespace

Occluders scene_occluders(const Scene& scene, std::span<const std::uint32_t> first_levels) {
  CoarserImages coarser;
  const std::vector<bool> holes = cuts_holes(scene);
  for (std::size_t i = 0; i < first_levels.size(); ++i)
    if (holes[i] && first_levels[i] != 0) coarser.emplace(i, image_at(scene.images[i], first_levels[i]));

  std::vector<Triangle> triangles;
  std::vector<Origin> origins;
  for_each_occluder(scene, [&](const Instance& instance, std::uint32_t t, const std::array<glm::dvec3, 3>& corners) {
    triangles.push_back({corners});
    origins.push_back({&scene.meshes[instance.mesh], t});
  });
  return Occluders(std::move(triangles), [&scene, coarser = std::move(coarser), origins = std::move(origins)](
                                             std::uint32_t triangle, double u, double v) {
    return is_there(scene, coarser, origins[triangle], u, v);
  });
}

std::vector<DrawnSides> drawn_sides(const Scene& scene) {
  std::vector<DrawnSides> sides;
  for_each_occluder(scene, [&](const Instance& instance, std::uint32_t, const std::array<glm::dvec3, 3>& c) {
    sides.push_back({.normal = glm::cross(c[1] - c[0], c[2] - c[0]),
                     .both = scene.materials[scene.meshes[instance.mesh].material].double_sided,
                     .instance = static_cast<std::uint32_t>(&instance - scene.instances.data()),
                     .corners = c});
  });
  return sides;
}

}  // namespace lamp::app
