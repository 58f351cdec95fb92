// Tileable images made on the CPU for the built-in scenes: base colour, normal map, metallic-roughness, emission.
// Based on: value noise and cell noise (Worley, A Cellular Texture Basis Function, SIGGRAPH 1996).
// Promise: deterministic, seamless in both directions, a few milliseconds each.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "scene/scene.h"

namespace lamp::app::procedural {

/// What a material is at one point of its tile.
struct Texel {
  glm::vec3 color{0.5F};  ///< linear albedo
  float alpha = 1.0F;
  float height = 0.0F;  ///< m, towards the viewer
  float roughness = 1.0F;
  float metallic = 0.0F;
  glm::vec3 emission{0.0F};  ///< linear, 0 .. 1
};

/// A kind of surface: its texels over p in [0, 1)², x right and y down.
struct Surface {
  std::string name;
  std::uint32_t size = 512;  ///< pixels a side
  glm::vec2 tile_m{1.0F};    ///< metres that one image covers
  bool glows = false;        ///< has an emission image
  std::function<Texel(glm::vec2)> texel;
};

/// Adds the surface's images to the scene and returns a material that shows them over uv in metres. The material is
/// not in the scene yet: tint or change it, then `add_material`.
[[nodiscard]] Material use_surface(Scene& scene, const Surface& surface);

/// A material of one colour.
struct Plain {
  std::string name;
  glm::vec3 color{0.5F};
  float roughness = 0.5F;
  float metallic = 0.0F;
  glm::vec3 emissive{0.0F};
};
[[nodiscard]] Material plain_material(const Plain& plain);
std::uint32_t add_material(Scene& scene, Material material);
/// The same images in another colour, under another name.
[[nodiscard]] Material tinted(Material material, const std::string& name, const glm::vec3& color);

/// Noise in [0, 1], mean about 0.5, seamless with period 1 in both directions; scale p by whole numbers only.
[[nodiscard]] float noise(glm::vec2 p);

/// A brick of a bond of `count.x` by `count.y` bricks a tile; odd rows are shifted by `shift` bricks.
struct Brick {
  glm::vec2 local{0.0F};  ///< in the brick, 0 .. 1
  float edge_m = 0.0F;    ///< to the nearest joint's middle
  float id = 0.0F;        ///< [0, 1)
};
[[nodiscard]] Brick brick_at(glm::vec2 p, glm::uvec2 count, float shift, glm::vec2 tile_m);

// Masonry (textures_masonry.cpp)
[[nodiscard]] Surface stone_blocks(const glm::vec3& color);  ///< 2 m, rows of 0.5 m
[[nodiscard]] Surface bricks();                              ///< 2 m
[[nodiscard]] Surface marble(const glm::vec3& color);        ///< 2 m, polished
[[nodiscard]] Surface floor_tiles(const glm::vec3& light, const glm::vec3& dark, const glm::vec3& inset);  ///< 2 m
[[nodiscard]] Surface plaster(const glm::vec3& color);                                                     ///< 2 m
[[nodiscard]] Surface concrete(const glm::vec3& color);  ///< 4 m, slabs of 2 m
[[nodiscard]] Surface roof_tiles();                      ///< 1.2 m, courses run along u

// Grown and made things (textures_soft.cpp)
[[nodiscard]] Surface planks(const glm::vec3& color);  ///< 1 m, boards run along v
[[nodiscard]] Surface cloth();                         ///< 0.25 m, white, to be tinted
struct BannerLook {
  glm::vec3 field{0.4F, 0.04F, 0.03F};
  glm::vec3 band{0.75F, 0.5F, 0.12F};
};
[[nodiscard]] Surface banner(const std::string& name, const BannerLook& look, glm::vec2 size_m);
[[nodiscard]] Surface fretwork();                                                   ///< 0.5 m, alpha is a lattice
[[nodiscard]] Surface leaf_mask(const glm::vec3& color);                            ///< 0.5 m, alpha is leaves
[[nodiscard]] Surface birch_bark();                                                 ///< 1 m
[[nodiscard]] Surface forest_floor();                                               ///< 3 m
[[nodiscard]] Surface worn_metal(const std::string& name, const glm::vec3& color);  ///< 1 m

// City (textures_city.cpp)
struct FacadeLook {
  std::string name;
  glm::vec3 wall{0.5F};
  glm::vec2 window_min{0.25F, 0.2F};  ///< of a cell of 3 m by 3.2 m, y down
  glm::vec2 window_max{0.75F, 0.75F};
  float lit = 0.25F;  ///< fraction of the windows
  bool bricks = false;
  float wall_roughness = 0.85F;
  std::uint32_t seed = 1;
};
inline constexpr glm::vec2 FACADE_CELL_M{3.0F, 3.2F};
[[nodiscard]] Surface facade(const FacadeLook& look);  ///< 24 m x 25.6 m, 8 x 8 windows
[[nodiscard]] Surface shop_fronts();                   ///< 24 m x 4 m
[[nodiscard]] Surface asphalt();                       ///< 4 m
[[nodiscard]] Surface road();                          ///< 14 m across (v), 12 m along (u), markings
[[nodiscard]] Surface crossing();                      ///< 14 m across (v), 3 m along (u), a zebra crossing

}  // namespace lamp::app::procedural
