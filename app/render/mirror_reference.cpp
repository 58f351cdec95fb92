// Asks the reference once, and where it differs, references that are a little beside it.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamp::app {
namespace {

constexpr double SAME_M = 1e-4;        // of the way and a metre: hits so close are one
constexpr double OF_THE_WAY = 1e-5;    // and a metre: how far beside it a ray may be
constexpr double LEAST_COSINE = 1e-3;  // rays that graze more may be off along their way as much as those
constexpr double HALF_ULP = 0x1p-24;   // the most that one rounding takes of a 32-bit number
// One after the other, on the way from a ray in the world to the triangle that it meets (bvh_walk.glsl). Into the
// mesh's space: the matrix, the difference of the origins, 3 products and 2 sums in each row. A corner: the difference
// to the ray, its product with the shear, the difference of both. Weights: a product that is exact up to 3 sums, the
// sum of all, the quotient.
constexpr double TRACING = (1 + 1 + 3) + 3 + (3 + 2 + 1);
// From weights to a position in the world (bvh_surface.glsl). The first weight: 2 differences. The place on the mesh: a
// product and 2 sums. In the world: a product and 3 sums.
constexpr double PLACING = 2 + 3 + 4;

bool is_same(double a, double b) {
  if (std::isinf(a) || std::isinf(b)) return a == b;
  return std::abs(a - b) <= SAME_M * (1.0 + std::max(a, b));
}

std::string words_of(double distance) { return std::isinf(distance) ? "the sky" : fmt::format("{:.6g} m", distance); }

glm::dvec3 wide(const Vec3& v) { return glm::dvec3(glm::vec3(v)); }

}  // namespace

MirrorReference::MirrorReference(const Scene& scene, const Bvh& bvh, std::span<const std::uint32_t> first_levels)
    : occluders_(scene_occluders(scene, first_levels)),
      sides_(drawn_sides(scene)),
      origins_(scene.instances.size()),
      bvh_(bvh) {
  for (const gpu::BvhInstance& instance : bvh.instances) origins_[instance.scene_instance] = wide(instance.origin);
  const Box box = bounds(scene);
  reach_ = glm::length(glm::dvec3(box.max) - glm::dvec3(box.min)) + 1.0;
  farthest_ = glm::length(glm::max(glm::abs(glm::dvec3(box.min)), glm::abs(glm::dvec3(box.max))));
}

MirrorReference::Met MirrorReference::first(const Line& line) const {
  const double length = glm::length(line.origin) + farthest_ + reach_;
  const Ray ray{.from = line.origin, .to = line.origin + line.direction * length, .first = 1e-18, .last = 1.0};
  // A front may lie on a back, where a mesh is flat.
  const auto hit = occluders_.first_hit(ray, [&](const Hit& met) {
    const DrawnSides& sides = sides_[met.triangle];
    return sides.both || glm::dot(sides.normal, line.direction) < 0.0;
  });
  if (!hit) return {};
  const DrawnSides& sides = sides_[hit->triangle];
  const glm::dvec3 origin = origins_[sides.instance];
  Met met{.distance = hit->at * length,
          .cosine = std::abs(glm::dot(sides.normal, line.direction)) / glm::length(sides.normal),
          .numbers = glm::distance(line.origin, origin)};
  for (const glm::dvec3& corner : sides.corners) met.numbers = std::max(met.numbers, glm::distance(corner, origin));
  return met;
}

/// Where its weights say, in double precision: the world's 32 bits may not hold what those of the mesh do.
MirrorReference::Found MirrorReference::found_at(const Line& line, const gpu::MirrorHit& hit) const {
  if (hit.triangle == gpu::MIRROR_SKY) return {};
  const gpu::BvhTriangle& triangle = bvh_.triangles[hit.triangle];
  const gpu::BvhInstance& instance = bvh_.instances[hit.instance];
  const glm::dmat3 placed(wide(instance.column_x), wide(instance.column_y), wide(instance.column_z));
  const glm::dmat3 sizes(glm::abs(placed[0]), glm::abs(placed[1]), glm::abs(placed[2]));
  const glm::dvec3 origin = wide(instance.origin);
  const double u = hit.u;
  const double v = hit.v;
  const glm::dvec3 on_mesh = (1.0 - u - v) * wide(triangle.a) + u * wide(triangle.b) + v * wide(triangle.c);
  Found found{.at = placed * on_mesh + origin};
  found.distance = glm::distance(found.at, line.origin);
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c})
    found.numbers = std::max(found.numbers, glm::length(sizes * glm::abs(wide(corner))));
  found.placing = found.numbers + glm::length(origin);
  found.numbers = std::max(found.numbers, glm::distance(line.origin, origin));
  return found;
}

/// Whether a reference that is a little beside the ray meets something at the distance that was found. Of a surface
/// that the ray grazes, distances change so much from one to the next that the one through the hit is asked, too:
/// there, the hit may be off the surface as much as it may be off the ray.
bool MirrorReference::is_near(const Line& line, const Found& found, const Met& expected) const {
  const auto& [origin, direction] = line;
  const double way = std::min({expected.distance, found.distance, 1e6});
  const double off = OF_THE_WAY * (1.0 + way) + TRACING * HALF_ULP * std::max(found.numbers, expected.numbers);
  const glm::dvec3 any = std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(direction, any));
  const glm::dvec3 y = glm::cross(direction, x);
  const auto agree = [](const Met& met, double distance, double most) {
    return std::abs(met.distance - distance) * std::max(met.cosine, LEAST_COSINE) <= most;
  };
  for (const glm::dvec3& side : {x, -x, y, -y, x + y, x - y, y - x, -x - y, direction, -direction}) {
    const Met met = first({origin + off * side, direction});
    if (is_same(met.distance, found.distance) || agree(met, found.distance, 2.0 * off)) return true;
  }
  if (std::isinf(found.distance)) return false;
  const glm::dvec3 to_hit = found.at - origin;
  const double along = glm::dot(to_hit, direction);
  const glm::dvec3 beside = to_hit - along * direction;
  if (glm::length(beside) > off) return false;
  return agree(first({origin + beside, direction}), along, off);
}

MirrorCompared MirrorReference::compare(const gpu::MirrorAsked& ray, const gpu::MirrorHit& hit,
                                        const glm::vec3& position) const {
  const Line line{.origin = wide(ray.origin), .direction = wide(ray.direction)};
  const Found found = found_at(line, hit);
  const Met expected = first(line);
  const bool same = is_same(expected.distance, found.distance);
  if (!same && !is_near(line, found, expected))
    return {MirrorAnswer::wrong, fmt::format("{}, expected {}", words_of(found.distance), words_of(expected.distance))};
  if (hit.triangle != gpu::MIRROR_SKY) {
    const double beside = glm::distance(glm::dvec3(position), found.at);
    const double most = PLACING * HALF_ULP * found.placing;
    if (!(beside <= most))
      return {MirrorAnswer::wrong,
              fmt::format("{:.3g} m beside its place on its triangle, expected at most {:.3g} m", beside, most)};
  }
  return {.answer = same ? MirrorAnswer::same : MirrorAnswer::unclear, .fault = {}};
}

}  // namespace lamp::app
