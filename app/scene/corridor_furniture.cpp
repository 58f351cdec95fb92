// What stands in the rooms: desks, chairs, shelves with books, sofas, cabinets, metal things, plants, pictures.
// Based on: nothing.
// Promise: nothing stands in a doorway or in the flight's way.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <vector>

#include "scene/corridor.h"
#include "scene/foliage.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_random.h"

namespace lamp::app::procedural::corridor {
namespace {

/// A piece of furniture: meshes that are drawn together; its back is towards -z, its middle at the origin.
using Piece = std::vector<std::uint32_t>;

void put(Scene& scene, const Piece& piece, const glm::vec3& where, float turn) {
  for (const std::uint32_t mesh : piece) place(scene, mesh, at(where, turn));
}

Piece make_desk(Scene& scene, const Materials& m) {
  Geometry top;
  add_box(top, {-0.8F, 0.72F, -0.4F}, {0.8F, 0.76F, 0.4F});
  add_box(top, {0.35F, 0.06F, -0.36F}, {0.76F, 0.73F, 0.34F});
  for (const float y : {0.12F, 0.33F, 0.54F}) add_box(top, {0.37F, y, 0.3F}, {0.74F, y + 0.18F, 0.36F});
  Geometry legs;
  for (const float z : {-0.34F, 0.34F}) add_box(legs, {-0.76F, -0.01F, z - 0.03F}, {-0.7F, 0.73F, z + 0.03F});
  add_box(legs, {0.36F, -0.01F, -0.34F}, {0.75F, 0.07F, 0.3F});
  Geometry screen;
  add_box(screen, {-0.45F, 0.86F, -0.2F}, {0.2F, 1.24F, -0.17F});
  add_box(screen, {-0.16F, 0.75F, -0.24F}, {-0.08F, 1.0F, -0.19F});
  Geometry sheets;
  for (int i = 0; i < 5; ++i) {
    const float y = 0.755F + 0.008F * static_cast<float>(i);
    add_box(sheets, {-0.6F + 0.01F * static_cast<float>(i), y, 0.05F},
            {-0.39F, y + 0.009F, 0.35F - 0.01F * static_cast<float>(i)});
  }
  return {add_mesh(scene, top, m.wood), add_mesh(scene, legs, m.metal), add_mesh(scene, screen, m.leather),
          add_mesh(scene, sheets, m.paper)};
}

Piece make_chair(Scene& scene, const Materials& m) {
  Geometry frame;
  for (const float x : {-0.2F, 0.2F}) {
    add_box(frame, {x - 0.02F, -0.01F, 0.16F}, {x + 0.02F, 0.44F, 0.2F});
    add_box(frame, {x - 0.02F, -0.01F, -0.2F}, {x + 0.02F, 0.95F, -0.16F});
  }
  Geometry seat;
  add_box(seat, {-0.24F, 0.42F, -0.23F}, {0.24F, 0.48F, 0.24F});
  add_box(seat, {-0.23F, 0.6F, -0.215F}, {0.23F, 0.93F, -0.145F});
  return {add_mesh(scene, frame, m.dark_wood), add_mesh(scene, seat, m.fabric)};
}

Piece make_shelf(Scene& scene, const Materials& m) {
  Random random(8);
  Geometry boards;
  for (const float x : {-0.62F, 0.58F}) add_box(boards, {x, -0.01F, -0.16F}, {x + 0.04F, 2.1F, 0.16F});
  add_box(boards, {-0.6F, 0.02F, -0.16F}, {0.6F, 2.08F, -0.14F});
  Geometry books;
  for (int row = 0; row < 6; ++row) {
    const float y = 0.06F + 0.4F * static_cast<float>(row);
    add_box(boards, {-0.6F, y - 0.03F, -0.15F}, {0.6F, y, 0.155F});
    if (row == 5) continue;
    for (float x = -0.56F; x < 0.5F;) {
      const float wide = random.between(0.025F, 0.06F);
      Geometry book;
      add_box(book, {x, y - 0.005F, -0.1F},
              {x + wide - 0.003F, y + random.between(0.2F, 0.32F), random.between(0.06F, 0.12F)});
      tint(book, {random.between(0.15F, 1.0F), random.between(0.15F, 0.7F), random.between(0.1F, 0.6F)});
      append(books, book, at(0, 0, 0));
      x += random.chance(0.08F) ? wide + 0.12F : wide;
    }
  }
  return {add_mesh(scene, boards, m.dark_wood), add_mesh(scene, books, m.paper)};
}

Piece make_sofa(Scene& scene, const Materials& m) {
  Geometry body;
  add_box(body, {-1.0F, 0.08F, -0.4F}, {1.0F, 0.3F, 0.42F});
  add_box(body, {-0.98F, 0.25F, -0.42F}, {0.98F, 0.85F, -0.2F});
  for (const float x : {-1.06F, 0.88F}) add_box(body, {x, 0.07F, -0.41F}, {x + 0.18F, 0.6F, 0.44F});
  Geometry cushions;
  for (const float x : {-0.86F, 0.01F}) {
    add_box(cushions, {x, 0.28F, -0.22F}, {x + 0.85F, 0.44F, 0.43F});
    add_box(cushions, {x + 0.03F, 0.42F, -0.24F}, {x + 0.82F, 0.8F, -0.08F});
  }
  Geometry feet;
  for (const float x : {-0.95F, 0.9F}) {
    for (const float z : {-0.35F, 0.35F}) add_box(feet, {x, -0.01F, z}, {x + 0.05F, 0.09F, z + 0.05F});
  }
  return {add_mesh(scene, body, m.leather), add_mesh(scene, cushions, m.fabric), add_mesh(scene, feet, m.metal)};
}

Piece make_cabinet(Scene& scene, const Materials& m) {
  Geometry body;
  add_box(body, {-0.25F, -0.01F, -0.3F}, {0.25F, 1.3F, 0.28F});
  for (int drawer = 0; drawer < 4; ++drawer) {
    const float y = 0.05F + 0.31F * static_cast<float>(drawer);
    add_box(body, {-0.23F, y, 0.25F}, {0.23F, y + 0.29F, 0.3F});
    add_box(body, {-0.07F, y + 0.2F, 0.29F}, {0.07F, y + 0.22F, 0.33F});
  }
  return {add_mesh(scene, body, m.metal)};
}

Piece make_table(Scene& scene, const Materials& m) {
  Geometry table;
  const std::array<glm::vec2, 10> profile{{{0.0F, -0.01F},
                                           {0.32F, -0.01F},
                                           {0.3F, 0.04F},
                                           {0.05F, 0.1F},
                                           {0.04F, 0.6F},
                                           {0.1F, 0.7F},
                                           {0.55F, 0.71F},
                                           {0.57F, 0.73F},
                                           {0.55F, 0.75F},
                                           {0.0F, 0.75F}}};
  add_lathe(table, {.profile = profile, .segments = 36});
  Geometry kettle;
  const std::array<glm::vec2, 14> pot{{{0.0F, 0.745F},
                                       {0.09F, 0.745F},
                                       {0.12F, 0.77F},
                                       {0.13F, 0.83F},
                                       {0.11F, 0.89F},
                                       {0.07F, 0.93F},
                                       {0.05F, 0.95F},
                                       {0.055F, 0.96F},
                                       {0.03F, 0.975F},
                                       {0.012F, 0.98F},
                                       {0.012F, 0.99F},
                                       {0.02F, 1.0F},
                                       {0.014F, 1.015F},
                                       {0.0F, 1.02F}}};
  add_lathe(kettle, {.profile = pot, .segments = 32});
  const std::array<glm::vec3, 3> spout{{{0.1F, 0.82F, 0}, {0.17F, 0.87F, 0}, {0.2F, 0.93F, 0}}};
  const std::array<float, 3> radii{{0.022F, 0.016F, 0.012F}};
  add_tube(kettle, {.path = spout, .radii = radii, .sides = 10});
  Geometry ball;
  add_sphere(ball, {-0.28F, 0.84F, 0.18F}, 0.095F, 28);
  return {add_mesh(scene, table, m.wood), add_mesh(scene, kettle, m.copper), add_mesh(scene, ball, m.metal)};
}

Piece make_plant(Scene& scene, const Materials& m) {
  Geometry pot;
  const std::array<glm::vec2, 7> profile{
      {{0.0F, -0.01F}, {0.15F, -0.01F}, {0.2F, 0.32F}, {0.22F, 0.36F}, {0.18F, 0.36F}, {0.17F, 0.3F}, {0.0F, 0.3F}}};
  add_lathe(pot, {.profile = profile, .segments = 20});
  Geometry leaves;
  add_crown(leaves, {.center = {0, 0.8F, 0}, .radius = 0.36F, .cards = 60, .card_m = 0.3F, .seed = 12});
  Geometry stem;
  const std::array<glm::vec3, 2> path{{{0, 0.25F, 0}, {0.02F, 0.85F, 0}}};
  const std::array<float, 2> radii{{0.025F, 0.012F}};
  add_tube(stem, {.path = path, .radii = radii, .sides = 6});
  return {add_mesh(scene, pot, m.clay), add_mesh(scene, leaves, m.leaves), add_mesh(scene, stem, m.dark_wood)};
}

Piece make_floor_lamp(Scene& scene, const Materials& m) {
  Geometry pole;
  const std::array<glm::vec2, 6> profile{
      {{0.0F, -0.01F}, {0.16F, -0.01F}, {0.16F, 0.02F}, {0.015F, 0.03F}, {0.015F, 1.5F}, {0.0F, 1.51F}}};
  add_lathe(pole, {.profile = profile, .segments = 16});
  Geometry shade;
  const std::array<glm::vec2, 5> cone{{{0.0F, 1.46F}, {0.2F, 1.45F}, {0.13F, 1.75F}, {0.11F, 1.76F}, {0.0F, 1.75F}}};
  add_lathe(shade, {.profile = cone, .segments = 20});
  return {add_mesh(scene, pole, m.metal), add_mesh(scene, shade, m.lamp)};
}

/// Pictures in frames, to hang on a wall behind them.
std::vector<Piece> make_pictures(Scene& scene, const Materials& m) {
  Geometry canvas;
  add_uv_quad(canvas, {.corner = {-0.35F, 1.25F, 0.02F}, .right = {0.7F, 0, 0}, .up = {0, 0.9F, 0}});
  Geometry frame;
  for (const float x : {-0.4F, 0.34F}) add_box(frame, {x, 1.2F, -0.01F}, {x + 0.06F, 2.2F, 0.045F});
  for (const float y : {1.19F, 2.13F}) add_box(frame, {-0.41F, y, -0.01F}, {0.41F, y + 0.07F, 0.05F});
  const std::uint32_t frame_mesh = add_mesh(scene, frame, m.dark_wood);
  std::vector<Piece> pieces;
  pieces.reserve(m.pictures.size());
  for (const std::uint32_t picture : m.pictures) pieces.push_back({add_mesh(scene, canvas, picture), frame_mesh});
  return pieces;
}

}  // namespace

void add_furniture(Scene& scene, const Materials& m) {
  const Piece desk = make_desk(scene, m);
  const Piece chair = make_chair(scene, m);
  const Piece shelf = make_shelf(scene, m);
  const Piece sofa = make_sofa(scene, m);
  const Piece cabinet = make_cabinet(scene, m);
  const Piece table = make_table(scene, m);
  const Piece plant = make_plant(scene, m);
  const Piece lamp = make_floor_lamp(scene, m);
  const std::vector<Piece> pictures = make_pictures(scene, m);
  for (int room = 0; room < ROOMS; ++room) {
    for (const int side : {-1, 1}) {
      const float s = static_cast<float>(side);
      const float x = (static_cast<float>(room) + 0.5F) * ROOM_M;
      const float back = s * (OUTER_Z - 0.25F);  // along the outer wall
      const float face = side > 0 ? PI : 0.0F;   // away from the outer wall
      const auto row = [&](const Piece& piece, float dx, float inward) {
        put(scene, piece, {x + dx, 0, back - s * inward}, face);
      };
      const bool office = (room + (side > 0 ? 0 : 1)) % 2 == 0;
      if (office) {
        row(shelf, -2.1F, 0.0F);
        row(shelf, -0.7F, 0.0F);
        row(cabinet, 0.5F, 0.15F);
        row(cabinet, 1.1F, 0.15F);
        put(scene, desk, {x + 0.3F, 0, back - s * 2.2F}, face + 0.1F);
        put(scene, chair, {x + 0.2F, 0, back - s * 1.45F}, face + 0.3F);
      } else {
        row(sofa, -0.9F, 0.3F);
        row(lamp, 0.9F, 0.2F);
        row(shelf, 1.9F, 0.0F);
        put(scene, table, {x - 0.7F, 0, back - s * 1.7F}, 0.4F);
        put(scene, chair, {x + 0.4F, 0, back - s * 2.0F}, face - 2.2F);
      }
      put(scene, plant, {x + 2.5F, 0, s * 2.0F}, x);
      row(pictures[static_cast<std::size_t>(room) % pictures.size()], office ? 2.2F : -0.9F, -0.23F);
    }
  }
  for (const float z : {-4.6F, 4.6F}) {  // the hall
    put(scene, sofa, {34.0F, 0, z}, z > 0.0F ? PI : 0.0F);
    put(scene, table, {34.0F, 0, z * 0.72F}, 1.0F);
    put(scene, plant, {37.3F, 0, z * 1.2F}, 2.0F);
    put(scene, pictures[0], {HALL_X - 0.02F, 0, z * 0.6F}, -PI / 2.0F);
  }
  for (int i = 0; i < 4; ++i) {  // in the corridor
    const float x = 1.4F + 6.0F * static_cast<float>(i);
    put(scene, pictures[static_cast<std::size_t>(i) % pictures.size()], {x, 0, -WALL_Z + WALL_M / 2.0F + 0.015F}, 0.0F);
  }
  put(scene, cabinet, {5.6F, 0, -0.97F}, 0.0F);
  put(scene, plant, {12.2F, 0, 1.02F}, 0.0F);
  put(scene, cabinet, {17.7F, 0, 0.97F}, PI);
}

}  // namespace lamp::app::procedural::corridor
