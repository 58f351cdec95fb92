// The atrium's building: floors, arcades, vaults, outer walls, gallery and roof.
// Based on: nothing; groin vaults are two crossing barrels, built as four patches that meet in the groins.
// Promise: parts interpenetrate rather than touch, so that no two visible faces share a plane.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "scene/atrium.h"
#include "scene/mesh_builder.h"

namespace lamp::app::procedural::atrium {
namespace {

/// A frame of constant height that reaches `in` and `out` metres from a rectangle.
void add_band(Geometry& geometry, glm::vec2 half, glm::vec2 in_out, float y0, float y1) {
  add_frame(geometry, {half - in_out.x, half + in_out.y, glm::vec2(y0), glm::vec2(y1)});
}

void add_floors(Scene& scene, const Materials& m) {
  const glm::vec2 court = COURT - 0.5F;
  Geometry floor;
  add_quad(floor, {-court.x, 0, court.y}, {court.x, 0, court.y}, {court.x, 0, -court.y}, {-court.x, 0, -court.y});
  add_once(scene, floor, m.court_floor);
  Geometry aisle;
  add_frame(aisle, {COURT + 0.35F, OUTER + 0.2F, glm::vec2(-0.2F), glm::vec2(AISLE_Y)});
  add_once(scene, aisle, m.aisle_floor);
  Geometry edge;  // the step the columns stand on, a little above the aisle's tiles
  add_band(edge, COURT, {0.5F, 0.4F}, -0.2F, AISLE_Y + 0.01F);
  add_once(scene, edge, m.trim);
}

void add_vaults(Scene& scene, const Materials& m) {
  constexpr float RISE = 1.6F;
  Geometry vault;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const glm::mat2 turn = std::array{glm::mat2(1, 0, 0, 1), glm::mat2(0, 1, -1, 0), glm::mat2(-1, 0, 0, -1),
                                      glm::mat2(0, -1, 1, 0)}[static_cast<std::size_t>(quarter)];
    add_grid(vault, {.columns = 14, .rows = 6, .size_m = {3.0F, 1.5F}, .surface = [turn](glm::vec2 uv) {
                       const float across = uv.y * std::sin((uv.x - 0.5F) * PI);
                       const glm::vec2 p = turn * glm::vec2(across, uv.y);
                       const float y = SPRING_Y + RISE * std::sqrt(std::max(0.0F, 1.0F - across * across));
                       return glm::vec3(p.x * BAY_X / 2.0F, y, p.y * BAY_Z / 2.0F);
                     }});
  }
  const std::uint32_t mesh = add_mesh(scene, vault, m.plaster);
  for (const Bay& bay : bays_around(8, 5, OUTER - glm::vec2(BAY_X, BAY_Z) / 2.0F)) {
    place(scene, mesh, at(bay.middle.x, bay.middle.y, bay.middle.z));
  }
  Geometry rib_z;  // across the long aisles, and across the short ones
  add_arch_ring(rib_z, {.inner = 1.1F, .outer = 1.6F, .depth = 0.36F, .spring = SPRING_Y, .segments = 18});
  Geometry rib_x;
  add_arch_ring(rib_x, {.inner = 1.3F, .outer = 1.65F, .depth = 0.36F, .spring = SPRING_Y, .segments = 18});
  const std::uint32_t across_z = add_mesh(scene, rib_z, m.trim);
  const std::uint32_t across_x = add_mesh(scene, rib_x, m.trim);
  for (const float side : {-1.0F, 1.0F}) {
    const float z = side * (COURT.y + BAY_Z / 2.0F);
    const float x = side * (COURT.x + BAY_X / 2.0F);
    for (int i = -4; i <= 4; ++i) place(scene, across_z, at({static_cast<float>(i) * BAY_X, 0, z}, PI / 2.0F));
    for (int i = -1; i <= 2; ++i) place(scene, across_x, at(x, 0, (static_cast<float>(i) - 0.5F) * BAY_Z));
  }
}

constexpr float ARCH_RADIUS_X = 1.3F;
constexpr float ARCH_RADIUS_Z = 1.1F;

/// One storey of the arcade around the court: walls above the columns, with a ring of voussoirs in every arch.
struct Storey {
  float spring, top, depth;
};

void add_arcade(Scene& scene, const Materials& m, const Storey& storey) {
  for (const bool along_x : {true, false}) {
    const float radius = along_x ? ARCH_RADIUS_X : ARCH_RADIUS_Z;
    Geometry wall;
    add_arch_wall(wall, {.width = along_x ? BAY_X : BAY_Z,
                         .depth = storey.depth,
                         .bottom = storey.spring - 0.02F,
                         .top = storey.top,
                         .spring = storey.spring,
                         .radius = radius,
                         .segments = 28});
    Geometry ring;
    add_arch_ring(ring, {.inner = radius - 0.04F,
                         .outer = radius + 0.2F,
                         .depth = storey.depth + 0.1F,
                         .spring = storey.spring - 0.01F,
                         .segments = 28});
    Geometry keystone;
    const std::array<glm::vec2, 4> wedge{{{-0.1F, storey.spring + radius - 0.1F},
                                          {0.1F, storey.spring + radius - 0.1F},
                                          {0.15F, storey.spring + radius + 0.3F},
                                          {-0.15F, storey.spring + radius + 0.3F}}};
    add_prism(keystone, wedge, -storey.depth / 2.0F - 0.1F, storey.depth / 2.0F + 0.1F);
    append(ring, keystone, at(0, 0, 0));
    const std::uint32_t wall_mesh = add_mesh(scene, wall, m.wall);
    const std::uint32_t ring_mesh = add_mesh(scene, ring, m.trim);
    for (const Bay& bay : bays_around(8, 3, COURT)) {
      if (bay.along_x != along_x) continue;
      place(scene, wall_mesh, at(bay.middle, bay.turn));
      place(scene, ring_mesh, at(bay.middle, bay.turn));
    }
  }
}

/// The outer walls: arched niches below, windows above, and what closes them.
void add_outer_walls(Scene& scene, const Materials& m) {
  constexpr float THICK = 0.4F;
  const std::array<ArchWall, 2> storeys{
      {{.depth = THICK, .bottom = AISLE_Y - 0.1F, .top = SLAB_Y + 0.1F, .spring = 2.3F, .radius = 0.85F},
       {.depth = THICK, .bottom = 6.58F, .top = EAVES_Y + 0.1F, .spring = 8.1F, .radius = 0.7F}}};
  const glm::vec2 middle = OUTER + THICK / 2.0F;
  for (const bool along_x : {true, false}) {
    for (ArchWall storey : storeys) {
      storey.width = along_x ? BAY_X : BAY_Z;
      Geometry wall;
      add_arch_wall(wall, storey);
      const std::uint32_t wall_mesh = add_mesh(scene, wall, storey.bottom < 1.0F ? m.wall : m.plaster);
      Geometry ring;
      add_arch_ring(ring, {.inner = storey.radius - 0.03F,
                           .outer = storey.radius + 0.16F,
                           .depth = THICK + 0.1F,
                           .spring = storey.spring});
      const std::uint32_t ring_mesh = add_mesh(scene, ring, m.trim);
      for (const Bay& bay : bays_around(10, 5, middle)) {
        if (bay.along_x != along_x) continue;
        place(scene, wall_mesh, at(bay.middle, bay.turn));
        place(scene, ring_mesh, at(bay.middle, bay.turn));
      }
    }
  }
  Geometry backs;
  add_frame(backs, {OUTER + THICK, OUTER + THICK + 0.2F, glm::vec2(-0.2F), glm::vec2(SLAB_Y + 0.2F)});
  add_once(scene, backs, m.plaster);
  Geometry bands;
  add_band(bands, OUTER, {0.05F, THICK + 0.1F}, GALLERY_Y - 0.2F, 6.6F);
  add_band(bands, OUTER, {0.06F, THICK + 0.1F}, EAVES_Y - 0.25F, 11.9F);
  add_band(bands, OUTER, {0.08F, 0.1F}, SPRING_Y - 0.12F, SPRING_Y + 0.04F);
  for (const glm::vec2 sign : {glm::vec2(1, 1), glm::vec2(-1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)}) {
    const glm::vec2 corner = sign * (OUTER + 0.15F);
    add_box(bands, {corner.x - 0.3F, -0.2F, corner.y - 0.3F}, {corner.x + 0.3F, EAVES_Y + 0.3F, corner.y + 0.3F});
  }
  add_once(scene, bands, m.trim);
}

void add_gallery(Scene& scene, const Materials& m) {
  Geometry slab;
  add_frame(slab, {COURT + 0.3F, OUTER + 0.2F, glm::vec2(SLAB_Y), glm::vec2(GALLERY_Y)});
  add_once(scene, slab, m.aisle_floor);
  Geometry trim;
  add_band(trim, COURT, {0.34F, 0.4F}, SLAB_Y - 0.04F, SLAB_Y + 0.09F);
  add_band(trim, COURT, {0.40F, 0.41F}, SLAB_Y + 0.05F, SLAB_Y + 0.18F);
  add_band(trim, COURT, {0.50F, 0.42F}, SLAB_Y + 0.14F, GALLERY_Y + 0.02F);
  add_band(trim, COURT, {0.14F, 0.14F}, GALLERY_Y, GALLERY_Y + 0.16F);
  add_band(trim, COURT, {0.13F, 0.13F}, GALLERY_Y + 0.82F, GALLERY_Y + 0.90F);
  add_band(trim, COURT, {0.16F, 0.16F}, GALLERY_Y + 0.88F, GALLERY_Y + 0.98F);
  add_band(trim, COURT, {0.34F, 0.3F}, EAVES_Y - 0.15F, EAVES_Y + 0.02F);
  add_band(trim, COURT, {0.44F, 0.32F}, EAVES_Y - 0.02F, EAVES_Y + 0.3F);
  add_once(scene, trim, m.trim);
}

void add_roof(Scene& scene, const Materials& m) {
  Geometry ceiling;
  add_frame(ceiling, {COURT + 0.1F, OUTER + 0.2F, glm::vec2(EAVES_Y - 0.01F), glm::vec2(EAVES_Y + 0.05F)});
  add_once(scene, ceiling, m.wood);
  Geometry roof;
  add_frame(roof, {COURT - 0.75F, OUTER + 0.3F, {EAVES_Y + 0.2F, 11.45F}, {EAVES_Y + 0.32F, 11.6F}});
  add_once(scene, roof, m.roof);
  Geometry beams;
  for (const float side : {-1.0F, 1.0F}) {
    for (int i = -9; i <= 9; ++i) {  // under the gallery's ceiling
      const float x = static_cast<float>(i) * BAY_X / 2.0F + 0.4F;
      const float z = side * (COURT.y + BAY_Z / 2.0F);
      add_box(beams, {x - 0.1F, EAVES_Y - 0.24F, z - 1.3F}, {x + 0.1F, EAVES_Y, z + 1.5F});
    }
    for (int i = -2; i <= 2; ++i) {
      const float x = side * (COURT.x + BAY_X / 2.0F);
      const float z = static_cast<float>(i) * BAY_Z / 2.0F;
      add_box(beams, {x - 1.5F, EAVES_Y - 0.25F, z - 0.1F}, {x + 1.5F, EAVES_Y, z + 0.1F});
    }
  }
  add_once(scene, beams, m.wood);
}

/// Open trusses over the court: tie beam, king post, struts and rafters; purlins along the court.
void add_trusses(Scene& scene, const Materials& m) {
  constexpr float TIE = EAVES_Y + 0.25F;
  constexpr float RIDGE = TIE + 1.75F;
  Geometry flat;  // in x and y; turned so that its x runs across the court
  const auto bar = [&](glm::vec2 a, glm::vec2 b, float high, float wide) {
    const glm::vec2 along = glm::normalize(b - a);
    const glm::vec2 up = glm::vec2(-along.y, along.x) * (high / 2.0F);
    add_prism(flat, std::array{a - up, b - up, b + up, a + up}, -wide / 2.0F, wide / 2.0F);
  };
  bar({-4.25F, TIE}, {4.25F, TIE}, 0.30F, 0.26F);
  bar({0, TIE}, {0, RIDGE}, 0.22F, 0.21F);
  for (const float side : {-1.0F, 1.0F}) {
    bar({side * 4.1F, TIE + 0.2F}, {0, RIDGE}, 0.20F, 0.19F);
    bar({0, TIE + 0.3F}, {side * 1.9F, TIE + 0.98F}, 0.16F, 0.15F);
  }
  const std::uint32_t mesh = add_mesh(scene, flat, m.wood);
  for (int i = -3; i <= 3; ++i) place(scene, mesh, at({static_cast<float>(i) * BAY_X, 0, 0}, PI / 2.0F));
  Geometry purlins;
  const float end = COURT.x + 0.2F;
  add_box(purlins, {-end, RIDGE - 0.08F, -0.07F}, {end, RIDGE + 0.1F, 0.07F});
  for (const float z : {-2.6F, -1.3F, 1.3F, 2.6F}) {
    const float y = RIDGE - std::abs(z) * 0.378F + 0.1F;
    add_box(purlins, {-end, y, z - 0.06F}, {end, y + 0.13F, z + 0.06F});
  }
  add_once(scene, purlins, m.wood);
}

}  // namespace

std::vector<Bay> bays_around(int count_x, int count_z, glm::vec2 half) {
  std::vector<Bay> bays;
  const auto middle = [](int i, int count, float bay) {
    return (static_cast<float>(i) - static_cast<float>(count - 1) / 2.0F) * bay;
  };
  for (const float side : {1.0F, -1.0F}) {
    for (int i = 0; i < count_x; ++i) {
      bays.push_back({{middle(i, count_x, BAY_X), 0, side * half.y}, side > 0.0F ? 0.0F : PI, true, i});
    }
    for (int i = 0; i < count_z; ++i) {
      bays.push_back({{side * half.x, 0, middle(i, count_z, BAY_Z)}, side * PI / 2.0F, false, i});
    }
  }
  return bays;
}

void add_building(Scene& scene, const Materials& materials) {
  add_floors(scene, materials);
  add_vaults(scene, materials);
  add_arcade(scene, materials, {.spring = SPRING_Y, .top = SLAB_Y + 0.02F, .depth = 0.5F});
  add_arcade(scene, materials, {.spring = UPPER_SPRING_Y, .top = EAVES_Y, .depth = 0.4F});
  add_outer_walls(scene, materials);
  add_gallery(scene, materials);
  add_roof(scene, materials);
  add_trusses(scene, materials);
}

}  // namespace lamp::app::procedural::atrium
