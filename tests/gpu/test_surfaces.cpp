// Builds known scenes and computes what they look like.
// Based on: Khronos, glTF 2.0, appendix B; Heitz, JCGT 3:2 (2014); Schlick (1994); KHR_lights_punctual.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/test_surfaces.h"

#include <cmath>
#include <numbers>

namespace lamp::app {

void add_wall(Scene& scene, const Quad& quad, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const glm::vec2 uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
    Vertex vertex;
    vertex.position = {uv.x == 0.0F ? quad.x0 : quad.x1, uv.y == 1.0F ? quad.y0 : quad.y1, quad.z};
    vertex.normal = {0.0F, 0.0F, 1.0F};
    vertex.uv = {uv, uv};
    scene.vertices.push_back(vertex);
  }
  scene.meshes.push_back({.first_index = static_cast<std::uint32_t>(scene.indices.size()),
                          .index_count = 6,
                          .vertex_offset = first,
                          .material = material});
  scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1)});
  scene.indices.insert(scene.indices.end(), {0U, 1U, 2U, 0U, 2U, 3U});
}

Scene wall_scene(const Material& material, float half) {
  Scene scene;
  scene.name = "wall";
  scene.materials.push_back(material);
  add_wall(scene, {-half, -half, half, half, 0.0F}, 0);
  Camera camera;
  camera.world_from_camera[3] = glm::vec4(0.0F, 0.0F, 4.0F, 1.0F);
  scene.cameras.push_back(camera);
  return scene;
}

glm::dvec3 reflected(const Reflection& r) {
  const double n_l = glm::dot(r.normal, r.to_light);
  if (n_l <= 0.0) return glm::dvec3(0.0);
  const double n_v = glm::dot(r.normal, r.to_eye);
  const glm::dvec3 half = glm::normalize(r.to_eye + r.to_light);
  const double n_h = glm::dot(r.normal, half);
  const double a2 = std::pow(r.roughness, 4.0);
  const double distribution = a2 / (std::numbers::pi * std::pow(n_h * n_h * (a2 - 1.0) + 1.0, 2.0));
  const auto lambda = [&](double cosine) {  // Smith's masking, as Heitz writes it
    const double tangent2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return (-1.0 + std::sqrt(1.0 + a2 * tangent2)) / 2.0;
  };
  const double masking = 1.0 / (1.0 + lambda(n_l) + lambda(n_v));
  const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), r.base_color, r.metallic);
  const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1.0 - glm::dot(r.to_eye, half), 5.0);
  const glm::dvec3 diffuse = (1.0 - fresnel) * (1.0 - r.metallic) * r.base_color / std::numbers::pi;
  return (diffuse + fresnel * distribution * masking / (4.0 * n_l * n_v)) * n_l;
}

glm::dvec3 seen_point(const View& view, glm::uvec2 pixel, const glm::dvec3& plane_normal) {
  const auto at = [&](double z) {
    const glm::dvec3 p = view.view_position(glm::dvec2(pixel) + 0.5, z);
    return glm::dvec3(glm::dmat4(view.world_from_view()) * glm::dvec4(p, 1.0));
  };
  const glm::dvec3 a = at(1.0);
  const glm::dvec3 ray = at(2.0) - a;
  return a - ray * (glm::dot(plane_normal, a) / glm::dot(plane_normal, ray));
}

glm::dvec3 lit_by_point(const Light& light, const glm::dvec3& position, Reflection surface, const View& view) {
  const glm::dvec3 offset = glm::dvec3(light.position) - position;
  const double distance = glm::length(offset);
  if (distance >= light.range) return glm::dvec3(0.0);
  surface.to_light = offset / distance;
  surface.to_eye = view.orthographic() ? glm::dvec3(glm::dmat4(view.world_from_view())[2])
                                       : glm::normalize(glm::dvec3(glm::dmat4(view.world_from_view())[3]) - position);
  const double window = 1.0 - std::pow(distance / light.range, 4.0);
  return glm::dvec3(light.color) * (light.intensity * window / (distance * distance)) * reflected(surface);
}

}  // namespace lamp::app
