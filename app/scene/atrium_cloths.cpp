// The atrium's cloths: banners under the trusses, cloths over the balustrades, veils in arches, ivy from the gallery.
// Based on: nothing; hanging folds are sums of sines that grow towards the free hem.
// Promise: every cloth is one double-sided sheet.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "scene/atrium.h"
#include "scene/mesh_builder.h"

namespace lamp::app::procedural::atrium {
namespace {

/// A sheet that hangs from y = 0 in the plane z = 0, with folds that deepen downwards.
struct Hanging {
  glm::vec2 size{1.0F};
  float folds = 2.0F;   ///< waves over the width
  float depth = 0.08F;  ///< m, at the hem
  float phase = 0.0F;
};

Geometry hanging(const Hanging& sheet) {
  Geometry geometry;
  add_grid(geometry, {.columns = 20, .rows = 28, .size_m = sheet.size, .surface = [sheet](glm::vec2 uv) {
                        const float fall = 1.0F - uv.y;
                        const float wave = std::sin(uv.x * sheet.folds * 2.0F * PI + sheet.phase + 0.8F * fall);
                        const float sway = 0.5F * std::sin(fall * 3.0F + sheet.phase);
                        const float sag = 0.03F * std::sin(uv.x * PI);
                        return glm::vec3((uv.x - 0.5F) * sheet.size.x * (1.0F - 0.06F * fall),
                                         -fall * sheet.size.y - sag,
                                         sheet.depth * (0.15F + 0.85F * fall) * (wave + sway * fall));
                      }});
  return geometry;
}

/// Banners on poles across the court, facing along it.
void add_banners(Scene& scene, const Materials& m) {
  constexpr float POLE_Y = EAVES_Y - 0.35F;
  Geometry pole;
  const std::array<glm::vec3, 2> ends{{{-0.9F, 0, 0}, {0.9F, 0, 0}}};
  const std::array<float, 2> radii{{0.025F, 0.025F}};
  add_tube(pole, {.path = ends, .radii = radii, .sides = 8});
  for (const float x : {-0.6F, 0.6F}) {
    const std::array<glm::vec3, 2> cord{{{x, 0, 0}, {x, 0.5F, 0}}};
    const std::array<float, 2> thin{{0.01F, 0.01F}};
    add_tube(pole, {.path = cord, .radii = thin, .sides = 5});
  }
  for (const float x : {-0.93F, 0.93F}) add_sphere(pole, {x, 0, 0}, 0.05F, 10);
  const std::uint32_t pole_mesh = add_mesh(scene, pole, m.bronze);
  std::vector<std::uint32_t> meshes;
  for (std::size_t i = 0; i < m.banners.size(); ++i) {
    const Geometry sheet = hanging({.size = BANNER_M, .folds = 1.5F, .phase = static_cast<float>(i) * 1.7F});
    meshes.push_back(add_mesh(scene, sheet, m.banners[i]));
  }
  std::size_t next = 0;
  for (const int i : {-2, -1, 0, 1, 2}) {
    const float x = static_cast<float>(i) * BAY_X;
    for (const float z : {-2.1F, 2.1F}) {
      place(scene, pole_mesh, at({x, POLE_Y, z}, -PI / 2.0F));
      place(scene, meshes[next++ % meshes.size()], at({x, POLE_Y - 0.01F, z}, -PI / 2.0F));
    }
  }
}

/// Cloths over the balustrade: up its back, over the rail, down into the court.
void add_drapes(Scene& scene, const Materials& m) {
  constexpr float RAIL = GALLERY_Y + 0.995F;
  Geometry drape;
  add_grid(drape, {.columns = 16, .rows = 40, .size_m = {1.1F, 2.6F}, .surface = [](glm::vec2 uv) {
                     const float along = (1.0F - uv.y) * 2.6F;  // m, from the inner hem
                     const float x = (uv.x - 0.5F) * 1.1F;
                     const float fold = 0.02F * std::sin(uv.x * 6.0F * PI);
                     if (along < 0.5F) return glm::vec3(x, RAIL - 0.5F + along, 0.2F + std::abs(fold));
                     if (along < 0.9F) {
                       const float turn = (along - 0.5F) / 0.4F * PI;
                       return glm::vec3(x, RAIL + 0.05F * std::sin(turn), 0.2F * std::cos(turn));
                     }
                     const float fall = along - 0.9F;
                     const float clear = 0.2F + 0.38F * glm::smoothstep(0.0F, 0.9F, fall);  // past the cornice
                     return glm::vec3(x, RAIL - fall, -clear - fold * (1.0F + 2.0F * fall));
                   }});
  const std::uint32_t mesh = add_mesh(scene, drape, m.red_cloth);
  for (const Bay& bay : bays_around(8, 3, COURT)) {
    if (bay.along_x && bay.number % 2 == 1) place(scene, mesh, at(bay.middle, bay.turn));
  }
}

/// Thin veils in some of the lower arches, ivy over the gallery's edge between the drapes.
void add_veils_and_ivy(Scene& scene, const Materials& m) {
  const Geometry veil = hanging({.size = {1.9F, 3.1F}, .folds = 5.0F, .depth = 0.1F, .phase = 0.6F});
  const std::uint32_t veil_mesh = add_mesh(scene, veil, m.veil);
  Geometry rod;
  const std::array<glm::vec3, 2> ends{{{-1.35F, SPRING_Y - 0.05F, 0}, {1.35F, SPRING_Y - 0.05F, 0}}};
  const std::array<float, 2> radii{{0.02F, 0.02F}};
  add_tube(rod, {.path = ends, .radii = radii, .sides = 8});
  const std::uint32_t rod_mesh = add_mesh(scene, rod, m.bronze);
  const Geometry ivy = hanging({.size = {1.5F, 1.5F}, .folds = 2.5F, .depth = 0.12F});
  const std::uint32_t ivy_mesh = add_mesh(scene, ivy, m.leaves);
  for (const Bay& bay : bays_around(8, 3, COURT)) {
    const glm::vec3 inward(-std::sin(bay.turn), 0, -std::cos(bay.turn));
    if (bay.along_x && (bay.number == 2 || bay.number == 5)) {
      place(scene, veil_mesh, at(bay.middle + glm::vec3(0, SPRING_Y - 0.05F, 0), bay.turn));
      place(scene, rod_mesh, at(bay.middle, bay.turn));
    }
    if (bay.along_x && bay.number % 4 == 0) {
      place(scene, ivy_mesh, at(bay.middle + inward * 0.66F + glm::vec3(0, GALLERY_Y + 0.02F, 0), bay.turn));
    }
  }
}

}  // namespace

void add_cloths(Scene& scene, const Materials& materials) {
  add_banners(scene, materials);
  add_drapes(scene, materials);
  add_veils_and_ivy(scene, materials);
}

}  // namespace lamp::app::procedural::atrium
