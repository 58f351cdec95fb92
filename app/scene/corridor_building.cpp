// The corridor's walls with their door openings, floors, ceiling, doors, pipes and lamps.
// Based on: nothing.
// Promise: walls share corners at door heights (no T-joints in sight) and reach into floors and ceiling.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <vector>

#include "scene/corridor.h"
#include "scene/mesh_builder.h"

namespace lamp::app::procedural::corridor {
namespace {

/// A straight wall along x in the plane z = 0 with door openings, `thick` around it; no ends and no top.
struct Wall {
  float from, to;            ///< x
  std::vector<float> doors;  ///< middles, ascending
  float thick = WALL_M;
};

void add_wall(Geometry& geometry, const Wall& wall) {
  const float z = wall.thick / 2.0F;
  const auto faces = [&](float x0, float x1, float y0, float y1) {
    add_quad(geometry, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    add_quad(geometry, {x1, y0, -z}, {x0, y0, -z}, {x0, y1, -z}, {x1, y1, -z});
  };
  constexpr float FOOT = -0.05F;
  constexpr float TOP = HEIGHT_M + 0.05F;
  float x = wall.from;
  for (const float door : wall.doors) {
    const float left = door - DOOR_M / 2.0F;
    const float right = door + DOOR_M / 2.0F;
    faces(x, left, FOOT, DOOR_Y);
    faces(x, left, DOOR_Y, TOP);
    faces(left, right, DOOR_Y, TOP);
    add_quad(geometry, {left, FOOT, z}, {left, FOOT, -z}, {left, DOOR_Y, -z}, {left, DOOR_Y, z});
    add_quad(geometry, {right, FOOT, -z}, {right, FOOT, z}, {right, DOOR_Y, z}, {right, DOOR_Y, -z});
    add_quad(geometry, {left, DOOR_Y, -z}, {right, DOOR_Y, -z}, {right, DOOR_Y, z}, {left, DOOR_Y, z});
    x = right;
  }
  faces(x, wall.to, FOOT, DOOR_Y);
  faces(x, wall.to, DOOR_Y, TOP);
}

/// The frame around a door opening in the plane z = 0, centred on x = 0, and its threshold.
Geometry door_frame() {
  constexpr float REACH = WALL_M / 2.0F + 0.02F;
  constexpr float HALF = DOOR_M / 2.0F;
  Geometry frame;
  for (const float side : {-1.0F, 1.0F}) {
    const float x = side * (HALF + 0.02F);
    add_box(frame, {x - 0.06F, -0.02F, -REACH}, {x + 0.06F, DOOR_Y + 0.04F, REACH});
  }
  add_box(frame, {-HALF - 0.1F, DOOR_Y - 0.03F, -REACH - 0.005F}, {HALF + 0.1F, DOOR_Y + 0.08F, REACH + 0.005F});
  add_box(frame, {-HALF, -0.03F, -0.11F}, {HALF, 0.012F, 0.11F});
  return frame;
}

struct DoorWay {
  glm::vec3 foot;
  float turn;
};

/// Every opening of the plan.
std::vector<DoorWay> doorways() {
  std::vector<DoorWay> all;
  for (const int side : {-1, 1}) {
    for (int room = 0; room < ROOMS; ++room) {
      all.push_back({{door_x(room, side), 0, static_cast<float>(side) * WALL_Z}, side > 0 ? 0.0F : PI});
    }
  }
  all.push_back({{2.0F * ROOM_M, 0, 4.6F}, PI / 2.0F});   // between the second and the third room
  all.push_back({{3.0F * ROOM_M, 0, -4.2F}, PI / 2.0F});  // between the third and the fourth, on the other side
  return all;
}

void add_walls(Scene& scene, const Materials& m) {
  Geometry corridor_walls;
  for (const int side : {-1, 1}) {
    std::vector<float> doors;
    doors.reserve(ROOMS);
    for (int room = 0; room < ROOMS; ++room) doors.push_back(door_x(room, side));
    Geometry wall;
    add_wall(wall, {.from = -0.1F, .to = END_X + 0.1F, .doors = doors});
    append(corridor_walls, wall, at(0, 0, static_cast<float>(side) * WALL_Z));
  }
  add_once(scene, corridor_walls, m.plaster);
  Geometry partitions;
  for (const float side : {-1.0F, 1.0F}) {
    for (int i = 1; i <= ROOMS; ++i) {
      const float x = static_cast<float>(i) * ROOM_M;
      std::vector<float> doors;
      if (side > 0 && i == 2) doors = {-4.6F};  // along the turned wall, x is -z
      if (side < 0 && i == 3) doors = {4.2F};
      Geometry wall;
      const float near = side > 0 ? -OUTER_Z - 0.1F : WALL_Z;
      const float far = side > 0 ? -WALL_Z : OUTER_Z + 0.1F;
      add_wall(wall, {.from = near, .to = far, .doors = doors});
      append(partitions, wall, at({x, 0, 0}, PI / 2.0F));
    }
  }
  add_once(scene, partitions, m.warm_plaster);
  Geometry outer;
  add_frame(outer,
            {{HALL_X / 2.0F, OUTER_Z}, {HALL_X / 2.0F + 0.3F, OUTER_Z + 0.3F}, glm::vec2(-0.2F), glm::vec2(3.05F)});
  Geometry moved;
  append(moved, outer, at(HALL_X / 2.0F, 0, 0));
  add_once(scene, moved, m.brick);
  Geometry posts;  // what covers the ends of the corridor's walls, columns of the hall, and narrow places
  for (const float z : {-WALL_Z, WALL_Z}) {
    add_box(posts, {END_X - 0.14F, -0.05F, z - 0.16F}, {END_X + 0.2F, HEIGHT_M + 0.05F, z + 0.16F});
  }
  for (const float x : {9.0F, 21.0F}) {
    const float side = x < 15.0F ? 1.0F : -1.0F;
    const float z = side * 0.92F;
    add_box(posts, {x - 0.25F, -0.05F, std::min(z, side * 1.45F)},
            {x + 0.25F, HEIGHT_M + 0.05F, std::max(z, side * 1.45F)});
  }
  for (const glm::vec2 p :
       {glm::vec2(32.6F, -3.4F), glm::vec2(35.4F, -3.4F), glm::vec2(32.6F, 3.4F), glm::vec2(35.4F, 3.4F)}) {
    add_box(posts, {p.x - 0.25F, -0.05F, p.y - 0.25F}, {p.x + 0.25F, HEIGHT_M + 0.05F, p.y + 0.25F});
    add_box(posts, {p.x - 0.32F, -0.05F, p.y - 0.32F}, {p.x + 0.32F, 0.2F, p.y + 0.32F});
  }
  add_once(scene, posts, m.concrete);
}

void add_floors(Scene& scene, const Materials& m) {
  const auto floor = [&](std::uint32_t material, glm::vec2 from, glm::vec2 to) {
    Geometry quad;
    add_quad(quad, {from.x, 0, to.y}, {to.x, 0, to.y}, {to.x, 0, from.y}, {from.x, 0, from.y});
    add_once(scene, quad, material);
  };
  floor(m.corridor_floor, {-0.1F, -WALL_Z}, {END_X, WALL_Z});
  floor(m.corridor_floor, {END_X, -OUTER_Z - 0.1F}, {HALL_X + 0.1F, OUTER_Z + 0.1F});
  const std::array<std::uint32_t, 4> kinds{{m.wood_floor, m.carpet, m.tiles, m.wood_floor}};
  for (int room = 0; room < ROOMS; ++room) {
    const float x = static_cast<float>(room) * ROOM_M;
    const float x0 = room == 0 ? -0.1F : x;
    const auto kind = static_cast<std::size_t>(room);
    floor(kinds[kind % 4], {x0, WALL_Z}, {x + ROOM_M, OUTER_Z + 0.1F});
    floor(kinds[(kind + 2) % 4], {x0, -OUTER_Z - 0.1F}, {x + ROOM_M, -WALL_Z});
  }
  Geometry ceiling;
  add_box(ceiling, {-0.2F, HEIGHT_M, -OUTER_Z - 0.2F}, {HALL_X + 0.2F, HEIGHT_M + 0.2F, OUTER_Z + 0.2F});
  add_once(scene, ceiling, m.white);
  Geometry strip;  // where the corridor's floor meets the hall's
  add_box(strip, {END_X - 0.05F, -0.03F, -WALL_Z}, {END_X + 0.05F, 0.012F, WALL_Z});
  add_once(scene, strip, m.metal);
}

/// Frames everywhere; wooden doors ajar in most, glazed doors in some.
void add_doors(Scene& scene, const Materials& m) {
  const std::uint32_t frame = add_mesh(scene, door_frame(), m.frame);
  Geometry leaf;  // hinged at x = 0
  add_box(leaf, {0.0F, 0.03F, -0.02F}, {0.98F, DOOR_Y - 0.04F, 0.02F});
  Geometry border;
  add_box(border, {0.0F, 0.03F, -0.02F}, {0.1F, DOOR_Y - 0.04F, 0.02F});
  add_box(border, {0.88F, 0.03F, -0.02F}, {0.98F, DOOR_Y - 0.04F, 0.02F});
  add_box(border, {0.09F, 0.03F, -0.019F}, {0.89F, 0.25F, 0.019F});
  add_box(border, {0.09F, DOOR_Y - 0.16F, -0.019F}, {0.89F, DOOR_Y - 0.04F, 0.019F});
  Geometry pane;
  add_uv_quad(pane, {.corner = {0.09F, 0.24F, 0.0F}, .right = {0.8F, 0, 0}, .up = {0, DOOR_Y - 0.39F, 0}});
  Geometry knob;
  for (const float z : {-0.06F, 0.06F}) add_sphere(knob, {0.9F, 1.05F, z}, 0.035F, 12);
  const std::uint32_t leaf_mesh = add_mesh(scene, leaf, m.wood);
  const std::uint32_t border_mesh = add_mesh(scene, border, m.dark_wood);
  const std::uint32_t pane_mesh = add_mesh(scene, pane, m.glass);
  const std::uint32_t knob_mesh = add_mesh(scene, knob, m.copper);
  int number = 1;
  for (const DoorWay& way : doorways()) {
    place(scene, frame, at(way.foot, way.turn));
    const int kind = number++ % 3;
    if (kind == 2) continue;  // open: no door
    const glm::vec3 hinge = glm::vec3(at(way.foot, way.turn) * glm::vec4(-DOOR_M / 2.0F + 0.06F, 0, 0.14F, 1.0F));
    const glm::mat4 ajar = at(hinge, way.turn - (kind == 0 ? 1.35F : 1.1F));
    place(scene, knob_mesh, ajar);
    if (kind == 0) {
      place(scene, leaf_mesh, ajar);
    } else {
      place(scene, border_mesh, ajar);
      place(scene, pane_mesh, ajar);
    }
  }
}

void add_services(Scene& scene, const Materials& m) {
  Geometry pipes;
  Geometry copper;
  for (const float z : {-1.12F, -0.95F}) {
    const std::array<glm::vec3, 2> run{{{0.05F, 2.62F, z}, {HALL_X - 0.05F, 2.62F, z}}};
    const std::array<float, 2> radii{{0.055F, 0.055F}};
    add_tube(z < -1.0F ? pipes : copper, {.path = run, .radii = radii, .sides = 14});
  }
  for (int i = 0; i < 19; ++i) {  // clamps
    const float x = 1.0F + 2.0F * static_cast<float>(i);
    add_box(pipes, {x - 0.03F, 2.54F, -1.2F}, {x + 0.03F, HEIGHT_M + 0.02F, -0.87F});
  }
  add_once(scene, pipes, m.metal);
  add_once(scene, copper, m.copper);
  Geometry panel;
  add_box(panel, {-0.6F, HEIGHT_M - 0.04F, -0.15F}, {0.6F, HEIGHT_M + 0.02F, 0.15F});
  Geometry rim;
  add_box(rim, {-0.65F, HEIGHT_M - 0.02F, -0.2F}, {0.65F, HEIGHT_M + 0.03F, 0.2F});
  const std::uint32_t panel_mesh = add_mesh(scene, panel, m.lamp);
  const std::uint32_t rim_mesh = add_mesh(scene, rim, m.metal);
  for (int i = 0; i < 6; ++i) {
    for (const std::uint32_t mesh : {panel_mesh, rim_mesh})
      place(scene, mesh, at(3.0F + 6.0F * static_cast<float>(i), 0, 0.2F));
  }
  Geometry grille;  // ventilation, high in the corridor's walls
  add_uv_quad(grille, {.corner = {-0.4F, 2.3F, 0.0F}, .right = {0.8F, 0, 0}, .up = {0, 0.4F, 0}});
  Geometry back;
  add_box(back, {-0.46F, 2.26F, -0.05F}, {0.46F, 2.74F, -0.012F});
  const std::uint32_t grille_mesh = add_mesh(scene, grille, m.grille);
  const std::uint32_t back_mesh = add_mesh(scene, back, m.metal);
  for (int i = 1; i < ROOMS; ++i) {
    const glm::mat4 where = at({static_cast<float>(i) * ROOM_M, 0, WALL_Z - WALL_M / 2.0F - 0.04F}, PI);
    place(scene, grille_mesh, where);
    place(scene, back_mesh, where);
  }
}

}  // namespace

void add_building(Scene& scene, const Materials& materials) {
  add_walls(scene, materials);
  add_floors(scene, materials);
  add_doors(scene, materials);
  add_services(scene, materials);
}

}  // namespace lamp::app::procedural::corridor
