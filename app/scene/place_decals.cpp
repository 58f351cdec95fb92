// Generated decals: points drawn uniformly by area from the scene's opaque triangles, one random sequence a decal.
// Based on: Turk, Generating Random Points in Triangles, Graphics Gems (1990).
// SPDX-License-Identifier: Apache-2.0
#include "scene/place_decals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "error.h"
#include "scene/procedural_random.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

using procedural::Random;

struct Triangle {
  std::array<glm::vec3, 3> corners{};
  double area_before = 0.0;  ///< of this triangle and all before it
};

/// Triangles that decals may lie on: none of a transparent material, none without area.
std::vector<Triangle> surfaces(const Scene& scene) {
  std::vector<Triangle> triangles;
  double area = 0.0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].alpha_mode != AlphaMode::opaque) continue;
    for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
      Triangle triangle{.corners = world_triangle<float>(scene, instance, t)};
      const auto& [a, b, c] = triangle.corners;
      const double doubled = glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)));
      if (!(doubled > 0.0) || !std::isfinite(doubled)) continue;
      area += 0.5 * doubled;
      triangle.area_before = area;
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

glm::vec3 point_on(const Triangle& triangle, Random& random) {
  const auto& [a, b, c] = triangle.corners;
  const float root = std::sqrt(random.unit());
  const float share = random.unit();
  return a * (1.0F - root) + b * (root * (1.0F - share)) + c * (root * share);
}

/// Paint for a floor (or ceiling) or for a wall.
void draw_look(Decal& decal, bool level, Random& random) {
  constexpr std::array FLOOR{DecalPattern::mosaic, DecalPattern::crack, DecalPattern::moss};
  constexpr std::array WALL{DecalPattern::painting, DecalPattern::crack, DecalPattern::moss, DecalPattern::sign};
  decal.pattern = level ? FLOOR[random.below(FLOOR.size())] : WALL[random.below(WALL.size())];
  const auto earthen = [&] {
    const float blue = random.between(0.04F, 0.4F);
    const float green = random.between(0.06F, 0.4F);
    return glm::vec3(random.between(0.08F, 0.6F), green, blue);
  };
  decal.color_a = earthen();
  decal.color_b = earthen();
  decal.relief = 0.01F;
  if (decal.pattern == DecalPattern::crack) decal.color_a = glm::vec3(0.03F);
  if (decal.pattern == DecalPattern::moss) {
    decal.color_a = {0.05F, 0.11F, 0.02F};
    decal.color_b = {0.16F, 0.22F, 0.05F};
  }
  if (decal.pattern == DecalPattern::sign || decal.pattern == DecalPattern::painting) decal.relief = 0.002F;
}

Decal generated(const std::vector<Triangle>& triangles, float scale_m, std::uint64_t seed) {
  Random random(seed);
  const double area = triangles.back().area_before * static_cast<double>(random.unit());
  const auto chosen = std::ranges::lower_bound(triangles, area, {}, &Triangle::area_before);
  const Triangle& triangle = chosen == triangles.end() ? triangles.back() : *chosen;
  Decal decal{.center = point_on(triangle, random)};
  const auto& [a, b, c] = triangle.corners;
  const glm::vec3 normal = glm::vec3(glm::normalize(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a))));
  const bool level = std::abs(normal.y) > 0.7F;
  const float turn = random.between(0.0F, 6.2831853F);
  decal.orientation = facing(normal, level ? glm::vec3(std::cos(turn), 0.0F, std::sin(turn)) : glm::vec3(0, 1, 0));
  const float size = scale_m * random.between(0.5F, 1.5F);
  decal.half_extents = glm::vec3(size, size * (level ? 1.0F : random.between(0.6F, 1.2F)), 0.3F * size);
  decal.seed = random.bits();
  draw_look(decal, level, random);
  return decal;
}

}  // namespace

std::vector<Decal> place_decals(const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  const std::size_t own = std::min<std::size_t>(count, scene.decals.size());
  std::vector<Decal> decals(scene.decals.begin(), scene.decals.begin() + static_cast<std::ptrdiff_t>(own));
  if (decals.size() == count) return decals;
  const std::vector<Triangle> triangles = surfaces(scene);
  if (triangles.empty())
    throw Error(fmt::format("scene '{}': has no opaque surface for generated decals, expected at most {} decals",
                            scene.name, scene.decals.size()));
  // Of the size of a person's reach in a house, of a wall in a town.
  const Box box = bounds(scene);
  const float scale_m = std::clamp(glm::length(box.max - box.min) * 0.015F, 0.05F, 8.0F);
  for (std::uint32_t i = 0; decals.size() < count; ++i)
    decals.push_back(generated(triangles, scale_m, seed * 0x9E3779B97F4A7C15ULL + i + 1));
  return decals;
}

}  // namespace lamp::app
