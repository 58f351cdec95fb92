// Draws points.
// SPDX-License-Identifier: Apache-2.0
#include "scene/random_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "scene/procedural_random.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

constexpr float NEAR_M = 100.0F;
constexpr float FAR_M = 1e5F;
constexpr int TRIES = 64;  // for a point near the eye, of a facet that is not all near

using procedural::Random;

glm::vec3 draw_in(Random& random, const glm::vec3& low, const glm::vec3& high) {
  const float x = random.between(low.x, high.x);
  const float y = random.between(low.y, high.y);
  return {x, y, random.between(low.z, high.z)};
}

glm::vec3 draw_far(Random& random) {
  const float y = random.between(-1.0F, 1.0F);
  const float angle = random.between(0.0F, 6.2831853F);
  const float side = std::sqrt(1.0F - y * y);
  return FAR_M * glm::vec3(side * std::cos(angle), y, side * std::sin(angle));
}

}  // namespace

std::string_view name_of(PointKind kind) {
  switch (kind) {
    case PointKind::near_surface:
      return "surfaces within 100 m";
    case PointKind::surface:
      return "surfaces";
    case PointKind::air:
      return "open air";
    case PointKind::anywhere:
      return "anywhere";
    case PointKind::far:
      break;
  }
  return "100 km away";
}

void PointSource::add(Surfaces& to, Facet facet) {
  const double area = 0.5 * glm::length(glm::cross(glm::dvec3(facet.u), glm::dvec3(facet.v)));
  if (!(area > 0.0) || !std::isfinite(area)) return;  // degenerate: no point is on it
  facet.area_before = to.area;
  to.facets.push_back(facet);
  to.area += area;
}

PointSource::PointSource(const Scene& scene, OpenAir air, const glm::vec3& eye)
    : air_(std::move(air)), bounds_(bounds(scene)), eye_(eye) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
      const std::array<glm::vec3, 3> corners = world_triangle<float>(scene, instance, t);
      const Facet facet{corners[0], corners[1] - corners[0], corners[2] - corners[0]};
      add(all_, facet);
      const glm::vec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
      const glm::vec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
      if (glm::distance(glm::clamp(eye_, low, high), eye_) <= NEAR_M) add(near_, facet);
    }
  }
}

glm::vec3 PointSource::draw(const Surfaces& from, double share, glm::vec2 place) {
  const auto after = std::ranges::upper_bound(from.facets, share * from.area, {}, &Facet::area_before);
  const Facet& facet = *std::prev(after);
  if (place.x + place.y > 1.0F) place = 1.0F - place;
  return facet.corner + place.x * facet.u + place.y * facet.v;
}

std::vector<glm::vec3> PointSource::draw(PointKind kind, std::size_t count, std::uint64_t seed) const {
  const Surfaces& surfaces = kind == PointKind::near_surface ? near_ : all_;
  std::vector<glm::vec3> points;
  Random random(seed * std::size(POINT_KINDS) + static_cast<std::uint64_t>(kind));
  const auto on_surface = [&] {
    const double share = random.bits() * 0x1p-32;
    const float u = random.unit();
    return draw(surfaces, share, {u, random.unit()});
  };
  while (points.size() < count) {
    if (kind == PointKind::far) {
      points.push_back(draw_far(random));
    } else if (kind == PointKind::anywhere) {
      const glm::vec3 size = bounds_.max - bounds_.min;
      points.push_back(draw_in(random, bounds_.min - size, bounds_.max + size));
    } else if (kind == PointKind::air) {
      const glm::vec3 low = air_.cells[random.below(static_cast<std::uint32_t>(air_.cells.size()))].min;
      points.push_back(draw_in(random, low, low + air_.cell_m));
    } else {
      if (surfaces.facets.empty()) return {};
      glm::vec3 point = on_surface();
      for (int i = 0; i < TRIES && kind == PointKind::near_surface && glm::distance(point, eye_) > NEAR_M; ++i)
        point = on_surface();
      if (kind == PointKind::near_surface && glm::distance(point, eye_) > NEAR_M) return {};
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace lamp::app
