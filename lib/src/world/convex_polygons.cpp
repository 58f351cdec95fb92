// Pairs of polygons are merged along their longest common edges first, so that triangles become quads and quads walls.
// SPDX-License-Identifier: Apache-2.0
#include "convex_polygons.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace lamp::world {
namespace {

using Loop = std::vector<std::uint32_t>;  // points

constexpr double FLAT = 1e-6;             // of a polygon's size: how far triangles may lie off its plane
constexpr double MOST_TILT = 1e-3;        // of a triangle against its polygon
constexpr double STRAIGHT = 1e-6;         // sine of a corner that may bend inwards, all the same convex enough
constexpr double IN_A_LINE = 1e-12;       // sine of a corner that is left out in the end
constexpr double LEAST_ALTITUDE = 1e-9;   // of a triangle, of its longest side
constexpr std::size_t MOST_CORNERS = 64;  // of a polygon while it grows
constexpr int ROUNDS = 8;

struct PointHash {
  std::size_t operator()(const glm::dvec3& p) const {
    std::size_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = (hash ^ std::hash<double>{}(p[i])) * 0x9e3779b97f4a7c15ULL;
    return hash;
  }
};

struct Growing {
  Loop loop;  // empty: merged into another
  std::vector<std::array<std::uint32_t, 3>> triangles;
  glm::dvec3 normal{0.0};
  double offset = 0.0;
  double thickness = 0.0;
  double tilt = 0.0;
};

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }

class Merging {
 public:
  explicit Merging(std::span<const OccluderTriangle> triangles) {
    for (const OccluderTriangle& triangle : triangles) add(triangle);
    into_.resize(polygons_.size());
    std::iota(into_.begin(), into_.end(), 0U);
  }

  MergedTriangles run() {
    const std::vector<std::uint64_t> edges = shared_edges();
    for (int round = 0; round < ROUNDS; ++round) {
      bool any = false;
      for (const std::uint64_t edge : edges) any = merge_along(edge) || any;
      if (!any) break;
    }
    MergedTriangles merged{.left_out = left_out_};
    for (const Growing& polygon : polygons_)
      if (!polygon.loop.empty()) merged.polygons.push_back(finished(polygon));
    return merged;
  }

 private:
  std::uint32_t number_of(const DVec3& corner) {
    const glm::dvec3 p = glm::dvec3(corner) + 0.0;  // -0 is 0
    const auto [found, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return found->second;
  }

  void add(const OccluderTriangle& triangle) {
    const glm::dvec3 a(triangle[0]);
    const glm::dvec3 b(triangle[1]);
    const glm::dvec3 c(triangle[2]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double area = glm::length(cross);
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const bool is_finite = std::isfinite(area) && std::isfinite(longest);
    if (!is_finite || area <= LEAST_ALTITUDE * longest * longest) {
      ++left_out_;
      return;
    }
    const std::array<std::uint32_t, 3> corners{number_of(triangle[0]), number_of(triangle[1]), number_of(triangle[2])};
    const auto id = static_cast<std::uint32_t>(polygons_.size());
    for (int i = 0; i < 3; ++i) {
      const auto [found, is_new] = owners_.try_emplace(edge_key(corners[i], corners[(i + 1) % 3]), id);
      if (!is_new) found->second = NOBODY;  // of several triangles: merged along by none
    }
    const glm::dvec3 normal = cross / area;
    polygons_.push_back({.loop = {corners.begin(), corners.end()},
                         .triangles = {corners},
                         .normal = normal,
                         .offset = glm::dot(normal, a)});
  }

  /// Once each, longest first.
  [[nodiscard]] std::vector<std::uint64_t> shared_edges() const {
    std::vector<std::pair<double, std::uint64_t>> edges;
    for (const auto& [key, owner] : owners_) {
      const auto from = static_cast<std::uint32_t>(key >> 32);
      const auto to = static_cast<std::uint32_t>(key);
      if (owner == NOBODY || from > to) continue;
      const auto other = owners_.find(edge_key(to, from));
      if (other == owners_.end() || other->second == NOBODY) continue;
      edges.emplace_back(-glm::distance(points_[from], points_[to]), key);
    }
    std::ranges::sort(edges);
    std::vector<std::uint64_t> keys;
    keys.reserve(edges.size());
    for (const auto& edge : edges) keys.push_back(edge.second);
    return keys;
  }

  std::uint32_t find(std::uint32_t polygon) {
    while (into_[polygon] != polygon) polygon = into_[polygon] = into_[into_[polygon]];
    return polygon;
  }

  bool merge_along(std::uint64_t edge) {
    auto from = static_cast<std::uint32_t>(edge >> 32);
    auto to = static_cast<std::uint32_t>(edge);
    std::uint32_t a = find(owners_.at(edge));
    std::uint32_t b = find(owners_.at(edge_key(to, from)));
    if (a == b) return false;
    if (polygons_[a].triangles.size() < polygons_[b].triangles.size()) {
      std::swap(a, b);
      std::swap(from, to);
    }
    Growing& large = polygons_[a];
    Growing& small = polygons_[b];
    const std::optional<std::pair<double, double>> off = off_plane(large, small);
    if (!off) return false;
    const Loop loop = joined(large.loop, small.loop, from, to);
    if (loop.size() < 3 || loop.size() > MOST_CORNERS || !is_convex(loop, large.normal)) return false;
    large.loop = loop;
    large.thickness = std::max(large.thickness, off->first);
    large.tilt = std::max(large.tilt, off->second);
    large.triangles.insert(large.triangles.end(), small.triangles.begin(), small.triangles.end());
    small = {};
    into_[b] = a;
    return true;
  }

  /// How far the triangles of one lie off the plane of the other, and how much they are tilted; nothing: too much.
  [[nodiscard]] std::optional<std::pair<double, double>> off_plane(const Growing& plane, const Growing& of) const {
    const double size = glm::distance(points_[plane.loop[0]], points_[plane.loop[1]]);
    double thickness = 0.0;
    double tilt = 0.0;
    for (const auto& [i, j, k] : of.triangles) {
      for (const std::uint32_t point : {i, j, k})
        thickness = std::max(thickness, std::abs(glm::dot(plane.normal, points_[point]) - plane.offset));
      const glm::dvec3 normal = glm::normalize(glm::cross(points_[j] - points_[i], points_[k] - points_[i]));
      tilt = std::max(tilt, glm::distance(normal, plane.normal));
      if (thickness > FLAT * size || tilt > MOST_TILT) return std::nullopt;
    }
    return std::pair(thickness, tilt);
  }

  /// Both loops, without the way that they go to and fro.
  [[nodiscard]] static Loop joined(const Loop& a, const Loop& b, std::uint32_t from, std::uint32_t to) {
    Loop loop;
    const auto add_from = [&](const Loop& of, std::uint32_t first) {
      const auto start = static_cast<std::size_t>(std::ranges::find(of, first) - of.begin());
      for (std::size_t i = 0; i + 1 < of.size(); ++i) loop.push_back(of[(start + i) % of.size()]);
    };
    add_from(a, to);    // up to before `from`
    add_from(b, from);  // up to before `to`
    for (std::size_t i = 0; i < loop.size() && loop.size() >= 3;) {
      const std::size_t n = loop.size();
      if (loop[(i + n - 1) % n] != loop[(i + 1) % n]) {
        ++i;
        continue;
      }
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i % loop.size()));
      i = i > 1 ? i - 2 : 0;
    }
    return loop;
  }

  /// Sine of the corner's turn to the left, as seen against the normal.
  [[nodiscard]] double turn(const Loop& loop, std::size_t i, const glm::dvec3& normal) const {
    const std::size_t n = loop.size();
    const glm::dvec3 before = points_[loop[i]] - points_[loop[(i + n - 1) % n]];
    const glm::dvec3 behind = points_[loop[(i + 1) % n]] - points_[loop[i]];
    return glm::dot(normal, glm::cross(before, behind)) / (glm::length(before) * glm::length(behind));
  }

  [[nodiscard]] bool is_convex(const Loop& loop, const glm::dvec3& normal) const {
    Loop sorted = loop;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) return false;
    double around = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double sine = turn(loop, i, normal);
      if (!(sine >= -STRAIGHT)) return false;
      const std::size_t n = loop.size();
      const double cosine = glm::dot(glm::normalize(points_[loop[i]] - points_[loop[(i + n - 1) % n]]),
                                     glm::normalize(points_[loop[(i + 1) % n]] - points_[loop[i]]));
      around += std::atan2(sine, cosine);
    }
    return around < 6.5;  // once around: 2 pi
  }

  [[nodiscard]] ConvexPolygon finished(const Growing& polygon) const {
    ConvexPolygon done{
        .normal = polygon.normal, .offset = polygon.offset, .thickness = polygon.thickness, .tilt = polygon.tilt};
    Loop loop = polygon.loop;
    for (std::size_t i = 0; i < loop.size() && loop.size() > 3;)
      if (std::abs(turn(loop, i, polygon.normal)) <= IN_A_LINE)
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      else
        ++i;
    for (const std::uint32_t point : loop) done.corners.push_back(points_[point]);
    return done;
  }

  static constexpr std::uint32_t NOBODY = ~0U;
  std::vector<glm::dvec3> points_;
  std::unordered_map<glm::dvec3, std::uint32_t, PointHash> numbers_;
  std::unordered_map<std::uint64_t, std::uint32_t> owners_;  // of directed edges
  std::vector<Growing> polygons_;
  std::vector<std::uint32_t> into_;  // which polygon one was merged into; itself
  std::size_t left_out_ = 0;
};

}  // namespace

MergedTriangles merge_triangles(std::span<const OccluderTriangle> triangles) { return Merging(triangles).run(); }

}  // namespace lamp::world
