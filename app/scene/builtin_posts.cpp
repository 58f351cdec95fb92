// A birch wood with reeds on uneven ground: thousands of thin trunks, stems and leaves in front of one another.
// Based on: nothing; places from a jittered grid, kept off a winding loop that the flight follows.
// Promise: a tile of 16 x 16 pixels sees many depths; all trunks are real geometry of 2 to 10 cm.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin_scenes.h"
#include "scene/foliage.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_random.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

constexpr float HALF = 32.0F;  // m, of the wood
constexpr float TURN = 2.0F * std::numbers::pi_v<float>;

float ground(float x, float z) {
  return 0.55F * std::sin(x * 0.13F + 1.0F) * std::cos(z * 0.11F) + 0.18F * std::sin(0.41F * x + 0.33F * z);
}

/// The middle of the footpath, a closed loop; t runs from 0 to 1.
glm::vec2 footpath(float t) {
  const float a = TURN * t;
  return {19.0F * std::cos(a) + 3.5F * std::cos(3.0F * a), 15.0F * std::sin(a) + 3.0F * std::sin(2.0F * a)};
}

float distance_to_path(glm::vec2 p) {
  constexpr int STEPS = 240;
  float nearest = HALF;
  for (int i = 0; i < STEPS; ++i) {
    nearest = std::min(nearest, glm::length(footpath(static_cast<float>(i) / static_cast<float>(STEPS)) - p));
  }
  return nearest;
}

struct Materials {
  std::uint32_t soil, bark, leaf, leaf_cards, bamboo, reed, blade, head, rock;
};

Materials add_materials(Scene& scene) {
  const auto two_sided = [](Material material) {
    material.double_sided = true;
    return material;
  };
  Materials m{};
  m.soil = add_material(scene, use_surface(scene, forest_floor()));
  m.bark = add_material(scene, use_surface(scene, birch_bark()));
  const Material cloth_material = use_surface(scene, cloth());
  m.leaf = add_material(scene, two_sided(tinted(cloth_material, "leaf", {0.3F, 0.38F, 0.08F})));
  Material cards = two_sided(use_surface(scene, leaf_mask({0.2F, 0.27F, 0.06F})));
  cards.alpha_mode = AlphaMode::mask;
  m.leaf_cards = add_material(scene, cards);
  const Material plank_material = use_surface(scene, planks({0.5F, 0.42F, 0.22F}));
  m.bamboo = add_material(scene, tinted(plank_material, "bamboo", {0.75F, 0.9F, 0.5F}));
  m.reed = add_material(scene, tinted(plank_material, "reed", {0.9F, 0.85F, 0.6F}));
  m.blade = add_material(scene, two_sided(tinted(cloth_material, "blade", {0.2F, 0.34F, 0.08F})));
  m.head = add_material(scene, tinted(cloth_material, "reed head", {0.2F, 0.1F, 0.04F}));
  m.rock = add_material(scene, use_surface(scene, plaster({0.34F, 0.33F, 0.31F})));
  return m;
}

void add_ground(Scene& scene, const Materials& m) {
  Geometry soil;
  constexpr float REACH = HALF + 2.0F;
  add_grid(soil, {.columns = 110, .rows = 110, .size_m = {2 * REACH, 2 * REACH}, .surface = [](glm::vec2 uv) {
                    const float x = (2.0F * uv.x - 1.0F) * REACH;
                    const float z = (1.0F - 2.0F * uv.y) * REACH;
                    return glm::vec3(x, ground(x, z), z);
                  }});
  add_once(scene, soil, m.soil);
}

/// Something to plant: its meshes, one of which set is drawn a place.
using Plant = std::vector<std::uint32_t>;

std::vector<Plant> make_birches(Scene& scene, const Materials& m) {
  std::vector<Plant> birches;
  for (std::uint64_t variant = 0; variant < 4; ++variant) {
    const float height = 4.6F + 0.7F * static_cast<float>(variant);
    TreeParts parts = slender_tree({.height = height, .radius = 0.042F, .leaves = 84, .seed = 40 + variant});
    Geometry cards;
    for (std::size_t i = 0; i < parts.twigs.size(); i += 2) {
      add_crown(cards, {.center = parts.twigs[i], .radius = 0.25F, .cards = 3, .card_m = 0.4F, .seed = variant + i});
    }
    birches.push_back({add_mesh(scene, parts.wood, m.bark), add_mesh(scene, parts.leaves, m.leaf),
                       add_mesh(scene, cards, m.leaf_cards)});
  }
  return birches;
}

std::vector<Plant> make_bamboos(Scene& scene, const Materials& m) {
  std::vector<Plant> bamboos;
  for (const float height : {3.4F, 4.6F, 6.0F}) {
    std::vector<glm::vec2> profile{{0.0F, -0.3F}};
    for (float y = -0.3F; y < height; y += 0.6F) {  // a thicker ring at every joint
      const float radius = 0.021F * (1.0F - 0.5F * y / height);
      profile.insert(profile.end(), {{radius, y}, {radius * 1.25F, y + 0.58F}});
    }
    profile.emplace_back(0.0F, profile.back().y + 0.02F);
    Geometry cane;
    add_lathe(cane, {.profile = profile, .segments = 5});
    bamboos.push_back({add_mesh(scene, cane, m.bamboo)});
  }
  return bamboos;
}

std::vector<Plant> make_reeds(Scene& scene, const Materials& m) {
  std::vector<Plant> reeds;
  for (std::uint64_t variant = 0; variant < 3; ++variant) {
    const ReedParts parts = reed_clump({.stems = 9, .height = 1.9F, .spread = 0.55F, .seed = 90 + variant});
    reeds.push_back({add_mesh(scene, parts.stems, m.reed), add_mesh(scene, parts.heads, m.head),
                     add_mesh(scene, parts.blades, m.blade)});
  }
  return reeds;
}

std::vector<Plant> make_rocks(Scene& scene, const Materials& m) {
  std::vector<Plant> rocks;
  for (int variant = 0; variant < 3; ++variant) {
    Geometry rock;
    const float phase = static_cast<float>(variant) * 2.1F;
    add_grid(rock,
             {.columns = 18, .rows = 10, .size_m = {2.4F, 1.2F}, .surface = [phase](glm::vec2 uv) {
                const float turn = -TURN * uv.x;
                const float rise = TURN * 0.5F * (uv.y - 0.5F);
                const glm::vec3 way(std::cos(rise) * std::cos(turn), std::sin(rise), std::cos(rise) * std::sin(turn));
                const float bump = 1.0F + 0.16F * std::sin(way.x * 4.0F + phase) * std::cos(way.z * 3.0F - phase) +
                                   0.1F * std::sin(way.y * 5.0F + way.x * 3.0F + phase);
                return way * bump * glm::vec3(0.5F, 0.3F, 0.4F);
              }});
    rocks.push_back({add_mesh(scene, rock, m.rock)});
  }
  return rocks;
}

/// Plants on a jittered grid of `side` x `side` places, away from the footpath.
struct Planting {
  int side = 10;
  float clear_m = 1.0F;  ///< to the footpath's middle
  glm::vec2 scale{0.8F, 1.2F};
  float chance = 1.0F;
  std::uint64_t seed = 1;
};

void plant(Scene& scene, const std::vector<Plant>& kinds, const Planting& how) {
  Random random(how.seed);
  const float cell = 2.0F * HALF / static_cast<float>(how.side);
  for (int i = 0; i < how.side * how.side; ++i) {
    const glm::vec2 corner = glm::vec2(i % how.side, i / how.side) * cell - HALF;
    const float jitter_x = random.unit();
    const float jitter_z = random.unit();
    const glm::vec2 p = corner + cell * glm::vec2(jitter_x, jitter_z);
    const float turn = random.between(0.0F, TURN);
    const float scale = random.between(how.scale.x, how.scale.y);
    const Plant& kind = kinds[random.below(static_cast<std::uint32_t>(kinds.size()))];
    if (!random.chance(how.chance) || distance_to_path(p) < how.clear_m) continue;
    for (const std::uint32_t mesh : kind) place(scene, mesh, at({p.x, ground(p.x, p.y), p.y}, turn, scale));
  }
}

Flight walk() {
  constexpr int KEYS = 24;
  Flight flight;
  for (int i = 0; i < KEYS; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(KEYS);
    const glm::vec2 here = footpath(t);
    const glm::vec2 ahead = footpath(t + 0.06F);
    const float bob = 1.7F + 0.35F * std::sin(TURN * t * 2.0F);
    flight.keys.push_back({.eye = {here.x, ground(here.x, here.y) + bob, here.y},
                           .target = {ahead.x, ground(ahead.x, ahead.y) + bob + 0.35F, ahead.y}});
  }
  return flight;
}

}  // namespace

Scene make_posts() {
  Scene scene;
  scene.name = "posts";
  scene.sky = {0.02F, 0.034F, 0.075F};
  scene.ambient = {0.026F, 0.032F, 0.042F};
  const Materials m = add_materials(scene);
  add_ground(scene, m);
  plant(scene, make_birches(scene, m), {.side = 37, .clear_m = 1.25F, .scale = {0.75F, 1.2F}, .seed = 1});
  plant(scene, make_bamboos(scene, m),
        {.side = 42, .clear_m = 0.9F, .scale = {0.8F, 1.25F}, .chance = 0.6F, .seed = 2});
  plant(scene, make_reeds(scene, m), {.side = 21, .clear_m = 1.7F, .scale = {0.7F, 1.2F}, .chance = 0.6F, .seed = 3});
  plant(scene, make_rocks(scene, m), {.side = 12, .clear_m = 1.6F, .scale = {0.4F, 1.3F}, .chance = 0.6F, .seed = 4});
  const auto stand = [](float t, float height) {
    const glm::vec2 p = footpath(t);
    return glm::vec3(p.x, ground(p.x, p.y) + height, p.y);
  };
  scene.cameras = {camera_at("path", stand(0.60F, 1.65F), stand(0.66F, 2.0F), 1.0F),
                   camera_at("crowns", glm::vec3(-HALF + 6.0F, 9.5F, HALF - 8.0F), glm::vec3(6.0F, 1.0F, -8.0F), 0.9F)};
  scene.flight = walk();
  return scene;
}

}  // namespace lamp::app::procedural
