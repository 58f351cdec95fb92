// Wood, cloth, lattices, leaves, bark, forest floor and worn metal.
// Based on: nothing; stretched noise, woven threads, circles on a lattice, ellipses for leaves.
// Promise: see procedural_textures.h.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/procedural_random.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

constexpr float HALF_TURN = std::numbers::pi_v<float>;
constexpr glm::vec2 BOARDS_M{1.0F};

/// Leaves scattered over `count` x `count` cells: alpha, and which leaf is on top.
struct LeafHit {
  float inside = 0.0F;  ///< > 0 inside a leaf, 0 .. 1
  float id = 0.0F;
  float along = 0.0F;  ///< -1 .. 1 over the leaf's width
};

LeafHit leaf_at(glm::vec2 p, std::uint32_t count) {
  const glm::vec2 scaled = p * static_cast<float>(count);
  const glm::ivec2 home(glm::floor(scaled));
  const int n = static_cast<int>(count);
  LeafHit top;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const auto x = static_cast<std::uint32_t>((home.x + dx + n) % n);
      const auto y = static_cast<std::uint32_t>((home.y + dy + n) % n);
      const glm::vec2 center =
          glm::vec2(home + glm::ivec2(dx, dy)) + glm::vec2(hash_unit(x, y, 11), hash_unit(x, y, 12));
      const float turn = hash_unit(x, y, 13) * 2.0F * HALF_TURN;
      const glm::vec2 d = scaled - center;
      const glm::vec2 local(d.x * std::cos(turn) + d.y * std::sin(turn), d.y * std::cos(turn) - d.x * std::sin(turn));
      const float length = local.x / 0.62F;
      const float half_width = 0.30F * (1.0F - length * length);
      if (std::abs(length) >= 1.0F) continue;
      const float inside = 1.0F - std::abs(local.y) / half_width;
      const float id = hash_unit(x, y, 14);
      if (inside > 0.0F && id >= top.id) top = {inside, id, local.y / half_width};
    }
  }
  return top;
}

/// Dark flat ellipses of a birch's bark: one by chance in each of 5 x 16 cells; 1 inside, 0 outside.
float birch_scar(glm::vec2 p) {
  const glm::vec2 count(5.0F, 16.0F);
  const glm::vec2 scaled = p * count;
  float scar = 0.0F;
  for (int step = -1; step <= 1; ++step) {
    const auto x = static_cast<std::uint32_t>((static_cast<int>(scaled.x) + step + 5) % 5);
    const auto y = static_cast<std::uint32_t>(scaled.y);
    if (hash_unit(x, y, 31) > 0.45F) continue;
    const float center_x = std::floor(scaled.x) + static_cast<float>(step) + hash_unit(x, y, 32);
    const float center_y = static_cast<float>(y) + 0.3F + 0.4F * hash_unit(x, y, 33);
    const glm::vec2 d((scaled.x - center_x) / 0.7F, (scaled.y - center_y) / (0.12F + 0.18F * hash_unit(x, y, 34)));
    scar = std::max(scar, 1.0F - glm::smoothstep(0.7F, 1.0F, glm::length(d)));
  }
  return scar;
}

}  // namespace

Surface planks(const glm::vec3& color) {
  return {.name = "planks", .tile_m = BOARDS_M, .texel = [color](glm::vec2 p) {
            const Brick board = brick_at({p.y, p.x}, {1, 5}, 0.4F, BOARDS_M);
            const glm::vec2 grain_at(p.x * 10.0F + board.id, p.y + board.id);
            const float grain = noise(grain_at);
            const float face = glm::smoothstep(0.001F, 0.005F, board.edge_m);
            Texel texel;
            texel.color = color * (0.75F + 0.45F * board.id) * (0.6F + 0.6F * grain) * std::lerp(0.35F, 1.0F, face);
            texel.height = 0.003F * face + 0.0015F * grain;
            texel.roughness = 0.55F + 0.3F * grain;
            return texel;
          }};
}

Surface cloth() {
  return {.name = "cloth", .size = 256, .tile_m = glm::vec2(0.25F), .texel = [](glm::vec2 p) {
            const glm::vec2 thread = p * 32.0F;
            const glm::vec2 wave = glm::abs(glm::sin(thread * HALF_TURN));
            const bool over = (static_cast<int>(thread.x) + static_cast<int>(thread.y)) % 2 == 0;
            const float weave = over ? wave.x : wave.y;
            Texel texel;
            texel.color = glm::vec3(0.7F + 0.3F * weave) * (0.85F + 0.3F * noise(p * 2.0F));
            texel.height = 0.0012F * weave;
            texel.roughness = 0.95F;
            return texel;
          }};
}

Surface banner(const std::string& name, const BannerLook& look, glm::vec2 size_m) {
  return {.name = name, .tile_m = size_m, .texel = [=](glm::vec2 p) {
            const glm::vec2 metres = p * size_m;
            const glm::vec2 edge = glm::min(metres, size_m - metres);
            const float border = std::min(edge.x, edge.y);
            const glm::vec2 mid = glm::abs(metres - glm::vec2(size_m.x * 0.5F, size_m.y * 0.42F));
            const float diamond = mid.x * 1.5F + mid.y;
            const bool in_border = border > 0.07F && border < 0.13F;
            const bool in_diamond = diamond < 0.26F || (diamond > 0.36F && diamond < 0.44F);
            const float row = metres.y - size_m.y * 0.78F;  // zigzags near the hem
            const float zigzag = std::abs(glm::fract(metres.x / (size_m.x / 5.0F)) - 0.5F) * 0.2F;
            const bool in_zigzag = border > 0.13F && row > zigzag && row < zigzag + 0.07F;
            const float weave =
                std::abs(std::sin(metres.x * 120.0F * HALF_TURN)) * std::abs(std::sin(metres.y * 90.0F * HALF_TURN));
            const bool gold = in_border || in_diamond || in_zigzag;
            Texel texel;
            texel.color = (gold ? look.band : look.field) * (0.8F + 0.25F * noise(p * 3.0F)) * (0.9F + 0.15F * weave);
            texel.height = gold ? 0.001F : 0.0F;
            texel.roughness = gold ? 0.55F : 0.9F;
            return texel;
          }};
}

Surface fretwork() {
  return {.name = "fretwork", .size = 256, .tile_m = glm::vec2(0.5F), .texel = [](glm::vec2 p) {
            // Overlapping circles on a lattice of two cells a tile, crossed by diagonals: bars of about 2 cm.
            const glm::vec2 q = glm::fract(p * 2.0F) - 0.5F;
            float distance = std::abs(glm::length(q) - 0.36F);
            for (const glm::vec2 corner :
                 {glm::vec2(0.5F), glm::vec2(-0.5F), glm::vec2(0.5F, -0.5F), glm::vec2(-0.5F, 0.5F)}) {
              distance = std::min(distance, std::abs(glm::length(q - corner) - 0.36F));
            }
            distance = std::min({distance, std::abs(q.x), std::abs(q.y), 0.5F - std::abs(q.x), 0.5F - std::abs(q.y)});
            Texel texel;
            texel.alpha = 1.0F - glm::smoothstep(0.035F, 0.065F, distance);
            texel.color = glm::vec3(0.33F, 0.2F, 0.1F) * (0.6F + 0.6F * noise(p * 2.0F));
            texel.height = -0.1F * distance;
            texel.roughness = 0.6F;
            return texel;
          }};
}

Surface leaf_mask(const glm::vec3& color) {
  return {.name = "leaves", .size = 256, .tile_m = glm::vec2(0.5F), .texel = [color](glm::vec2 p) {
            const LeafHit leaf = leaf_at(p, 5);
            const float rib = 1.0F - glm::smoothstep(0.0F, 0.12F, std::abs(leaf.along));
            Texel texel;
            texel.alpha = glm::smoothstep(0.0F, 0.2F, leaf.inside);
            texel.color = color * (0.55F + 0.75F * leaf.id) * (1.0F + 0.5F * rib) * (0.8F + 0.4F * noise(p * 2.0F));
            texel.height = 0.004F * leaf.inside - 0.002F * rib;
            texel.roughness = 0.55F;
            return texel;
          }};
}

Surface birch_bark() {
  return {.name = "birch bark", .size = 256, .tile_m = glm::vec2(1.0F), .texel = [](glm::vec2 p) {
            const float scar = birch_scar(p);
            const float patch = glm::smoothstep(0.72F, 0.8F, noise(p * 2.0F + 0.5F));
            const float dark = std::max(scar, patch);
            Texel texel;
            texel.color = glm::mix(glm::vec3(0.72F, 0.69F, 0.62F), glm::vec3(0.05F, 0.045F, 0.04F), dark) *
                          (0.8F + 0.3F * noise(p * 4.0F));
            texel.height = -0.006F * dark;
            texel.roughness = 0.8F;
            return texel;
          }};
}

Surface forest_floor() {
  return {.name = "forest floor", .tile_m = glm::vec2(3.0F), .texel = [](glm::vec2 p) {
            const float moss = glm::smoothstep(0.4F, 0.62F, noise(p + 0.1F));
            const LeafHit leaf = leaf_at(p, 24);
            const float fine = noise(p * 6.0F);
            const glm::vec3 soil = glm::mix(glm::vec3(0.10F, 0.065F, 0.04F), glm::vec3(0.2F, 0.15F, 0.09F), fine);
            const glm::vec3 green = glm::vec3(0.10F, 0.16F, 0.04F) * (0.6F + 0.9F * fine);
            const bool litter = leaf.inside > 0.0F && leaf.id > 0.45F && moss < 0.7F;
            const glm::vec3 brown = glm::mix(glm::vec3(0.28F, 0.15F, 0.05F), glm::vec3(0.42F, 0.3F, 0.1F), leaf.id);
            Texel texel;
            texel.color = litter ? brown * (0.6F + 0.5F * fine) : glm::mix(soil, green, moss);
            texel.height = 0.02F * fine + 0.02F * moss + (litter ? 0.01F * leaf.inside : 0.0F);
            texel.roughness = 0.95F;
            return texel;
          }};
}

Surface worn_metal(const std::string& name, const glm::vec3& color) {
  return {.name = name, .size = 256, .tile_m = glm::vec2(1.0F), .texel = [color](glm::vec2 p) {
            const float wear = glm::smoothstep(0.5F, 0.95F, noise(p * 2.0F));
            const float brushed = noise(glm::vec2(p.x, p.y * 16.0F));
            Texel texel;
            texel.color = glm::mix(color, color * glm::vec3(0.68F, 0.7F, 0.66F), wear);
            texel.metallic = 1.0F - 0.35F * wear;
            texel.roughness = 0.28F + 0.3F * wear + 0.12F * brushed;
            texel.height = 0.0006F * brushed - 0.001F * wear;
            return texel;
          }};
}

}  // namespace lamp::app::procedural
