// What stands and hangs in the atrium: fountain, vases, plants, lanterns, doors, grilles and panes.
// Based on: nothing; lathes, and leaf cards scattered over a sphere.
// Promise: deterministic; nothing of it stands in the flight's way.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "scene/atrium.h"
#include "scene/foliage.h"
#include "scene/mesh_builder.h"

namespace lamp::app::procedural::atrium {
namespace {

std::uint32_t lathe_mesh(Scene& scene, std::uint32_t material, std::span<const glm::vec2> profile,
                         std::uint32_t segments) {
  Geometry geometry;
  add_lathe(geometry, {.profile = profile, .segments = segments});
  return add_mesh(scene, geometry, material);
}

void add_fountain(Scene& scene, const Materials& m) {
  const std::array<glm::vec2, 12> basin{{{1.85F, -0.1F},
                                         {1.85F, 0.12F},
                                         {1.7F, 0.16F},
                                         {1.6F, 0.24F},
                                         {1.6F, 0.4F},
                                         {1.7F, 0.5F},
                                         {1.78F, 0.54F},
                                         {1.78F, 0.62F},
                                         {1.5F, 0.62F},
                                         {1.45F, 0.56F},
                                         {1.4F, 0.15F},
                                         {0.0F, 0.12F}}};
  const std::array<glm::vec2, 20> bowl{{{0.42F, 0.1F},  {0.42F, 0.3F},  {0.3F, 0.38F},  {0.2F, 0.5F},   {0.16F, 0.7F},
                                        {0.2F, 0.95F},  {0.27F, 1.05F}, {0.2F, 1.12F},  {0.22F, 1.2F},  {0.5F, 1.28F},
                                        {0.78F, 1.42F}, {0.9F, 1.58F},  {0.93F, 1.58F}, {0.93F, 1.63F}, {0.86F, 1.63F},
                                        {0.72F, 1.48F}, {0.2F, 1.38F},  {0.11F, 1.5F},  {0.1F, 1.8F},   {0.16F, 1.9F}}};
  const std::array<glm::vec2, 9> finial{{{0.0F, 1.86F},
                                         {0.2F, 1.88F},
                                         {0.26F, 1.96F},
                                         {0.2F, 2.04F},
                                         {0.08F, 2.1F},
                                         {0.13F, 2.2F},
                                         {0.15F, 2.3F},
                                         {0.09F, 2.42F},
                                         {0.0F, 2.6F}}};
  place(scene, lathe_mesh(scene, m.trim, basin, 48), glm::mat4(1.0F));
  place(scene, lathe_mesh(scene, m.column, bowl, 36), glm::mat4(1.0F));
  place(scene, lathe_mesh(scene, m.bronze, finial, 24), glm::mat4(1.0F));
  const std::array<glm::vec2, 2> pool{{{1.46F, 0.47F}, {0.0F, 0.47F}}};
  const std::array<glm::vec2, 2> cup{{{0.8F, 1.57F}, {0.05F, 1.57F}}};
  place(scene, lathe_mesh(scene, m.water, pool, 48), glm::mat4(1.0F));
  place(scene, lathe_mesh(scene, m.water, cup, 36), glm::mat4(1.0F));
}

void add_vases(Scene& scene, const Materials& m) {
  const std::array<glm::vec2, 17> vase{{{0.0F, 0.9F},
                                        {0.2F, 0.9F},
                                        {0.21F, 0.96F},
                                        {0.11F, 1.02F},
                                        {0.1F, 1.08F},
                                        {0.24F, 1.22F},
                                        {0.36F, 1.42F},
                                        {0.4F, 1.6F},
                                        {0.36F, 1.76F},
                                        {0.2F, 1.9F},
                                        {0.16F, 1.98F},
                                        {0.18F, 2.06F},
                                        {0.27F, 2.12F},
                                        {0.27F, 2.15F},
                                        {0.22F, 2.15F},
                                        {0.13F, 2.05F},
                                        {0.0F, 1.95F}}};
  Geometry plinth;
  add_box(plinth, {-0.38F, -0.02F, -0.38F}, {0.38F, 0.14F, 0.38F});
  add_box(plinth, {-0.3F, 0.1F, -0.3F}, {0.3F, 0.82F, 0.3F});
  add_box(plinth, {-0.36F, 0.78F, -0.36F}, {0.36F, 0.905F, 0.36F});
  const std::uint32_t plinth_mesh = add_mesh(scene, plinth, m.trim);
  const std::uint32_t bronze_vase = lathe_mesh(scene, m.bronze, vase, 28);
  const std::uint32_t clay_vase = lathe_mesh(scene, m.terracotta, vase, 28);
  for (const float x : {-6.4F, 6.4F}) {
    for (const float z : {-2.75F, 2.75F}) {
      place(scene, plinth_mesh, at(x, 0, z));
      place(scene, x * z > 0.0F ? bronze_vase : clay_vase, at(x, 0, z));
    }
  }
}

void add_trees(Scene& scene, const Materials& m) {
  const std::array<glm::vec2, 8> pot{{{0.0F, 0.0F},
                                      {0.26F, 0.0F},
                                      {0.36F, 0.5F},
                                      {0.41F, 0.52F},
                                      {0.41F, 0.62F},
                                      {0.35F, 0.62F},
                                      {0.33F, 0.52F},
                                      {0.0F, 0.52F}}};
  const std::array<glm::vec3, 4> path{{{0, 0.45F, 0}, {0.03F, 0.9F, 0.02F}, {-0.02F, 1.3F, 0.03F}, {0, 1.75F, 0}}};
  const std::array<float, 4> radii{{0.05F, 0.042F, 0.036F, 0.028F}};
  Geometry trunk;
  add_tube(trunk, {.path = path, .radii = radii, .sides = 8});
  const std::uint32_t pot_mesh = lathe_mesh(scene, m.terracotta, pot, 24);
  const std::uint32_t trunk_mesh = add_mesh(scene, trunk, m.wood);
  Geometry leaves;
  add_crown(leaves, {.center = {0, 1.95F, 0}, .radius = 0.55F, .cards = 170, .card_m = 0.35F, .seed = 5});
  const std::uint32_t crown_mesh = add_mesh(scene, leaves, m.leaves);
  for (const float x : {-9.6F, -3.2F, 3.2F, 9.6F}) {
    for (const float z : {-3.05F, 3.05F}) {
      for (const std::uint32_t mesh : {pot_mesh, trunk_mesh, crown_mesh}) place(scene, mesh, at({x, 0, z}, x + z));
    }
  }
}

void add_lanterns(Scene& scene, const Materials& m) {
  const std::array<glm::vec2, 10> metal{{{0.0F, 3.62F},
                                         {0.1F, 3.64F},
                                         {0.12F, 3.68F},
                                         {0.1F, 3.7F},
                                         {0.02F, 3.76F},
                                         {0.02F, 3.8F},
                                         {0.012F, 3.82F},
                                         {0.012F, 4.75F},
                                         {0.008F, 4.76F},
                                         {0.0F, 4.76F}}};
  const std::array<glm::vec2, 8> base{{{0.0F, 3.2F},
                                       {0.02F, 3.22F},
                                       {0.03F, 3.26F},
                                       {0.06F, 3.29F},
                                       {0.07F, 3.32F},
                                       {0.07F, 3.35F},
                                       {0.05F, 3.36F},
                                       {0.0F, 3.36F}}};
  const std::array<glm::vec2, 6> globe{
      {{0.04F, 3.34F}, {0.095F, 3.41F}, {0.11F, 3.49F}, {0.1F, 3.57F}, {0.07F, 3.64F}, {0.0F, 3.645F}}};
  const std::array<std::uint32_t, 3> meshes{{lathe_mesh(scene, m.bronze, metal, 16),
                                             lathe_mesh(scene, m.bronze, base, 16),
                                             lathe_mesh(scene, m.lamp, globe, 16)}};
  for (const Bay& bay : bays_around(8, 3, COURT)) {
    for (const std::uint32_t mesh : meshes) place(scene, mesh, at(bay.middle, 0.0F));
  }
}

/// Doors and grilles in the niches of the ground floor, panes in the windows of the gallery.
void add_fillings(Scene& scene, const Materials& m) {
  Geometry door;
  add_box(door, {-0.9F, AISLE_Y - 0.05F, 0.05F}, {-0.008F, 3.3F, 0.13F});
  add_box(door, {0.008F, AISLE_Y - 0.05F, 0.05F}, {0.9F, 3.3F, 0.13F});
  Geometry knobs;
  add_sphere(knobs, {-0.1F, 1.2F, 0.03F}, 0.045F, 12);
  add_sphere(knobs, {0.1F, 1.2F, 0.03F}, 0.045F, 12);
  Geometry grille;
  add_uv_quad(grille, {.corner = {0.9F, AISLE_Y, -0.06F}, .right = {-1.8F, 0, 0}, .up = {0, 3.1F, 0}});
  Geometry pane;
  add_uv_quad(pane, {.corner = {0.75F, 6.59F, 0.0F}, .right = {-1.5F, 0, 0}, .up = {0, 2.25F, 0}});
  const std::uint32_t door_mesh = add_mesh(scene, door, m.wood);
  const std::uint32_t knob_mesh = add_mesh(scene, knobs, m.bronze);
  const std::uint32_t grille_mesh = add_mesh(scene, grille, m.fretwork);
  const std::uint32_t pane_mesh = add_mesh(scene, pane, m.glass);
  for (const Bay& bay : bays_around(10, 5, OUTER + 0.2F)) {
    const glm::mat4 placed = at(bay.middle, bay.turn);
    place(scene, pane_mesh, placed);
    if (bay.number % 2 == 0) {
      place(scene, door_mesh, placed);
      place(scene, knob_mesh, placed);
    } else {
      place(scene, grille_mesh, placed);
    }
  }
}

void add_benches(Scene& scene, const Materials& m) {
  Geometry bench;
  add_box(bench, {-0.85F, 0.4F, -0.24F}, {0.85F, 0.5F, 0.24F});
  for (const float x : {-0.6F, 0.6F}) add_box(bench, {x - 0.1F, -0.02F, -0.18F}, {x + 0.1F, 0.42F, 0.18F});
  const std::uint32_t mesh = add_mesh(scene, bench, m.trim);
  for (const float x : {-8.0F, -4.8F, 4.8F, 8.0F}) {
    for (const float z : {-3.25F, 3.25F}) place(scene, mesh, at(x, 0, z));
  }
}

}  // namespace

void add_decor(Scene& scene, const Materials& materials) {
  add_fountain(scene, materials);
  add_vases(scene, materials);
  add_trees(scene, materials);
  add_lanterns(scene, materials);
  add_fillings(scene, materials);
  add_benches(scene, materials);
}

}  // namespace lamp::app::procedural::atrium
