// What is painted on the atrium: mosaics on the floor and between the arches, frescoes in the aisles, moss, cracks.
// Based on: nothing.
// Promise: no decal's box reaches a surface that it was not meant for; later ones lie on top.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scene/atrium.h"
#include "scene/procedural_random.h"

namespace lamp::app::procedural::atrium {
namespace {

constexpr glm::vec3 UP{0.0F, 1.0F, 0.0F};
constexpr glm::vec3 LAPIS{0.03F, 0.09F, 0.28F};
constexpr glm::vec3 OXBLOOD{0.33F, 0.05F, 0.03F};
constexpr glm::vec3 OCHRE{0.55F, 0.33F, 0.08F};
constexpr glm::vec3 MALACHITE{0.03F, 0.2F, 0.12F};

/// On a level floor; `turn` around +Y.
Decal on_floor(glm::vec3 at, float half, DecalPattern pattern, float turn = 0.0F) {
  return {.center = at,
          .orientation = facing(UP, {std::sin(turn), 0.0F, std::cos(turn)}),
          .half_extents = {half, half, 0.05F},
          .pattern = pattern};
}

/// The court's floor: a large mosaic around the fountain, others along the axis.
void add_court_mosaics(std::vector<Decal>& decals) {
  Decal around = on_floor({0, 0, 0}, 3.1F, DecalPattern::mosaic);
  around.color_a = LAPIS;
  around.color_b = OCHRE;
  decals.push_back(around);
  for (const float x : {-9.6F, -6.0F, 6.0F, 9.6F}) {
    Decal mosaic = on_floor({x, 0, 0}, 1.5F, DecalPattern::mosaic);
    const bool outer = std::abs(x) > 8.0F;
    mosaic.color_a = outer ? OXBLOOD : MALACHITE;
    mosaic.color_b = outer ? OCHRE : glm::vec3(0.6F, 0.55F, 0.45F);
    decals.push_back(mosaic);
  }
  for (Decal& decal : decals) decal.relief = 0.004F;
}

/// Round inlays in the spandrels, above each column between two arches, on the side of the court.
void add_spandrels(std::vector<Decal>& decals) {
  for (const float side : {-1.0F, 1.0F}) {
    for (int i = -3; i <= 3; ++i) {
      const glm::vec3 inward{0.0F, 0.0F, -side};
      decals.push_back({.center = {static_cast<float>(i) * BAY_X, 4.72F, side * (COURT.y - 0.25F)},
                        .orientation = facing(inward, UP),
                        .half_extents = {0.36F, 0.36F, 0.08F},
                        .pattern = DecalPattern::mosaic,
                        .color_a = i % 2 == 0 ? LAPIS : OXBLOOD,
                        .color_b = OCHRE,
                        .seed = static_cast<std::uint32_t>(i + 4),
                        .relief = 0.004F});
    }
  }
}

/// Frescoes on the aisles' outer walls, above the niches.
void add_frescoes(std::vector<Decal>& decals) {
  for (const float side : {-1.0F, 1.0F}) {
    for (int i = 0; i < 8; ++i) {
      const float x = (static_cast<float>(i) - 3.5F) * BAY_X;
      decals.push_back({.center = {x, 4.2F, side * OUTER.y},
                        .orientation = facing({0.0F, 0.0F, -side}, UP),
                        .half_extents = {0.95F, 0.48F, 0.1F},
                        .pattern = DecalPattern::painting,
                        .color_a = i % 2 == 0 ? glm::vec3(0.18F, 0.3F, 0.42F) : glm::vec3(0.42F, 0.24F, 0.12F),
                        .color_b = i % 3 == 0 ? MALACHITE : glm::vec3(0.2F, 0.12F, 0.05F),
                        .seed = static_cast<std::uint32_t>(i + (side > 0.0F ? 8 : 0)),
                        .relief = 0.001F});
    }
  }
}

/// Age: moss where the court meets the step, cracks in the floor and in the wall above the arches.
void add_wear(std::vector<Decal>& decals) {
  Random random(11);
  for (int i = 0; i < 18; ++i) {
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    const float x = random.between(-11.5F, 11.5F);
    const float turn = random.between(0.0F, 6.0F);
    const float size = random.between(0.45F, 1.0F);
    Decal moss = on_floor({x, 0.05F, side * (COURT.y - 0.55F)}, size, DecalPattern::moss, turn);
    moss.half_extents.z = 0.12F;
    moss.color_a = {0.04F, 0.09F, 0.015F};
    moss.color_b = {0.15F, 0.2F, 0.04F};
    moss.seed = random.bits();
    moss.relief = 0.012F;
    moss.none_angle = 1.5F;
    decals.push_back(moss);
  }
  for (int i = 0; i < 10; ++i) {
    const float turn = random.between(0.0F, 6.0F);
    const float size = random.between(0.5F, 1.1F);
    const float x = random.between(-11.0F, 11.0F);
    Decal crack = on_floor({x, 0, random.between(-2.8F, 2.8F)}, size, DecalPattern::crack, turn);
    crack.color_a = glm::vec3(0.025F);
    crack.seed = random.bits();
    crack.relief = 0.006F;
    decals.push_back(crack);
  }
}

/// The way to the gallery's stairs, on the step's front and beside the doors at both ends.
void add_signs(std::vector<Decal>& decals) {
  for (const float end : {-1.0F, 1.0F}) {
    for (const float side : {-1.0F, 1.0F}) {
      decals.push_back({.center = {end * OUTER.x, 1.75F, side * 1.4F},
                        .orientation = facing({-end, 0.0F, 0.0F}, UP),
                        .half_extents = {0.3F, 0.2F, 0.08F},
                        .pattern = DecalPattern::sign,
                        .color_a = {0.02F, 0.07F, 0.2F},
                        .color_b = glm::vec3(0.75F),
                        .relief = 0.002F});
    }
  }
}

}  // namespace

void add_decals(Scene& scene) {
  add_court_mosaics(scene.decals);
  add_spandrels(scene.decals);
  add_frescoes(scene.decals);
  add_wear(scene.decals);
  add_signs(scene.decals);
}

}  // namespace lamp::app::procedural::atrium
