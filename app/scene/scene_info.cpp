// Counts and measures.
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_info.h"

#include <algorithm>

namespace lamp::app {
namespace {

LightCount count(const std::vector<Light>& lights, LightType type) {
  LightCount found;
  for (const Light& light : lights) {
    if (light.type != type) continue;
    ++found.count;
    if (light.range >= shared::INFINITE_RADIUS) {
      ++found.unlimited;
      continue;
    }
    const bool first = found.count == found.unlimited + 1;
    found.min_range = first ? light.range : std::min(found.min_range, light.range);
    found.max_range = first ? light.range : std::max(found.max_range, light.range);
  }
  return found;
}

void grow(std::optional<Box>& box, const glm::vec3& position) {
  if (!box) box = Box{position, position};
  box->min = glm::min(box->min, position);
  box->max = glm::max(box->max, position);
}

/// Pixels of a capture that show a surface, and the box around these.
void add_pixels(const CapturedFrame& frame, SceneInfo& info) {
  const View& view = frame.view;
  for (std::uint32_t y = 0; y < view.height(); ++y)
    for (std::uint32_t x = 0; x < view.width(); ++x) {
      const float depth = frame.depth[std::size_t{y} * view.width() + x];
      if (!(depth > 0.0F)) continue;
      const glm::dvec3 position = view.view_position({x + 0.5, y + 0.5}, view.z_view(depth));
      grow(info.bounds, glm::vec3(glm::dmat4(view.world_from_view()) * glm::dvec4(position, 1.0)));
      ++info.covered_pixels;
    }
}

}  // namespace

SceneInfo describe(const Scene& scene) {
  SceneInfo info{.points = count(scene.lights, LightType::point), .spots = count(scene.lights, LightType::spot)};
  for (const Instance& instance : scene.instances) info.triangles += scene.meshes[instance.mesh].index_count / 3;
  if (info.triangles != 0) info.bounds = bounds(scene);
  info.geometry_bytes = scene.vertices.size() * sizeof(Vertex) + scene.indices.size() * sizeof(scene.indices.front());
  for (const Image& image : scene.images) info.image_bytes += image.rgba.size();
  info.transparent =
      static_cast<std::size_t>(std::ranges::count(scene.materials, AlphaMode::blend, &Material::alpha_mode));
  if (scene.captured) add_pixels(*scene.captured, info);
  return info;
}

}  // namespace lamp::app
