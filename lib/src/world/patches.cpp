// Cuts a triangle: a table's patches are tested exactly, and cut again where they are still large for their lights.
// Promise: a position within the slack of the triangle finds a patch whose part of the triangle, as far as twice the
// slack beyond its sides, was tested within the slack.
// SPDX-License-Identifier: Apache-2.0
#include "patches.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace lamp::world {
namespace {

using shared::TRIANGLE_AXIS_BITS;
using shared::TRIANGLE_EXPONENT_BIAS;
using shared::TRIANGLE_FIELD_BITS;
using shared::TRIANGLE_PATCHED;
using shared::TRIANGLE_TABLE_HEAD;

constexpr int MOST_ACROSS = 16;            // patches of a table, along a side
constexpr std::size_t FEW_LIGHTS = 3;      // of a patch that is not worth cutting
constexpr double ROUNDED = 2e-6;           // of a coordinate: transforms and positions in 32 bits
constexpr double LEAST_OVER_SLACK = 32.0;  // a patch's side over the slack: below, its list is its neighbours'
constexpr int LEAST_EXPONENT = -100;
constexpr int MOST_EXPONENT = 100;

double largest_coordinate(const Bounds& box) {
  const glm::dvec3 far = glm::max(glm::abs(box.min), glm::abs(box.max));
  return std::max({far.x, far.y, far.z});
}

/// A square table over a part of a triangle.
struct Table {
  int u = 0;  ///< axes
  int v = 0;
  int exponent = 0;
  float first_u = 0.0F;  ///< whole numbers of patches
  float first_v = 0.0F;
  int across = 0;
  int up = 0;

  [[nodiscard]] double side() const { return std::ldexp(1.0, exponent); }
  [[nodiscard]] std::size_t patches() const { return static_cast<std::size_t>(across) * static_cast<std::size_t>(up); }
  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x);
  }
};

/// The square that a patch is for, seen along the axis; positions beyond it have other patches.
struct Square {
  glm::dvec2 min{-std::numeric_limits<double>::infinity()};
  glm::dvec2 max{std::numeric_limits<double>::infinity()};
};

float whole(double coordinate, int exponent) {
  return static_cast<float>(std::floor(std::ldexp(coordinate, -exponent)));
}

class Cutting {
 public:
  Cutting(const Patching& how, const StillTriangle& triangle, PatchTables& tables)
      : how_(how), tables_(tables), tilt_(triangle.normal_tilt) {
    for (int i = 0; i < 3; ++i)
      whole_.add({glm::dvec3(triangle.corners[i]), glm::dvec3(glm::vec3(triangle.normals[i]))});
    const auto& c = whole_.corners;
    const glm::dvec3 normal = glm::cross(c[1].at - c[0].at, c[2].at - c[0].at);
    const double length = glm::length(normal);
    const glm::dvec3 size = bounds_of(whole_).max - bounds_of(whole_).min;
    const double area_of_box = glm::dot(size, size);
    if (length > 1e-12 * area_of_box && length > 0.0) plane_ = normal / length;
    const glm::dvec3 facing = glm::abs(normal);
    axis_ = facing.x >= facing.y && facing.x >= facing.z ? 0 : facing.y >= facing.z ? 1 : 2;
  }

  void run(std::span<const std::uint32_t> near, std::size_t word) { part(whole_, near, word, {}); }

 private:
  [[nodiscard]] double slack_of(const Bounds& box) const { return how_.slack + ROUNDED * largest_coordinate(box); }

  [[nodiscard]] bool hides(std::uint32_t light, const Polygon& polygon, double slack) const {
    if (how_.hides == nullptr) return false;
    std::array<DVec3, 8 * Polygon::MOST> hull{};
    std::size_t count = 0;
    for (const Corner& corner : polygon.all())
      for (int i = 0; i < 8; ++i)
        hull[count++] = DVec3(corner.at + slack * glm::dvec3(i % 2 * 2 - 1, i / 2 % 2 * 2 - 1, i / 4 * 2 - 1));
    return (*how_.hides)(light, std::span(hull).first(count));
  }

  std::vector<std::uint32_t> lights_of(const Polygon& polygon, std::span<const std::uint32_t> near, double slack) {
    const Bounds box = bounds_of(polygon);
    std::vector<std::uint32_t> list;
    for (const std::uint32_t id : near) {
      const StillLight& light = how_.lights[id];
      if (!may_touch(light, box, slack) || !touches(light, polygon, plane_, slack)) continue;
      if (is_behind(light, polygon, tilt_, slack))
        ++tables_.stats.behind;
      else
        list.push_back(id);
    }
    return list;
  }

  /// 0: not to be cut.
  [[nodiscard]] double wanted_side(std::span<const std::uint32_t> list, double slack) const {
    if (list.size() <= FEW_LIGHTS) return 0.0;
    std::vector<double> ranges;
    for (const std::uint32_t id : list) ranges.push_back(how_.lights[id].range);
    const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
    std::ranges::nth_element(ranges, middle);
    return std::max(how_.patch * *middle, LEAST_OVER_SLACK * slack);
  }

  [[nodiscard]] bool table_for(const Bounds& box, const Square& square, double side, Table& table) const {
    table.u = (axis_ + 1) % 3;
    table.v = (axis_ + 2) % 3;
    const glm::dvec2 min = glm::clamp(glm::dvec2(box.min[table.u], box.min[table.v]), square.min, square.max);
    const glm::dvec2 max = glm::clamp(glm::dvec2(box.max[table.u], box.max[table.v]), square.min, square.max);
    const double size = std::max(max.x - min.x, max.y - min.y);
    if (side <= 0.0 || size <= side) return false;
    const double least = std::max(side, size / (MOST_ACROSS - 1));
    table.exponent = static_cast<int>(std::ceil(std::log2(least)));
    if (table.exponent < LEAST_EXPONENT || table.exponent > MOST_EXPONENT) return false;
    if (table.side() > 0.5 * (square.max.x - square.min.x)) return false;
    table.first_u = whole(min.x, table.exponent);
    table.first_v = whole(min.y, table.exponent);
    table.across = static_cast<int>(whole(max.x, table.exponent) - table.first_u) + 1;
    table.up = static_cast<int>(whole(max.y, table.exponent) - table.first_v) + 1;
    return table.across * table.up > 1;
  }

  [[nodiscard]] static Square square_of(const Table& table, int x, int y) {
    const glm::dvec2 min(glm::dvec2(table.first_u, table.first_v) + glm::dvec2(x, y));
    return {min * table.side(), (min + 1.0) * table.side()};
  }

  [[nodiscard]] static Polygon patch_of(const Polygon& part, const Table& table, const Square& square, double beyond) {
    Polygon patch = cut(part, table.u, -1.0, beyond - square.min.x);
    patch = cut(patch, table.u, 1.0, square.max.x + beyond);
    patch = cut(patch, table.v, -1.0, beyond - square.min.y);
    return cut(patch, table.v, 1.0, square.max.y + beyond);
  }

  void part(const Polygon& polygon, std::span<const std::uint32_t> near, std::size_t word, const Square& square) {
    if (how_.is_too_much()) return;
    if (polygon.count == 0) return leaf(word, {});
    const Bounds box = bounds_of(polygon);
    const double slack = slack_of(box);
    std::vector<std::uint32_t> list = lights_of(polygon, near, slack);
    Table table;
    if (!table_for(box, square, wanted_side(list, slack), table)) {
      // Not before: what a light sees takes long to find out, and of large parts it sees some.
      const std::size_t touching = list.size();
      std::erase_if(list, [&](std::uint32_t id) { return hides(id, polygon, slack); });
      tables_.stats.hidden += touching - list.size();
      return leaf(word, std::move(list));
    }
    fill(table, list, word, 2.0 * slack);
  }

  void leaf(std::size_t word, std::vector<std::uint32_t> list) {
    ++tables_.stats.patches;
    tables_.stats.listed += list.size();
    how_.found(word, std::move(list));
  }

  void fill(const Table& table, std::span<const std::uint32_t> list, std::size_t word, double beyond) {
    std::vector<std::uint32_t>& words = tables_.words;
    ++tables_.stats.tables;
    const std::size_t head = words.size();
    words[word] = TRIANGLE_PATCHED | static_cast<std::uint32_t>(head);
    words.resize(head + TRIANGLE_TABLE_HEAD + table.patches());
    const auto exponent = static_cast<std::uint32_t>(table.exponent + static_cast<int>(TRIANGLE_EXPONENT_BIAS));
    words[head] = static_cast<std::uint32_t>(axis_) | exponent << TRIANGLE_AXIS_BITS |
                  static_cast<std::uint32_t>(table.across) << (TRIANGLE_AXIS_BITS + TRIANGLE_FIELD_BITS) |
                  static_cast<std::uint32_t>(table.up) << (TRIANGLE_AXIS_BITS + 2 * TRIANGLE_FIELD_BITS);
    words[head + 1] = std::bit_cast<std::uint32_t>(table.first_u);
    words[head + 2] = std::bit_cast<std::uint32_t>(table.first_v);
    const std::vector<std::vector<std::uint32_t>> near = spread(table, list, beyond);
    for (int y = 0; y < table.up; ++y)
      for (int x = 0; x < table.across; ++x) {
        const std::size_t at = table.place(x, y);
        const Square square = square_of(table, x, y);
        part(patch_of(whole_, table, square, beyond), near[at], head + TRIANGLE_TABLE_HEAD + at, square);
      }
  }

  /// The lights whose sphere may touch each patch.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> spread(const Table& table, std::span<const std::uint32_t> list,
                                                               double beyond) const {
    std::vector<std::vector<std::uint32_t>> near(table.patches());
    for (const std::uint32_t id : list) {
      const StillLight& light = how_.lights[id];
      const double reach = light.radius + 2.0 * beyond;
      const auto place = [&](double coordinate, float first, int count) {
        return static_cast<int>(std::clamp(std::floor(coordinate / table.side()) - first, 0.0, count - 1.0));
      };
      const int x_end = place(light.center[table.u] + reach, table.first_u, table.across);
      const int y_end = place(light.center[table.v] + reach, table.first_v, table.up);
      for (int y = place(light.center[table.v] - reach, table.first_v, table.up); y <= y_end; ++y)
        for (int x = place(light.center[table.u] - reach, table.first_u, table.across); x <= x_end; ++x)
          near[table.place(x, y)].push_back(id);
    }
    return near;
  }

  const Patching& how_;
  PatchTables& tables_;
  double tilt_;
  Polygon whole_;
  glm::dvec3 plane_{0.0};
  int axis_ = 0;
};

std::uint32_t field(std::uint32_t word, std::uint32_t first, std::uint32_t bits) {
  return word >> first & ((1U << bits) - 1U);
}

/// Which of `count` patches a coordinate is in; beyond them, the nearest.
std::uint32_t patch_at(float coordinate, float scale, float first, std::uint32_t count) {
  const float at = std::floor(coordinate * scale) - first;
  return at > 0.0F ? static_cast<std::uint32_t>(std::min(at, static_cast<float>(count - 1))) : 0;
}

}  // namespace

void make_patches(const Patching& how, const StillTriangle& triangle, std::span<const std::uint32_t> near,
                  std::size_t word, PatchTables& tables) {
  Cutting(how, triangle, tables).run(near, word);
}

std::uint32_t list_name(std::span<const std::uint32_t> words, std::uint32_t word, const Vec3& position) {
  const std::array<float, 5> at{position.x, position.y, position.z, position.x, position.y};
  while ((word & TRIANGLE_PATCHED) != 0) {
    const auto table = words.subspan(word & ~TRIANGLE_PATCHED);
    const std::uint32_t axis = field(table[0], 0, TRIANGLE_AXIS_BITS);
    const int exponent = static_cast<int>(field(table[0], TRIANGLE_AXIS_BITS, TRIANGLE_FIELD_BITS)) -
                         static_cast<int>(TRIANGLE_EXPONENT_BIAS);
    const std::uint32_t across = field(table[0], TRIANGLE_AXIS_BITS + TRIANGLE_FIELD_BITS, TRIANGLE_FIELD_BITS);
    const std::uint32_t up = field(table[0], TRIANGLE_AXIS_BITS + 2 * TRIANGLE_FIELD_BITS, TRIANGLE_FIELD_BITS);
    const float scale = std::ldexp(1.0F, -exponent);
    const std::uint32_t x = patch_at(at[axis + 1], scale, std::bit_cast<float>(table[1]), across);
    const std::uint32_t y = patch_at(at[axis + 2], scale, std::bit_cast<float>(table[2]), up);
    word = table[TRIANGLE_TABLE_HEAD + y * across + x];
  }
  return word;
}

}  // namespace lamp::world
