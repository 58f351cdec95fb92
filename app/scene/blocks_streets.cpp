// The city's streets: roadways with markings, crossings, pavements, parks, lamps, signals, cars and trees.
// Based on: nothing.
// Promise: roadway pieces meet edge to edge with shared corners; everything else is drawn by instances.
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "scene/blocks.h"
#include "scene/foliage.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_random.h"

namespace lamp::app::procedural::blocks {
namespace {

constexpr float HALF_STREET = STREET_M / 2.0F;

/// A piece of roadway between two points of the street's middle.
void add_roadway(Geometry& geometry, glm::vec2 from, glm::vec2 to) {
  const glm::vec2 along = to - from;
  const glm::vec2 right = glm::normalize(along);  // the far side is left of the way, seen from above
  const glm::vec2 far_side = glm::vec2(right.y, -right.x) * STREET_M;
  const glm::vec2 corner = from - far_side / 2.0F;
  add_uv_quad(geometry,
              {.corner = {corner.x, 0, corner.y}, .right = {along.x, 0, along.y}, .up = {far_side.x, 0, far_side.y}});
}

/// The three pieces of a street between two neighbouring crossings.
void add_street(Geometry& road, Geometry& crossings, glm::vec2 from, glm::vec2 to) {
  const glm::vec2 along = glm::normalize(to - from);
  const glm::vec2 a = from + along * HALF_STREET;
  const glm::vec2 b = to - along * HALF_STREET;
  add_roadway(crossings, a, a + along * CROSSING_M);
  add_roadway(road, a + along * CROSSING_M, b - along * CROSSING_M);
  add_roadway(crossings, b - along * CROSSING_M, b);
}

/// Calls `f(from, to)` for every street between neighbouring crossings.
template <class F>
void for_each_street(F&& f) {
  for (int i = 0; i <= BLOCKS_X; ++i) {
    for (int k = 0; k <= BLOCKS_Z; ++k) {
      if (i < BLOCKS_X) f(crossing_at(i, k), crossing_at(i + 1, k));
      if (k < BLOCKS_Z) f(crossing_at(i, k), crossing_at(i, k + 1));
    }
  }
}

struct Part {
  std::uint32_t mesh;
};
using Parts = std::vector<Part>;

void place_all(Scene& scene, const Parts& parts, const glm::mat4& where) {
  for (const Part part : parts) place(scene, part.mesh, where);
}

/// A street lamp; its arm reaches along +x.
Parts make_lamp(Scene& scene, const Materials& m) {
  Geometry pole;
  const std::array<glm::vec2, 7> profile{
      {{0.0F, -0.2F}, {0.14F, -0.2F}, {0.14F, 0.5F}, {0.08F, 0.6F}, {0.05F, 6.2F}, {0.04F, 6.3F}, {0.0F, 6.32F}}};
  add_lathe(pole, {.profile = profile, .segments = 8});
  const std::array<glm::vec3, 4> arm{{{0, 6.1F, 0}, {0.4F, 6.5F, 0}, {1.0F, 6.65F, 0}, {1.7F, 6.6F, 0}}};
  const std::array<float, 4> radii{{0.04F, 0.035F, 0.03F, 0.03F}};
  add_tube(pole, {.path = arm, .radii = radii, .sides = 6});
  add_box(pole, {1.5F, 6.52F, -0.14F}, {2.2F, 6.68F, 0.14F});
  Geometry light;
  add_box(light, {1.6F, 6.48F, -0.1F}, {2.1F, 6.56F, 0.1F});
  return {{add_mesh(scene, pole, m.metal)}, {add_mesh(scene, light, m.lamp)}};
}

Parts make_signal(Scene& scene, const Materials& m) {
  Geometry pole;
  add_cylinder(pole, 0.06F, -0.2F, 3.2F, 8);
  add_box(pole, {-0.16F, 2.3F, 0.0F}, {0.16F, 3.25F, 0.2F});
  Geometry red;
  add_sphere(red, {0, 3.05F, 0.2F}, 0.1F, 8);
  Geometry green;
  add_sphere(green, {0, 2.5F, 0.2F}, 0.1F, 8);
  return {
      {add_mesh(scene, pole, m.metal)}, {add_mesh(scene, red, m.red_light)}, {add_mesh(scene, green, m.green_light)}};
}

/// The parts that all cars share; a car drives along +x.
struct Cars {
  std::vector<std::uint32_t> bodies;
  Parts rest;
};

Cars make_cars(Scene& scene, const Materials& m) {
  Geometry body;
  const std::array<glm::vec2, 8> hull{{{-2.1F, 0.32F},
                                       {2.1F, 0.32F},
                                       {2.16F, 0.55F},
                                       {2.05F, 0.76F},
                                       {1.1F, 0.92F},
                                       {-1.7F, 0.98F},
                                       {-2.1F, 0.9F},
                                       {-2.18F, 0.6F}}};
  add_prism(body, hull, -0.86F, 0.86F);
  add_box(body, {-1.05F, 1.38F, -0.62F}, {0.3F, 1.45F, 0.62F});
  Geometry cabin;
  const std::array<glm::vec2, 4> glass{{{-1.75F, 0.9F}, {1.05F, 0.9F}, {0.35F, 1.42F}, {-1.15F, 1.42F}}};
  add_prism(cabin, glass, -0.7F, 0.7F);
  Geometry wheels;
  Geometry wheel;
  add_cylinder(wheel, 0.33F, -0.11F, 0.11F, 12);
  Geometry turned;  // the wheel's axle from +y to +z
  const glm::mat4 tilt(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0), glm::vec4(0, 0, 0, 1));
  append(turned, wheel, tilt);
  for (const float x : {-1.3F, 1.35F}) {
    for (const float z : {-0.8F, 0.8F}) append(wheels, turned, at(x, 0.33F, z));
  }
  Geometry front;
  Geometry back;
  for (const float z : {-0.6F, 0.6F}) {
    add_box(front, {2.0F, 0.56F, z - 0.14F}, {2.16F, 0.68F, z + 0.14F});
    add_box(back, {-2.19F, 0.66F, z - 0.14F}, {-2.0F, 0.78F, z + 0.14F});
  }
  Cars cars;
  for (const std::uint32_t paint : m.paints) cars.bodies.push_back(add_mesh(scene, body, paint));
  cars.rest = {{add_mesh(scene, cabin, m.glass)},
               {add_mesh(scene, wheels, m.rubber)},
               {add_mesh(scene, front, m.lamp)},
               {add_mesh(scene, back, m.red_light)}};
  return cars;
}

Parts make_tree(Scene& scene, const Materials& m) {
  Geometry trunk;
  const std::array<glm::vec3, 4> path{{{0, -0.2F, 0}, {0.05F, 1.2F, 0.03F}, {-0.03F, 2.4F, 0.06F}, {0, 4.0F, 0}}};
  const std::array<float, 4> radii{{0.14F, 0.11F, 0.09F, 0.05F}};
  add_tube(trunk, {.path = path, .radii = radii, .sides = 7});
  Geometry leaves;
  add_crown(leaves, {.center = {0, 4.2F, 0}, .radius = 1.5F, .cards = 70, .card_m = 1.1F, .seed = 3});
  return {{add_mesh(scene, trunk, m.bark)}, {add_mesh(scene, leaves, m.leaves)}};
}

/// Bollards, a sign and a bench at every crossing of the middle street; the first sign stands half a metre before the
/// first camera, so that its picture begins near.
void add_pavement_things(Scene& scene, const Materials& m) {
  Geometry bollard;
  const std::array<glm::vec2, 6> profile{
      {{0.0F, -0.1F}, {0.09F, -0.1F}, {0.07F, 0.8F}, {0.1F, 0.84F}, {0.08F, 0.95F}, {0.0F, 1.0F}}};
  add_lathe(bollard, {.profile = profile, .segments = 12});
  const std::uint32_t bollard_mesh = add_mesh(scene, bollard, m.metal);
  Geometry bench;
  for (int slat = 0; slat < 4; ++slat) {
    const float z = static_cast<float>(slat) * 0.12F;
    add_box(bench, {-0.9F, 0.42F, z}, {0.9F, 0.46F, z + 0.09F});
    add_box(bench, {-0.9F, 0.5F + z, 0.46F}, {0.9F, 0.59F + z, 0.5F});
  }
  for (const float x : {-0.7F, 0.7F}) add_box(bench, {x - 0.03F, -0.05F, 0.02F}, {x + 0.03F, 0.43F, 0.44F});
  for (const float x : {-0.7F, 0.7F}) add_box(bench, {x - 0.03F, 0.3F, 0.43F}, {x + 0.03F, 0.95F, 0.47F});
  const std::uint32_t bench_mesh = add_mesh(scene, bench, m.bark);
  Geometry sign;
  add_cylinder(sign, 0.03F, -0.1F, 3.0F, 12);
  add_box(sign, {-0.06F, 2.35F, -0.3F}, {-0.028F, 2.95F, 0.3F});
  const std::uint32_t sign_mesh = add_mesh(scene, sign, m.metal);
  for (int i = 0; i < BLOCKS_X; ++i) {
    const float x = crossing_at(i, 0).x + HALF_STREET;
    place(scene, sign_mesh, at(x + 1.79F, PAVEMENT_Y, HALF_STREET + 0.59F));
    for (const float z : {-HALF_STREET - 0.5F, HALF_STREET + 0.5F}) {
      for (const float step : {0.6F, 4.6F, 6.2F, 7.8F}) place(scene, bollard_mesh, at(x + step, PAVEMENT_Y, z));
    }
    place(scene, bench_mesh, at(x + 14.0F, PAVEMENT_Y, HALF_STREET + 1.9F));
  }
}

}  // namespace

void add_streets(Scene& scene, const Materials& m) {
  Geometry road;
  Geometry crossings;
  Geometry plain;
  Geometry pavement;
  Geometry grass;
  for_each_street([&](glm::vec2 from, glm::vec2 to) { add_street(road, crossings, from, to); });
  for (int i = 0; i <= BLOCKS_X; ++i) {
    for (int k = 0; k <= BLOCKS_Z; ++k) {
      const glm::vec2 c = crossing_at(i, k);
      add_roadway(plain, c - glm::vec2(HALF_STREET, 0), c + glm::vec2(HALF_STREET, 0));
      if (i == BLOCKS_X || k == BLOCKS_Z) continue;
      const glm::vec2 b = block_at(i, k);
      const glm::vec2 h = BLOCK_M / 2.0F;
      add_box(pavement, {b.x - h.x, -0.3F, b.y - h.y}, {b.x + h.x, PAVEMENT_Y, b.y + h.y});
      const glm::vec2 g = h - 4.0F;
      if (is_park(i, k)) add_box(grass, {b.x - g.x, 0.0F, b.y - g.y}, {b.x + g.x, PAVEMENT_Y + 0.08F, b.y + g.y});
    }
  }
  const glm::vec2 end = crossing_at(BLOCKS_X, BLOCKS_Z) + HALF_STREET;
  Geometry rim;  // the pavement outside the outermost streets
  add_frame(rim, {end, end + 6.0F, glm::vec2(-0.3F), glm::vec2(PAVEMENT_Y)});
  append(pavement, rim, at(0, 0, 0));
  add_once(scene, road, m.road);
  add_once(scene, crossings, m.crossing);
  add_once(scene, plain, m.asphalt);
  add_once(scene, pavement, m.pavement);
  add_once(scene, grass, m.grass);
}

void add_street_furniture(Scene& scene, const Materials& m) {
  Random random(77);
  const Parts lamp = make_lamp(scene, m);
  const Parts signal = make_signal(scene, m);
  const Parts tree = make_tree(scene, m);
  const Cars cars = make_cars(scene, m);
  for_each_street([&](glm::vec2 from, glm::vec2 to) {
    const glm::vec2 along = glm::normalize(to - from);
    const glm::vec2 across(-along.y, along.x);  // right of the way
    const float turn = std::atan2(-along.y, along.x);
    const auto spot = [&](float forward, float sideways, float y) {
      const glm::vec2 p = from + along * forward + across * sideways;
      return glm::vec3(p.x, y, p.y);
    };
    place_all(scene, lamp, at(spot(17.0F, HALF_STREET + 0.7F, PAVEMENT_Y), turn + PI / 2.0F));
    place_all(scene, lamp, at(spot(41.0F, -HALF_STREET - 0.7F, PAVEMENT_Y), turn - PI / 2.0F));
    for (const float side : {-1.0F, 1.0F}) {
      for (float x = 12.0F; x < 48.0F; x += random.between(6.0F, 16.0F)) {
        if (!random.chance(0.3F)) continue;
        const glm::mat4 where = at(spot(x, side * (HALF_STREET - 1.25F), 0.0F), side > 0.0F ? turn : turn + PI);
        place(scene, cars.bodies[random.below(static_cast<std::uint32_t>(cars.bodies.size()))], where);
        place_all(scene, cars.rest, where);
      }
    }
    if (random.chance(0.7F)) {
      const float size = random.between(0.9F, 1.3F);
      const float tree_turn = random.between(0, 6.0F);
      place_all(scene, tree, at(spot(25.0F, HALF_STREET + 1.2F, PAVEMENT_Y), tree_turn, size));
    }
  });
  for (int i = 0; i < BLOCKS_X; ++i) {
    for (int k = 0; k < BLOCKS_Z; ++k) {
      const glm::vec2 corner = crossing_at(i, k) + HALF_STREET + 0.5F;
      place_all(scene, signal, at({corner.x, PAVEMENT_Y, corner.y}, i % 2 == 0 ? 0.0F : PI / 2.0F));
      for (int t = 0; is_park(i, k) && t < 24; ++t) {
        const float z = random.between(-1, 1);
        const float x = random.between(-1, 1);
        const glm::vec2 p = block_at(i, k) + (BLOCK_M / 2.0F - 6.0F) * glm::vec2(x, z);
        const float size = random.between(0.9F, 1.8F);
        const float turn = random.between(0, 6.0F);
        place_all(scene, tree, at({p.x, PAVEMENT_Y, p.y}, turn, size));
      }
    }
  }
  add_pavement_things(scene, m);
}

}  // namespace lamp::app::procedural::blocks
