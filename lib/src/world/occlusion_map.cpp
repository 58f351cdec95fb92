// Draws polygons into the cube from inside, and holds hulls against it.
// Based on: Durand et al., Conservative Visibility Preprocessing Using Extended Projections (2000), section 3; a
// plane's 1 / depth is linear in a picture: Blinn, Hyperbolic Interpolation (1992).
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lamplight/shared/light.h"
#include "still_occluders.h"

namespace lamp {
namespace {

using world::ConvexPolygon;

constexpr double EDGE_ROOM = 1e-9;   // of an edge's two distances: how far inside of it a texel's corners must lie
constexpr double ROUNDING = 4e-16;   // of a double
constexpr double FLOAT_DOWN = 1e-6;  // of a value: more than rounding to a float takes
constexpr std::uint32_t FACES = 6;

/// A face's axis and side; the coordinates of a position are (u, v, w), w along the axis.
struct Face {
  int axis;
  double sign;

  explicit Face(std::uint32_t number) : axis(static_cast<int>(number / 2)), sign(number % 2 == 0 ? 1.0 : -1.0) {}
  [[nodiscard]] glm::dvec3 turned(const glm::dvec3& v) const {
    return {v[(axis + 1) % 3], v[(axis + 2) % 3], sign * v[axis]};
  }
};

/// Inside: x u + y v + z >= 0, for directions (u, v, 1).
using Line = glm::dvec3;

/// At all corners of a texel, given its centre.
Line for_whole_texels(const Line& line, double half) {
  return {line.x, line.y, line.z - (std::abs(line.x) + std::abs(line.y)) * half};
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// A polygon as the light sees it.
struct Seen {
  std::vector<glm::dvec3> edges;  ///< planes through the light; inside: >= room
  std::vector<double> rooms;
  glm::dvec3 nearness{0.0};  ///< dot with a direction: at least 1 / distance along it, where it is inside
};

/// False: too nearly in its plane.
bool see(const ConvexPolygon& polygon, const glm::dvec3& eye, Seen& seen) {
  const double scale = std::max(largest(eye), largest(polygon.corners[0]));
  double farthest = 0.0;
  for (const glm::dvec3& corner : polygon.corners) farthest = std::max(farthest, glm::distance(corner, eye));
  const double ahead = polygon.offset - glm::dot(polygon.normal, eye);
  const double rounding = ROUNDING * 16.0 * (scale + farthest);
  const double height = std::abs(ahead);
  if (!(height > 2.0 * (polygon.thickness + polygon.tilt * farthest) + EDGE_ROOM * farthest + rounding)) return false;
  const double side = ahead > 0.0 ? 1.0 : -1.0;
  seen.nearness = side * polygon.normal / (height + polygon.thickness + rounding);
  seen.edges.clear();
  seen.rooms.clear();
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const glm::dvec3 a = polygon.corners[i] - eye;
    const glm::dvec3 b = polygon.corners[(i + 1) % polygon.corners.size()] - eye;
    const double la = glm::length(a);
    const double lb = glm::length(b);
    seen.edges.push_back(side * glm::cross(a, b));
    seen.rooms.push_back(2.0 * (EDGE_ROOM * la * lb + ROUNDING * 16.0 * scale * (la + lb)));
  }
  return true;
}

/// Which texels of a row have their whole texel inside of all lines.
struct Row {
  std::int64_t first, end;
};

Row inside_row(std::span<const Line> lines, double v, std::uint32_t resolution) {
  double low = -1.0;
  double high = 1.0;
  for (const Line& line : lines) {
    const double at_0 = line.y * v + line.z;
    if (line.x > 0.0)
      low = std::max(low, -at_0 / line.x);
    else if (line.x < 0.0)
      high = std::min(high, -at_0 / line.x);
    else if (at_0 < 0.0)
      return {0, 0};
  }
  if (!(low <= high)) return {0, 0};
  // Of centres, which lie at (2 i + 1) / resolution - 1. Rounding moves these far less than an edge's room.
  const double scale = 0.5 * resolution;
  return {static_cast<std::int64_t>(std::ceil((low + 1.0) * scale - 0.5)),
          static_cast<std::int64_t>(std::floor((high + 1.0) * scale - 0.5)) + 1};
}

bool overlaps(const ConvexPolygon& polygon, const glm::dvec3& eye, const Face& face) {
  bool out[5] = {true, true, true, true, true};
  for (const glm::dvec3& corner : polygon.corners) {
    const glm::dvec3 p = face.turned(corner - eye);
    const bool beyond[5] = {p.x > p.z, -p.x > p.z, p.y > p.z, -p.y > p.z, p.z <= 0.0};
    for (int i = 0; i < 5; ++i) out[i] = out[i] && beyond[i];
  }
  return std::ranges::none_of(out, [](bool o) { return o; });
}

/// The values that a quotient by something from w_min to w_max takes, within -1 to 1; w_max > 0.
struct Range {
  double low, high;
};
Range over(double low, double high, double w_min, double w_max) {
  const double near = std::max(w_min, std::numeric_limits<double>::min());
  return {std::max(-1.0, low / (low < 0.0 ? near : w_max)), std::min(1.0, high / (high > 0.0 ? near : w_max))};
}

/// The least w at which something from `low` to `high` is seen in these directions; infinite: nowhere.
double least_w(double low, double high, const Range& seen) {
  if (low > 0.0) return seen.high > 0.0 ? low / seen.high : std::numeric_limits<double>::infinity();
  if (high < 0.0) return seen.low < 0.0 ? high / seen.low : std::numeric_limits<double>::infinity();
  return 0.0;
}

}  // namespace

/// Positions are from the light.
struct OcclusionMap::Hull {
  glm::dvec3 min, max;
  double room;              ///< m, that it was widened by, along each axis
  glm::dvec3 corners[3]{};  ///< of a triangle, not widened
  glm::dvec3 plane{0.0};    ///< dot with a direction: at most 1 / distance along it; 0: of no plane
  bool is_triangle = false;

  /// All of it, behind a plane by more than HIDDEN_BEYOND.
  [[nodiscard]] bool is_behind(const glm::dvec3& nearness) const {
    const glm::dvec3 low = glm::min(nearness * min, nearness * max);
    double least = low.x + low.y + low.z;
    if (is_triangle) {
      const glm::dvec3 side = glm::abs(nearness) * room;
      const double nearest =
          std::min({glm::dot(nearness, corners[0]), glm::dot(nearness, corners[1]), glm::dot(nearness, corners[2])});
      least = std::max(least, nearest - side.x - side.y - side.z);
    }
    return least > 1.0 + HIDDEN_BEYOND;
  }
};

OcclusionMap::OcclusionMap(std::uint32_t resolution)
    : resolution_(std::max(resolution, 1U)),
      nearness_(std::size_t{FACES} * resolution_ * resolution_),
      planes_(nearness_.size()) {}

void OcclusionMap::look(const StillOccluders& occluders, const Vec3& position, float range) {
  position_ = position;
  hides_anything_ = false;
  seen_.clear();
  std::ranges::fill(nearness_, 0.0F);
  const glm::dvec3 eye(position_);
  if (!std::isfinite(eye.x + eye.y + eye.z)) return;
  const double least = 0.5 / resolution_;  // what looks smaller than this covers no texel
  occluders.state_->near(eye, range, least, [&](std::uint32_t polygon) { draw(*occluders.state_, polygon); });
}

void OcclusionMap::draw(const StillOccluders::State& occluders, std::uint32_t number) {
  const ConvexPolygon& polygon = occluders.polygons[number];
  const glm::dvec3 eye(position_);
  static thread_local Seen seen;
  static thread_local std::vector<Line> lines;
  if (!see(polygon, eye, seen)) return;
  const auto plane = static_cast<std::uint32_t>(seen_.size());
  const double half = 1.0 / resolution_;
  for (std::uint32_t f = 0; f < FACES; ++f) {
    const Face face(f);
    if (!overlaps(polygon, eye, face)) continue;
    lines.clear();
    for (std::size_t i = 0; i < seen.edges.size(); ++i) {
      Line line = face.turned(seen.edges[i]);
      line.z -= seen.rooms[i];
      lines.push_back(for_whole_texels(line, half));
    }
    const Line nearness = for_whole_texels(face.turned(seen.nearness), half);
    for (std::uint32_t y = 0; y < resolution_; ++y) {
      const double v = (2.0 * y + 1.0) * half - 1.0;
      const Row row = inside_row(lines, v, resolution_);
      const std::int64_t first = std::max<std::int64_t>(row.first, 0);
      const std::int64_t end = std::min<std::int64_t>(row.end, resolution_);
      const std::size_t texels = (std::size_t{f} * resolution_ + y) * resolution_;
      const double at = (nearness.y * v + nearness.z + nearness.x * (half - 1.0)) * (1.0 - FLOAT_DOWN);
      const double step = nearness.x * 2.0 * half * (1.0 - FLOAT_DOWN);
      for (std::int64_t x = first; x < end; ++x) {
        const auto value = static_cast<float>(at + step * static_cast<double>(x));
        if (value <= nearness_[texels + x]) continue;
        nearness_[texels + x] = value;
        planes_[texels + x] = plane;
        hides_anything_ = true;
      }
    }
  }
  if (hides_anything_) seen_.emplace_back(seen.nearness * (1.0 - FLOAT_DOWN));
}

bool OcclusionMap::hides(const DVec3& min, const DVec3& max) const {
  if (!hides_anything_) return false;
  const glm::dvec3 eye(position_);
  const glm::dvec3 low(min);
  const glm::dvec3 high(max);
  const double room = double{shared::ROUND_POSITION} * std::max({largest(eye), largest(low), largest(high)});
  return std::isfinite(room) && hides(Hull{.min = low - eye - room, .max = high - eye + room, .room = room});
}

bool OcclusionMap::hides(std::span<const DVec3> corners) const {
  if (!hides_anything_ || corners.empty()) return false;
  const glm::dvec3 eye(position_);
  glm::dvec3 low(corners[0]);
  glm::dvec3 high = low;
  double size = largest(eye);
  for (const DVec3& corner : corners) {
    const glm::dvec3 p(corner);
    low = glm::min(low, p);
    high = glm::max(high, p);
    size = std::max(size, largest(p));
  }
  if (!std::isfinite(glm::dot(low, glm::dvec3(1.0)) + glm::dot(high, glm::dvec3(1.0)) + size)) return false;
  const double room = double{shared::ROUND_POSITION} * size;
  Hull hull{.min = low - eye - room, .max = high - eye + room, .room = room};
  if (corners.size() == 3) {
    hull.is_triangle = true;
    glm::dvec3(&p)[3] = hull.corners;
    for (int i = 0; i < 3; ++i) p[i] = glm::dvec3(corners[i]) - eye;
    glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    if (length > 0.0) normal /= glm::dot(normal, p[0]) < 0.0 ? -length : length;
    // Of the nearest corner: a triangle that is nearly a line has any normal.
    const double height =
        std::min({glm::dot(normal, p[0]), glm::dot(normal, p[1]), glm::dot(normal, p[2])}) - std::sqrt(3.0) * room;
    if (height > 0.0) hull.plane = normal / height;
  }
  return hides(hull);
}

bool OcclusionMap::hides(const Hull& hull) const {
  const glm::dvec3 gap = glm::max(glm::max(hull.min, -hull.max), glm::dvec3(0.0));
  if (glm::dot(gap, gap) == 0.0) return false;  // the light is in it
  for (std::uint32_t face = 0; face < FACES; ++face)
    if (!face_hides(hull, face)) return false;
  return true;
}

/// Which texels of a face a hull may be seen in, and from which distance along the face's axis on.
struct OcclusionMap::Part {
  glm::dvec3 min, max, plane;
  double half;  // of a texel
  Range u{}, v{};

  [[nodiscard]] std::uint32_t texel(double at) const {
    return static_cast<std::uint32_t>(std::clamp((at + 1.0) / (2.0 * half), 0.0, 1.0 / half - 1.0));
  }
  [[nodiscard]] Range directions(std::uint32_t texel) const {
    return {2.0 * texel * half - 1.0 - EDGE_ROOM, 2.0 * (texel + 1.0) * half - 1.0 + EDGE_ROOM};
  }
  [[nodiscard]] double from(const Range& over_u, const Range& over_v) const {
    const double w = std::max({min.z, 0.0, least_w(min.x, max.x, over_u), least_w(min.y, max.y, over_v)});
    if (plane == glm::dvec3(0.0)) return w;
    const double most = std::max(plane.x * over_u.low, plane.x * over_u.high) +
                        std::max(plane.y * over_v.low, plane.y * over_v.high) + plane.z;
    return most > 0.0 ? std::max(w, 1.0 / most) : std::numeric_limits<double>::infinity();
  }
};

std::optional<OcclusionMap::Part> OcclusionMap::part_in(const Hull& hull, std::uint32_t number) const {
  const Face face(number);
  const glm::dvec3 a = face.turned(hull.min);
  const glm::dvec3 b = face.turned(hull.max);
  Part part{.min = glm::min(a, b), .max = glm::max(a, b), .plane = face.turned(hull.plane), .half = 1.0 / resolution_};
  if (part.max.z <= 0.0) return std::nullopt;
  part.u = over(part.min.x, part.max.x, part.min.z, part.max.z);
  part.v = over(part.min.y, part.max.y, part.min.z, part.max.z);
  if (part.u.low > part.u.high || part.v.low > part.v.high) return std::nullopt;
  return part;
}

bool OcclusionMap::face_hides(const Hull& hull, std::uint32_t number) const {
  const std::optional<Part> found = part_in(hull, number);
  if (!found) return true;  // not seen in this face
  const Part& part = *found;
  std::uint32_t behind = ~0U;  // the plane that the hull was last found to lie behind
  for (std::uint32_t y = part.texel(part.v.low - EDGE_ROOM); y <= part.texel(part.v.high + EDGE_ROOM); ++y) {
    for (std::uint32_t x = part.texel(part.u.low - EDGE_ROOM); x <= part.texel(part.u.high + EDGE_ROOM); ++x) {
      const double w = part.from(part.directions(x), part.directions(y));
      if (w > part.max.z) continue;  // not seen in this texel
      const std::size_t texel = (std::size_t{number} * resolution_ + y) * resolution_ + x;
      if (double{nearness_[texel]} * w > 1.0 + HIDDEN_BEYOND) continue;
      if (nearness_[texel] == 0.0F) return false;
      if (planes_[texel] == behind) continue;
      if (!hull.is_behind(glm::dvec3(seen_[planes_[texel]]))) return false;
      behind = planes_[texel];
    }
  }
  return true;
}

bool OcclusionMap::surely_sees(const DVec3& min, const DVec3& max) const {
  if (!hides_anything_) return true;
  const glm::dvec3 eye(position_);
  const Hull hull{.min = glm::dvec3(min) - eye, .max = glm::dvec3(max) - eye, .room = 0.0};
  for (std::uint32_t face = 0; face < FACES; ++face)
    if (!face_surely_sees(hull, face)) return false;
  return true;
}

/// No texel's distance is less than the farthest that the box is seen at in the face.
bool OcclusionMap::face_surely_sees(const Hull& hull, std::uint32_t number) const {
  const std::optional<Part> part = part_in(hull, number);
  if (!part) return true;
  for (std::uint32_t y = part->texel(part->v.low - EDGE_ROOM); y <= part->texel(part->v.high + EDGE_ROOM); ++y) {
    const float* const row = &nearness_[(std::size_t{number} * resolution_ + y) * resolution_];
    for (std::uint32_t x = part->texel(part->u.low - EDGE_ROOM); x <= part->texel(part->u.high + EDGE_ROOM); ++x)
      if (double{row[x]} * part->max.z > 1.0) return false;
  }
  return true;
}

}  // namespace lamp
