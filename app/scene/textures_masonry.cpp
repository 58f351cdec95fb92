// Stone, brick, marble, tiles, plaster and concrete.
// Based on: nothing; bonds of bricks, joints a few millimetres deep, noise for wear.
// Promise: see procedural_textures.h.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

constexpr glm::vec2 MASONRY_M{2.0F};
constexpr glm::vec2 SLABS_M{4.0F};
constexpr glm::vec2 ROOF_M{1.2F};

/// 0 below `from`, 1 above `to`, smooth between.
float step_between(float from, float to, float x) { return glm::smoothstep(from, to, x); }

/// Dark veins: 1 on a vein, 0 away from it.
float veins(glm::vec2 p) {
  const glm::vec2 bent = p + 0.12F * glm::vec2(noise(p + 0.31F), noise(p + 0.73F));
  const float ridge = std::abs(noise(bent) - 0.5F);
  return 1.0F - step_between(0.0F, 0.07F, ridge);
}

}  // namespace

Surface stone_blocks(const glm::vec3& color) {
  return {.name = "stone blocks", .tile_m = MASONRY_M, .texel = [color](glm::vec2 p) {
            const Brick brick = brick_at(p, {2, 4}, 0.5F, MASONRY_M);
            const float grain = noise(p * 3.0F + brick.id);
            const float face = step_between(0.003F, 0.018F, brick.edge_m);
            Texel texel;
            texel.color = color * (0.82F + 0.3F * brick.id) * (0.75F + 0.4F * grain) * std::lerp(0.55F, 1.0F, face);
            texel.height = 0.012F * face + 0.006F * grain;
            texel.roughness = 0.95F - 0.2F * face * grain;
            return texel;
          }};
}

Surface bricks() {
  return {.name = "bricks", .tile_m = MASONRY_M, .texel = [](glm::vec2 p) {
            const Brick brick = brick_at(p, {8, 24}, 0.5F, MASONRY_M);
            const float grain = noise(p * 4.0F + brick.id);
            const float face = step_between(0.004F, 0.010F, brick.edge_m);
            const glm::vec3 clay = glm::mix(glm::vec3(0.30F, 0.10F, 0.06F), glm::vec3(0.46F, 0.21F, 0.12F), brick.id);
            Texel texel;
            texel.color = glm::mix(glm::vec3(0.42F, 0.40F, 0.37F), clay, face) * (0.7F + 0.5F * grain);
            texel.height = 0.008F * face + 0.003F * grain;
            texel.roughness = 0.9F;
            return texel;
          }};
}

Surface marble(const glm::vec3& color) {
  return {.name = "marble", .tile_m = glm::vec2(2.0F), .texel = [color](glm::vec2 p) {
            const float vein = 0.6F * veins(p) + 0.4F * veins(p * 2.0F + 0.4F);
            Texel texel;
            texel.color = color * (0.85F + 0.25F * noise(p * 2.0F)) * (1.0F - 0.35F * vein);
            texel.roughness = 0.34F + 0.15F * noise(p * 3.0F);
            return texel;
          }};
}

Surface floor_tiles(const glm::vec3& light, const glm::vec3& dark, const glm::vec3& inset) {
  constexpr float HALF_INSET = 0.21F;  // m, half the diagonal of the diamonds where four tiles meet
  return {.name = "floor tiles", .tile_m = glm::vec2(2.0F), .texel = [=](glm::vec2 p) {
            const glm::vec2 metres = p * 2.0F;
            const glm::vec2 cell = glm::floor(metres);
            const glm::vec2 to_corner = glm::abs(metres - glm::round(metres));
            const float diamond = HALF_INSET - (to_corner.x + to_corner.y);  // > 0 inside
            const float joint = std::min(to_corner.x, to_corner.y);
            const bool inside = diamond > 0.0F;
            const float edge = inside ? diamond * 0.707F : std::min(joint, -diamond * 0.707F);
            const bool checker = static_cast<int>(cell.x + cell.y) % 2 != 0;
            const float ring = std::abs(glm::length(glm::fract(metres) - 0.5F) - 0.27F);
            const float vein = veins(p * 2.0F + (checker ? 0.37F : 0.0F));
            const float face = step_between(0.003F, 0.007F, edge);
            const float inlay = checker || inside ? 0.0F : 1.0F - step_between(0.022F, 0.028F, ring);
            glm::vec3 color = inside ? inset : checker ? dark : light;
            color = glm::mix(color, inset, inlay);
            Texel texel;
            texel.color = color * (1.0F - 0.3F * vein) * (0.85F + 0.3F * noise(p * 3.0F)) * std::lerp(0.4F, 1.0F, face);
            texel.height = 0.0015F * face;
            texel.roughness = std::lerp(0.85F, 0.25F + 0.2F * noise(p * 4.0F), face);
            return texel;
          }};
}

Surface plaster(const glm::vec3& color) {
  return {.name = "plaster", .tile_m = glm::vec2(2.0F), .texel = [color](glm::vec2 p) {
            const float rough = noise(p * 4.0F);
            const float stain = noise(p + 0.2F);
            Texel texel;
            texel.color = color * (0.8F + 0.3F * stain) * (0.92F + 0.12F * rough);
            texel.height = 0.004F * rough;
            texel.roughness = 0.92F;
            return texel;
          }};
}

Surface concrete(const glm::vec3& color) {
  return {.name = "concrete", .tile_m = SLABS_M, .texel = [color](glm::vec2 p) {
            const Brick slab = brick_at(p, {2, 2}, 0.0F, SLABS_M);
            const float grain = noise(p * 8.0F);
            const float stain = noise(p * 2.0F + slab.id);
            const float face = step_between(0.004F, 0.015F, slab.edge_m);
            Texel texel;
            texel.color = color * (0.85F + 0.2F * slab.id) * (0.8F + 0.25F * stain) * (0.9F + 0.15F * grain) *
                          std::lerp(0.5F, 1.0F, face);
            texel.height = 0.006F * face + 0.004F * grain;
            texel.roughness = 0.9F;
            return texel;
          }};
}

Surface roof_tiles() {
  return {.name = "roof tiles", .size = 256, .tile_m = ROOF_M, .texel = [](glm::vec2 p) {
            const Brick tile = brick_at(p, {6, 4}, 0.5F, ROOF_M);
            const float barrel = std::sin(tile.local.x * std::numbers::pi_v<float>);
            const float grain = noise(p * 3.0F + tile.id);
            const float gap = step_between(0.0F, 0.25F, barrel);
            Texel texel;
            texel.color = glm::mix(glm::vec3(0.33F, 0.13F, 0.07F), glm::vec3(0.5F, 0.24F, 0.13F), tile.id) *
                          (0.7F + 0.5F * grain) * std::lerp(0.4F, 1.0F, gap);
            texel.height = 0.03F * barrel + 0.02F * tile.local.y;
            texel.roughness = 0.85F;
            return texel;
          }};
}

}  // namespace lamp::app::procedural
