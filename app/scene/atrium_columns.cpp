// The atrium's columns, piers, pilasters and balusters.
// Based on: nothing; the proportions are those of the Attic base and a leafed bell capital.
// Promise: round parts are lathes, drawn by instances.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "scene/atrium.h"
#include "scene/mesh_builder.h"

namespace lamp::app::procedural::atrium {
namespace {

/// Points of a convex half circle of a profile (a torus moulding) from y0 to y1 that bulges outwards.
void add_torus(std::vector<glm::vec2>& profile, float radius, float y0, float y1) {
  const float half = (y1 - y0) / 2.0F;
  for (int i = 0; i <= 6; ++i) {
    const float angle = PI * (static_cast<float>(i) / 6.0F - 0.5F);
    profile.emplace_back(radius + half * std::cos(angle), y0 + half + half * std::sin(angle));
  }
}

/// A leaf of a capital: stands at the bell, bends outwards at its tip; thin at the rim, thicker along the middle.
Geometry capital_leaf(float width, float height, float lean) {
  const auto front = [=](glm::vec2 uv) {
    const float side = uv.x * 2.0F - 1.0F;
    const float taper = 1.0F - 0.75F * uv.y * uv.y;
    const float rise = 1.3F * height * (uv.y - 0.3F * uv.y * uv.y * uv.y);
    return glm::vec3(side * width * 0.5F * taper, rise, lean * uv.y * uv.y - 0.25F * width * side * side);
  };
  const auto back = [=](glm::vec2 uv) {
    const float side = uv.x * 2.0F - 1.0F;
    return front({1.0F - uv.x, uv.y}) - glm::vec3(0, 0, 0.08F * width * (1.0F - side * side));
  };
  Geometry leaf;
  add_grid(leaf, {.columns = 4, .rows = 6, .size_m = {width, height}, .surface = front});
  add_grid(leaf, {.columns = 4, .rows = 6, .size_m = {width, height}, .surface = back});
  return leaf;
}

struct ColumnSize {
  float radius;  ///< of the shaft's foot
  float bottom;  ///< underside of the plinth
  float top;     ///< top of the abacus
};

/// The round parts: base, shaft with entasis, bell and leaves.
Geometry round_column(const ColumnSize& size) {
  const float r = size.radius;
  const float neck = size.top - 2.1F * r;  // where the bell begins
  const float foot = size.bottom + 0.5F * r;
  std::vector<glm::vec2> profile{{1.0F * r, foot - 0.02F}};
  add_torus(profile, 1.22F * r, foot, foot + 0.36F * r);
  profile.emplace_back(1.12F * r, foot + 0.42F * r);
  profile.emplace_back(1.08F * r, foot + 0.52F * r);
  add_torus(profile, 1.10F * r, foot + 0.58F * r, foot + 0.78F * r);
  profile.emplace_back(1.02F * r, foot + 0.84F * r);
  for (int i = 1; i <= 6; ++i) {
    const float t = static_cast<float>(i) / 6.0F;
    profile.emplace_back(r * (1.0F - 0.16F * t * t), std::lerp(foot + 0.9F * r, neck - 0.2F * r, t));
  }
  add_torus(profile, 0.86F * r, neck - 0.16F * r, neck);
  profile.emplace_back(0.84F * r, neck + 0.02F);
  for (int i = 1; i <= 5; ++i) {
    const float t = static_cast<float>(i) / 5.0F;
    profile.emplace_back(r * (0.84F + 0.42F * t * t * t), std::lerp(neck + 0.02F, size.top - 0.3F * r, t));
  }
  Geometry column;
  add_lathe(column, {.profile = profile, .segments = 28, .around_m = 2.0F});
  for (int row = 0; row < 2; ++row) {
    const float height = (row == 0 ? 0.95F : 1.5F) * r;
    const Geometry leaf = capital_leaf(0.62F * r, height, 0.55F * r);
    for (int i = 0; i < 8; ++i) {
      const float turn = (static_cast<float>(i) + 0.5F * static_cast<float>(row)) * PI / 4.0F;
      const glm::vec3 out(std::sin(turn), 0, std::cos(turn));
      append(column, leaf, at(out * (0.95F * r) + glm::vec3(0, neck, 0), turn));
    }
  }
  return column;
}

/// The square parts: plinth and abacus.
Geometry square_parts(const ColumnSize& size) {
  const float r = size.radius;
  const float plinth = 1.5F * r;
  const float abacus = 1.42F * r;
  Geometry parts;
  add_box(parts, {-plinth, size.bottom - 0.02F, -plinth}, {plinth, size.bottom + 0.5F * r, plinth});
  add_box(parts, {-abacus * 0.9F, size.top - 0.32F * r, -abacus * 0.9F},
          {abacus * 0.9F, size.top - 0.15F * r, abacus * 0.9F});
  add_box(parts, {-abacus, size.top - 0.2F * r, -abacus}, {abacus, size.top, abacus});
  return parts;
}

/// A square pier with a base and a cap.
void add_pier(Geometry& geometry, glm::vec3 foot, float half, float top) {
  const auto block = [&](float y0, float y1, float reach) {
    add_box(geometry, {foot.x - reach, y0, foot.z - reach}, {foot.x + reach, y1, foot.z + reach});
  };
  block(foot.y - 0.02F, top, half);
  block(foot.y - 0.03F, foot.y + 0.35F, half + 0.07F);
  block(foot.y + 0.3F, foot.y + 0.42F, half + 0.04F);
}

/// Positions of the columns between the piers of the court's corners.
std::vector<glm::vec2> column_places() {
  std::vector<glm::vec2> places;
  for (const float side : {-1.0F, 1.0F}) {
    for (int i = -3; i <= 3; ++i) places.emplace_back(static_cast<float>(i) * BAY_X, side * COURT.y);
    for (const float half : {-0.5F, 0.5F}) places.emplace_back(side * COURT.x, half * BAY_Z);
  }
  return places;
}

void add_balusters(Scene& scene, const Materials& m) {
  constexpr float FOOT = GALLERY_Y + 0.14F;
  const std::array<glm::vec2, 12> profile{{{0.075F, FOOT},
                                           {0.075F, FOOT + 0.06F},
                                           {0.05F, FOOT + 0.08F},
                                           {0.045F, FOOT + 0.12F},
                                           {0.07F, FOOT + 0.18F},
                                           {0.088F, FOOT + 0.25F},
                                           {0.07F, FOOT + 0.34F},
                                           {0.042F, FOOT + 0.46F},
                                           {0.038F, FOOT + 0.56F},
                                           {0.06F, FOOT + 0.59F},
                                           {0.068F, FOOT + 0.63F},
                                           {0.068F, FOOT + 0.7F}}};
  Geometry baluster;
  add_lathe(baluster, {.profile = profile, .segments = 12, .around_m = 0.5F});
  const std::uint32_t mesh = add_mesh(scene, baluster, m.trim);
  for (const Bay& bay : bays_around(8, 3, COURT)) {
    const float width = bay.along_x ? BAY_X : BAY_Z;
    const int count = bay.along_x ? 10 : 8;
    for (int i = 0; i < count; ++i) {
      const float along = (static_cast<float>(i) - static_cast<float>(count - 1) / 2.0F) * (width - 0.75F) /
                          static_cast<float>(count - 1);
      const glm::vec3 shift = bay.along_x ? glm::vec3(along, 0, 0) : glm::vec3(0, 0, along);
      place(scene, mesh, at(bay.middle + shift, 0.0F));
    }
  }
}

}  // namespace

void add_columns(Scene& scene, const Materials& m) {
  const std::array<ColumnSize, 2> sizes{
      {{.radius = 0.29F, .bottom = AISLE_Y, .top = SPRING_Y}, {.radius = 0.2F, .bottom = 6.6F, .top = UPPER_SPRING_Y}}};
  for (const ColumnSize& size : sizes) {
    const std::uint32_t round = add_mesh(scene, round_column(size), m.column);
    const std::uint32_t square = add_mesh(scene, square_parts(size), m.trim);
    for (const glm::vec2 spot : column_places()) {
      place(scene, round, at(spot.x, 0, spot.y));
      place(scene, square, at(spot.x, 0, spot.y));
    }
  }
  Geometry blocks;
  for (const glm::vec2 spot : column_places()) {  // what the upper columns stand on
    add_box(blocks, {spot.x - 0.32F, GALLERY_Y - 0.02F, spot.y - 0.32F}, {spot.x + 0.32F, 6.56F, spot.y + 0.32F});
    add_box(blocks, {spot.x - 0.36F, 6.5F, spot.y - 0.36F}, {spot.x + 0.36F, 6.6F, spot.y + 0.36F});
  }
  for (const glm::vec2 sign : {glm::vec2(1, 1), glm::vec2(-1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)}) {
    const glm::vec2 corner = sign * COURT;
    add_pier(blocks, {corner.x, AISLE_Y, corner.y}, 0.42F, SLAB_Y + 0.01F);
    add_pier(blocks, {corner.x, GALLERY_Y, corner.y}, 0.36F, EAVES_Y);
  }
  for (const Bay& bay : bays_around(9, 4, OUTER)) {  // pilasters between the outer bays
    const glm::vec3 half = bay.along_x ? glm::vec3(0.25F, 0, 0.3F) : glm::vec3(0.3F, 0, 0.25F);
    add_box(blocks, bay.middle - half + glm::vec3(0, 0.1F, 0), bay.middle + half + glm::vec3(0, SPRING_Y + 0.02F, 0));
    const glm::vec3 upper = half * 0.55F;
    add_box(blocks, bay.middle - upper + glm::vec3(0, 5.5F, 0), bay.middle + upper + glm::vec3(0, EAVES_Y - 0.1F, 0));
  }
  add_once(scene, blocks, m.trim);
  add_balusters(scene, m);
}

}  // namespace lamp::app::procedural::atrium
