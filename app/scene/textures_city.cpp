// Facades with windows, shop fronts, asphalt and road markings.
// Based on: nothing; one cell a window, lit by chance.
// Promise: see procedural_textures.h.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/procedural_random.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

constexpr glm::vec2 SHOPS_M{24.0F, 4.0F};  // four shops
constexpr glm::vec2 ROAD_M{12.0F, 14.0F};
constexpr glm::vec2 CROSSING_M{3.0F, 14.0F};

/// 0 outside a rectangle, above 0 inside: metres to its nearest edge.
float inside_rect(glm::vec2 p, glm::vec2 min, glm::vec2 max) {
  const glm::vec2 edge = glm::min(p - min, max - p);
  return std::max(0.0F, std::min(edge.x, edge.y));
}

glm::vec3 lamp_color(float id) {
  return glm::mix(glm::vec3(1.0F, 0.55F, 0.22F), glm::vec3(0.75F, 0.85F, 1.0F), glm::smoothstep(0.6F, 0.9F, id));
}

/// What shows behind a pane: a lit room with something of a curtain, or dark glass.
void add_pane(Texel& texel, glm::vec2 local, float lit, float id) {
  texel.color = glm::vec3(0.03F, 0.04F, 0.05F);
  texel.roughness = 0.08F;
  texel.metallic = 0.0F;
  const float curtain = std::abs(local.x - 0.5F) > 0.18F + 0.3F * id ? 0.35F : 1.0F;
  texel.emission = lamp_color(id) * (lit * curtain * (0.45F + 0.5F * (1.0F - local.y)));
}

}  // namespace

Surface facade(const FacadeLook& look) {
  constexpr std::uint32_t WINDOWS = 8;
  return {.name = look.name,
          .tile_m = FACADE_CELL_M * static_cast<float>(WINDOWS),
          .glows = true,
          .texel = [look](glm::vec2 p) {
            const glm::vec2 scaled = p * static_cast<float>(WINDOWS);
            const glm::uvec2 cell = glm::min(glm::uvec2(scaled), glm::uvec2(WINDOWS - 1));
            const glm::vec2 local = scaled - glm::vec2(cell);
            const glm::vec2 metres = local * FACADE_CELL_M;
            const float pane = inside_rect(metres, look.window_min * FACADE_CELL_M, look.window_max * FACADE_CELL_M);
            const float frame =
                inside_rect(metres, look.window_min * FACADE_CELL_M - 0.12F, look.window_max * FACADE_CELL_M + 0.12F);
            const bool mullion = std::abs(local.x - 0.5F) * FACADE_CELL_M.x < 0.04F;
            const float slab = local.y > 0.93F ? 0.8F : 1.0F;  // a darker band at every floor
            Texel texel;
            texel.color = look.wall * slab * (0.8F + 0.3F * noise(p * 4.0F));
            texel.roughness = look.wall_roughness;
            if (look.bricks) {
              const Brick brick = brick_at(scaled / 2.0F, {16, 48}, 0.5F, FACADE_CELL_M * 2.0F);
              texel.color *= brick.edge_m < 0.02F ? 1.25F : 0.75F + 0.4F * brick.id;
            }
            if (frame > 0.0F) {
              texel.color = look.wall * 0.45F + 0.12F;
              texel.height = 0.03F;
            }
            if (pane > 0.0F && !mullion) {
              const float id = hash_unit(cell.x, cell.y, look.seed);
              add_pane(texel, local, id < look.lit ? 1.0F : 0.0F, hash_unit(cell.x, cell.y, look.seed + 7));
              texel.height = -0.12F;
            }
            return texel;
          }};
}

Surface shop_fronts() {
  return {.name = "shop fronts", .tile_m = SHOPS_M, .glows = true, .texel = [](glm::vec2 p) {
            const glm::vec2 metres = p * SHOPS_M;
            const auto shop = std::min(static_cast<std::uint32_t>(metres.x / 6.0F), 3U);
            const float x = metres.x - static_cast<float>(shop) * 6.0F;
            const float id = hash_unit(shop, 3, 77);
            const glm::vec2 local(x / 6.0F, p.y);
            Texel texel;
            texel.color = glm::vec3(0.32F, 0.3F, 0.28F) * (0.7F + 0.5F * id);
            texel.roughness = 0.7F;
            const bool sign = inside_rect({x, metres.y}, {0.5F, 0.35F}, {5.5F, 0.85F}) > 0.0F;
            const bool door = inside_rect({x, metres.y}, {4.4F, 1.3F}, {5.4F, 3.9F}) > 0.0F;
            const bool display = inside_rect({x, metres.y}, {0.5F, 1.3F}, {4.1F, 3.4F}) > 0.0F;
            if (sign) {
              texel.color = glm::mix(glm::vec3(0.5F, 0.06F, 0.05F), glm::vec3(0.05F, 0.25F, 0.4F), id);
              texel.emission =
                  texel.color * (hash_unit(static_cast<std::uint32_t>(x * 6.0F), shop, 5) > 0.5F ? 0.9F : 0.3F);
            }
            if (door || display) {  // shelves and their goods stand dark before the lit room
              const bool shelf = glm::fract(metres.y / 0.55F) < 0.12F;
              const bool goods = hash_unit(static_cast<std::uint32_t>(metres.x / 0.21F),
                                           static_cast<std::uint32_t>(metres.y / 0.55F), 6) > 0.6F;
              add_pane(texel, local, shop % 3 == 1 ? 0.0F : (shelf || (goods && metres.y > 1.9F)) ? 0.2F : 0.6F, id);
            }
            texel.height = door || display ? -0.15F : 0.0F;
            return texel;
          }};
}

Surface asphalt() {
  return {.name = "asphalt", .tile_m = glm::vec2(4.0F), .texel = [](glm::vec2 p) {
            const float grain = noise(p * 16.0F);
            const float patch = noise(p + 0.6F);
            Texel texel;
            texel.color = glm::vec3(0.075F, 0.075F, 0.08F) * (0.6F + 0.5F * patch) * (0.7F + 0.6F * grain);
            texel.height = 0.003F * grain;
            texel.roughness = 0.6F + 0.35F * glm::smoothstep(0.35F, 0.6F, patch);
            return texel;
          }};
}

Surface road() {
  return {.name = "road", .tile_m = ROAD_M, .texel = [base = asphalt().texel](glm::vec2 p) {
            const glm::vec2 metres = p * ROAD_M;
            Texel texel = base(p * 3.0F);
            const float across = std::abs(metres.y - 7.0F);
            const bool middle = across > 0.08F && across < 0.2F;
            const bool dash = std::abs(across - 3.4F) < 0.07F && glm::fract(metres.x / 6.0F) < 0.5F;
            const bool side = std::abs(across - 6.5F) < 0.06F;
            const bool paint = (middle || dash || side) && noise(p * 8.0F) < 0.68F;
            if (paint) texel.color = middle ? glm::vec3(0.6F, 0.42F, 0.06F) : glm::vec3(0.62F);
            return texel;
          }};
}

Surface crossing() {
  return {.name = "crossing", .size = 256, .tile_m = CROSSING_M, .texel = [base = asphalt().texel](glm::vec2 p) {
            Texel texel = base(p * glm::vec2(1.0F, 3.0F));
            const bool stripe = glm::fract(p.y * 14.0F) < 0.5F && std::abs(p.x - 0.5F) < 0.4F;
            if (stripe && noise(p * 4.0F) < 0.7F) texel.color = glm::vec3(0.62F);
            return texel;
          }};
}

}  // namespace lamp::app::procedural
