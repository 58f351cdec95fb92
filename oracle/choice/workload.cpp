// Estimates how many lights tiles and pixels meet: a sample of tiles against all lights, or a sample of them.
// Based on: stratified sampling; the lights of the largest ranges are all in, because few of them make most pairs.
// Promise: deterministic; the time is bounded whatever the number of lights.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "methods/lamplight_cells.h"
#include "oracle/choose.h"
#include "oracle/reference.h"

namespace lamp {
namespace {

constexpr std::size_t MOST_LIGHTS = 16384;  // looked at
constexpr std::size_t LARGEST = 1024;       // of those: the ones with the largest ranges
constexpr std::uint32_t TILES_X = 16;
constexpr std::uint32_t TILES_Y = 9;
constexpr std::uint32_t SAMPLES_A_SIDE = 3;  // pixels of a tile
constexpr double LIST_PLACES = 512.0;        // of a tiled list
constexpr double HALF_RIGHT_ANGLE = 0.785398163;

/// A light that stands for `weight` lights: its volume's bounding sphere, view space with z ahead.
struct Sphere {
  glm::dvec3 center{0.0};
  double radius = 0.0;
  double weight = 1.0;
  const shared::Light* light = nullptr;
};

Sphere sphere_of(const View& view, const shared::Light& light) {
  glm::dvec3 center(light.position);
  const bool everywhere = light.range >= shared::INFINITE_RADIUS;
  double radius = everywhere ? std::numeric_limits<double>::infinity() : light.range;
  if (light.type == shared::LIGHT_SPOT && !everywhere) {
    const bool narrow = light.outer_angle <= HALF_RIGHT_ANGLE;
    const double along = narrow ? radius / (2.0 * light.cos_outer) : radius * light.cos_outer;
    radius = narrow ? along : radius * light.sin_outer;
    center += along * glm::dvec3(light.direction);
  }
  const glm::dvec3 seen(glm::dmat4(view.view_from_world()) * glm::dvec4(center, 1.0));
  return {.center = {seen.x, seen.y, -seen.z}, .radius = radius, .light = &light};
}

std::vector<Sphere> sampled(const View& view, std::span<const shared::Light> lights) {
  std::vector<std::uint32_t> order(lights.size());
  std::iota(order.begin(), order.end(), 0U);
  std::size_t exact = lights.size();
  if (lights.size() > MOST_LIGHTS) {
    exact = LARGEST;
    std::ranges::nth_element(order, order.begin() + LARGEST, [&](std::uint32_t a, std::uint32_t b) {
      return lights[a].range > lights[b].range || (lights[a].range == lights[b].range && a < b);
    });
    std::sort(order.begin() + LARGEST, order.end());
  }
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < exact; ++i) spheres.push_back(sphere_of(view, lights[order[i]]));
  const std::size_t rest = lights.size() - exact;
  const std::size_t taken = rest == 0 ? 0 : MOST_LIGHTS - LARGEST;
  for (std::size_t i = 0; i < taken; ++i) {
    spheres.push_back(sphere_of(view, lights[order[exact + i * rest / taken]]));
    spheres.back().weight = static_cast<double>(rest) / static_cast<double>(taken);
  }
  const double eye = view.orthographic() ? -std::numeric_limits<double>::infinity() : 0.0;  // nothing is seen behind it
  std::erase_if(spheres, [&](const Sphere& s) { return !(s.radius > 0.0) || s.center.z + s.radius <= eye; });
  return spheres;
}

glm::dvec3 ahead(const View& view, glm::dvec2 pixel, double z) {
  const glm::dvec3 position = view.view_position(pixel, z);
  return {position.x, position.y, -position.z};
}

struct Pixel {
  glm::dvec3 view{0.0};  // z ahead
  glm::dvec3 world{0.0};
  double reach = 0.0;  // how far the part of the tile reaches that it stands for, m
};

/// A sampled tile: four planes that its column lies inside of, and pixels.
struct Tile {
  std::array<glm::dvec4, 4> planes{};  // outwards
  std::vector<Pixel> pixels;           // without sky
  std::size_t sampled = 0;             // with it
  double near_z = std::numeric_limits<double>::infinity();
  double far_z = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool column_touches(const Sphere& s) const {
    return std::ranges::all_of(
        planes, [&](const glm::dvec4& p) { return glm::dot(glm::dvec3(p), s.center) + p.w <= s.radius; });
  }
};

struct Rectangle {
  std::uint32_t x0, y0, x1, y1;
};

void add_planes(Tile& tile, const View& view, const Rectangle& r) {
  const std::array<glm::dvec2, 4> corners{{{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}};
  const glm::dvec3 middle = ahead(view, 0.5 * (corners[0] + corners[2]), 1.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 a = ahead(view, corners[i], 1.0);
    glm::dvec3 normal =
        glm::normalize(glm::cross(ahead(view, corners[(i + 1) % 4], 1.0) - a, ahead(view, corners[i], 2.0) - a));
    if (glm::dot(normal, middle - a) > 0.0) normal = -normal;
    tile.planes[i] = glm::dvec4(normal, -glm::dot(normal, a));
  }
}

void add_pixel(Tile& tile, const View& view, glm::uvec2 at, double z) {
  const glm::dvec2 center = glm::dvec2(at) + 0.5;
  Pixel pixel{.view = ahead(view, center, z)};
  pixel.world =
      glm::dvec3(glm::dmat4(view.world_from_view()) * glm::dvec4(glm::dvec3(view.view_position(center, z)), 1.0));
  tile.near_z = std::min(tile.near_z, z);
  tile.far_z = std::max(tile.far_z, z);
  tile.pixels.push_back(pixel);
}

Tile tile_of(const View& view, std::span<const float> depth, std::uint32_t px, glm::uvec2 at) {
  const Rectangle r{at.x * px, at.y * px, std::min((at.x + 1) * px, view.width()),
                    std::min((at.y + 1) * px, view.height())};
  Tile tile;
  add_planes(tile, view, r);
  for (std::uint32_t j = 0; j < SAMPLES_A_SIDE; ++j) {
    for (std::uint32_t i = 0; i < SAMPLES_A_SIDE; ++i) {
      const glm::uvec2 pixel(r.x0 + (2 * i + 1) * (r.x1 - r.x0) / (2 * SAMPLES_A_SIDE),
                             r.y0 + (2 * j + 1) * (r.y1 - r.y0) / (2 * SAMPLES_A_SIDE));
      ++tile.sampled;
      // Without depth: surfaces from 1 m to 100 m, each nine tenths nearer than the next but one.
      const double guess = std::pow(10.0, 2.0 * (j * SAMPLES_A_SIDE + i) / (SAMPLES_A_SIDE * SAMPLES_A_SIDE - 1.0));
      const float d = depth.empty() ? 0.5F : depth[std::size_t{pixel.y} * view.width() + pixel.x];
      if (d != view.sky_depth()) add_pixel(tile, view, pixel, depth.empty() ? guess : view.z_view(d));
    }
  }
  for (Pixel& pixel : tile.pixels) {
    const double z = pixel.view.z;
    pixel.reach = glm::length(ahead(view, {r.x1, r.y1}, z) - ahead(view, {r.x0, r.y0}, z)) / (2.0 * SAMPLES_A_SIDE);
  }
  return tile;
}

/// Whether the light reaches a pixel, or what is within `slack` metres of it.
bool reaches(const Sphere& s, const Pixel& pixel, double slack) {
  if (glm::length(s.center - pixel.view) > s.radius + slack) return false;
  if (slack == 0.0) return reach(*s.light, pixel.world) == Reach::inside;
  const glm::dvec3 away = pixel.world - glm::dvec3(s.light->position);
  const double distance = glm::length(away);
  if (s.light->range < shared::INFINITE_RADIUS && distance > s.light->range + slack) return false;
  if (s.light->type != shared::LIGHT_SPOT) return true;
  const double along = glm::dot(away, glm::dvec3(s.light->direction));
  const double across = std::sqrt(std::max(0.0, distance * distance - along * along));
  return across * s.light->cos_outer - along * s.light->sin_outer <= slack;
}

/// Sums over sampled tiles.
struct Sums {
  TileLoad load;
  double reached = 0.0;
  std::size_t tiles = 0;
};

void add_tile(Sums& sums, const Tile& tile, std::span<const Sphere> spheres, double all_lights) {
  TileLoad load;
  double reached = 0.0;
  for (const Sphere& s : spheres) {
    if (!tile.column_touches(s)) continue;
    load.column += s.weight;
    if (s.center.z + s.radius < tile.near_z || s.center.z - s.radius > tile.far_z) continue;
    load.interval += s.weight;
    bool exact = false;
    for (const Pixel& pixel : tile.pixels) {
      const double share = s.weight / static_cast<double>(tile.sampled);
      if (std::abs(s.center.z - pixel.view.z) <= s.radius) load.slab += share;
      if (!reaches(s, pixel, pixel.reach)) continue;
      exact = true;
      if (reaches(s, pixel, 0.0)) reached += share;
    }
    if (exact) load.exact += s.weight;
  }
  sums.load.column += load.column;
  sums.load.interval += load.interval;
  sums.load.walked += load.interval > LIST_PLACES ? all_lights : load.interval;
  sums.load.slab += load.slab;
  sums.load.exact += load.exact;
  sums.reached += reached;
  ++sums.tiles;
}

Sums sums_of(const View& view, std::span<const float> depth, std::uint32_t px, std::span<const Sphere> spheres,
             double all_lights) {
  const glm::uvec2 tiles((view.width() + px - 1) / px, (view.height() + px - 1) / px);
  const glm::uvec2 wanted = glm::min(tiles, glm::uvec2(TILES_X, TILES_Y));
  Sums sums;
  for (std::uint32_t j = 0; j < wanted.y; ++j) {
    for (std::uint32_t i = 0; i < wanted.x; ++i) {
      const glm::uvec2 at((2 * i + 1) * tiles.x / (2 * wanted.x), (2 * j + 1) * tiles.y / (2 * wanted.y));
      add_tile(sums, tile_of(view, depth, px, at), spheres, all_lights);
    }
  }
  const auto count = static_cast<double>(sums.tiles);
  for (double TileLoad::* const value :
       {&TileLoad::column, &TileLoad::interval, &TileLoad::walked, &TileLoad::slab, &TileLoad::exact})
    sums.load.*value /= count;
  sums.reached /= count;
  return sums;
}

// What `lamplight` does with its cells, each a square of tiles.
void add_cells(TileLoad& load, const View& view, std::span<const float> depth, std::uint32_t tile_px,
               std::span<const Sphere> spheres, std::size_t lights) {
  const auto capacity = static_cast<std::uint32_t>(lights);
  const std::uint32_t tiles = lamplight::cell_tiles(view.width(), view.height(), tile_px, capacity);
  const std::uint32_t px = tile_px * tiles;
  const std::uint64_t count = ((view.width() + px - 1ULL) / px) * ((view.height() + px - 1ULL) / px);
  const TileLoad met = sums_of(view, depth, px, spheres, static_cast<double>(lights)).load;
  const double share = static_cast<double>(count) / std::max(1.0, static_cast<double>(lights));
  load.cells = met.column * share;
  load.entries = met.interval * share;
  load.tested = load.entries * tiles * tiles;
}

}  // namespace

Workload estimate_workload(const View& view, std::span<const float> depth, std::span<const shared::Light> lights) {
  const std::vector<Sphere> spheres = sampled(view, lights);
  const auto all = static_cast<double>(lights.size());
  Sums fine = sums_of(view, depth, 8, spheres, all);
  Sums coarse = sums_of(view, depth, 16, spheres, all);
  add_cells(fine.load, view, depth, 8, spheres, lights.size());
  add_cells(coarse.load, view, depth, 16, spheres, lights.size());
  return {.width = view.width(),
          .height = view.height(),
          .lights = static_cast<std::uint32_t>(lights.size()),
          .capacity = static_cast<std::uint32_t>(lights.size()),
          .reached = 0.5 * (fine.reached + coarse.reached),
          .tile8 = fine.load,
          .tile16 = coarse.load};
}

}  // namespace lamp
