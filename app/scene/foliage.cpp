// Crowns, slender trees and reeds, made of tubes and small sheets.
// Based on: nothing; points on spheres, bent paths.
// Promise: see the header.
// SPDX-License-Identifier: Apache-2.0
#include "scene/foliage.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scene/procedural_random.h"

namespace lamp::app::procedural {
namespace {

constexpr float TURN = 2.0F * std::numbers::pi_v<float>;

/// A direction whose height above the horizon has the sine `y`.
glm::vec3 direction(float turn, float y) {
  const float ring = std::sqrt(std::max(0.0F, 1.0F - y * y));
  return {ring * std::cos(turn), y, ring * std::sin(turn)};
}

/// Any way around, `y` between two sines. One draw a line here and wherever scenes draw: compilers differ in which
/// argument of a call they evaluate first.
glm::vec3 draw_direction(Random& random, float low, float high) {
  const float y = random.between(low, high);
  return direction(random.between(0.0F, TURN), y);
}

/// A diamond leaf that starts at `foot` and points along `along`; `face` is roughly its front.
void add_leaf(Geometry& geometry, const glm::vec3& foot, const glm::vec3& along, const glm::vec3& face, float length) {
  const glm::vec3 side = glm::normalize(glm::cross(along, face)) * (length * 0.3F);
  const glm::vec3 middle = foot + along * (length * 0.45F);
  add_quad(geometry, foot, middle + side, foot + along * length, middle - side);
}

/// A bent path from `from`, `count` steps long.
std::vector<glm::vec3> bent_path(Random& random, const glm::vec3& from, const glm::vec3& span, float bend, int count) {
  std::vector<glm::vec3> path;
  const glm::vec3 sway = direction(random.between(0, TURN), 0.0F) * bend;
  const float phase = random.between(0.0F, TURN);
  for (int i = 0; i <= count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count);
    path.push_back(from + span * t + sway * (std::sin(t * 4.0F + phase) - std::sin(phase)) * t);
  }
  return path;
}

void add_tapered(Geometry& geometry, const std::vector<glm::vec3>& path, glm::vec2 radii, std::uint32_t sides) {
  std::vector<float> radius;
  radius.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    radius.push_back(std::lerp(radii.x, radii.y, static_cast<float>(i) / static_cast<float>(path.size() - 1)));
  }
  add_tube(geometry, {.path = path, .radii = radius, .sides = sides});
}

}  // namespace

void add_crown(Geometry& geometry, const Crown& crown) {
  Random random(crown.seed);
  for (int i = 0; i < crown.cards; ++i) {
    const float height = random.between(-0.75F, 1.0F);
    const glm::vec3 out = direction(random.between(0.0F, TURN), height);
    glm::vec3 lean;
    for (int axis = 2; axis >= 0; --axis) lean[axis] = random.unit();
    const glm::vec3 normal = glm::normalize(out + 0.5F * lean + 0.01F);
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.1F, 1, 0.05F), normal));
    const glm::vec3 up = glm::cross(normal, right);
    const float size = crown.card_m * random.between(0.8F, 1.2F);
    const glm::vec3 middle = crown.center + out * (crown.radius * std::cbrt(random.between(0.25F, 1.0F)));
    const float u = random.unit();
    add_uv_quad(geometry, {.corner = middle - (right + up) * (size / 2.0F),
                           .right = right * size,
                           .up = up * size,
                           .uv = {u, random.unit()}});
  }
}

TreeParts slender_tree(const SlenderTree& tree) {
  Random random(tree.seed);
  TreeParts parts;
  const std::vector<glm::vec3> trunk =
      bent_path(random, glm::vec3(0, -0.25F, 0), {0, tree.height + 0.25F, 0}, 0.03F * tree.height, 7);
  add_tapered(parts.wood, trunk, {tree.radius, 0.25F * tree.radius}, 7);
  for (int i = 0; i < tree.branches; ++i) {
    const std::size_t joint = 3 + static_cast<std::size_t>(i) % 4;
    const float part = random.unit();
    const glm::vec3 from = glm::mix(trunk[joint], trunk[joint + 1], part);
    const float length = tree.height * random.between(0.1F, 0.2F);
    const glm::vec3 span = draw_direction(random, 0.25F, 0.7F) * length;
    const std::vector<glm::vec3> branch = bent_path(random, from, span, 0.1F * length, 2);
    add_tapered(parts.wood, branch, {0.3F * tree.radius, 0.08F * tree.radius}, 4);
    parts.twigs.push_back(branch.back());
    for (int leaf = 0; leaf < tree.leaves / tree.branches; ++leaf) {
      const float along = random.between(0.3F, 1.1F);
      const float off = random.between(0, 0.22F);
      const glm::vec3 scatter = draw_direction(random, -1, 1) * off;
      const glm::vec3 way = draw_direction(random, -0.9F, 0.3F);
      const glm::vec3 face = draw_direction(random, 0.2F, 0.9F);
      add_leaf(parts.leaves, from + span * along + scatter, way, face + 0.1F, tree.leaf_m * random.between(0.7F, 1.3F));
    }
  }
  return parts;
}

ReedParts reed_clump(const ReedClump& clump) {
  Random random(clump.seed);
  ReedParts parts;
  for (int i = 0; i < clump.stems; ++i) {
    const float ring = clump.spread * std::sqrt(random.unit());
    const glm::vec3 foot = direction(random.between(0, TURN), 0.0F) * ring - glm::vec3(0, 0.2F, 0);
    const float height = clump.height * random.between(0.7F, 1.25F);
    const glm::vec3 lean = direction(random.between(0, TURN), 0.0F) * (0.12F * height);
    const std::vector<glm::vec3> stem = bent_path(random, foot, lean + glm::vec3(0, height, 0), 0.05F, 3);
    add_tapered(parts.stems, stem, {0.012F, 0.007F}, 4);
    const glm::vec3 axis = glm::normalize(stem[3] - stem[2]);
    if (random.chance(0.6F)) {
      add_tapered(parts.heads, {stem[3] - axis * 0.05F, stem[3] + axis * 0.02F, stem[3] + axis * 0.2F}, {0.02F, 0.014F},
                  6);
    }
    for (int blade = 0; blade < 2; ++blade) {
      const glm::vec3 out = direction(random.between(0, TURN), 0.0F);
      const glm::vec3 side = glm::cross(glm::vec3(0, 1, 0), out);
      const float length = height * random.between(0.5F, 0.8F);
      add_grid(parts.blades, {.columns = 1, .rows = 5, .size_m = {0.04F, length}, .surface = [=](glm::vec2 uv) {
                                const float wide = 0.016F * (1.0F - 0.9F * uv.y * uv.y);
                                const float away = 0.45F * length * uv.y * uv.y;
                                const float up = length * (uv.y - 0.25F * uv.y * uv.y * uv.y);
                                return foot + side * (wide * (2.0F * uv.x - 1.0F)) + out * away + glm::vec3(0, up, 0);
                              }});
    }
  }
  return parts;
}

}  // namespace lamp::app::procedural
