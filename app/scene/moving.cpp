// Moves instances.
// SPDX-License-Identifier: Apache-2.0
#include "scene/moving.h"

#include <cmath>
#include <optional>

#include "scene/procedural_random.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

constexpr float LARGEST_M = 1.5F;  // across, of what moves
constexpr float DRIFT_M = 0.3F;
constexpr float RISE_M = 0.2F;
constexpr float TURN = 6.2831853F;

/// About the vertical through `middle`, then away from there.
glm::mat4 moved(const glm::mat4& from, const glm::vec3& middle, float angle, const glm::vec3& away) {
  const float c = std::cos(angle);
  const float s = std::sin(angle);
  const glm::mat3 turn(glm::vec3(c, 0.0F, -s), glm::vec3(0.0F, 1.0F, 0.0F), glm::vec3(s, 0.0F, c));
  glm::mat4 to(1.0F);
  for (int i = 0; i < 3; ++i) to[i] = glm::vec4(turn * glm::vec3(from[i]), 0.0F);
  to[3] = glm::vec4(turn * (glm::vec3(from[3]) - middle) + middle + away, 1.0F);
  return to;
}

}  // namespace

std::vector<Instance> moved_instances(const Scene& at_rest, std::uint32_t frame, std::uint32_t frames) {
  std::vector<Instance> instances = at_rest.instances;
  std::vector<std::optional<Box>> boxes(at_rest.meshes.size());
  const float share = static_cast<float>(frame % frames) / static_cast<float>(frames);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    procedural::Random random(i);
    const bool moves = random.chance(1.0F / 3.0F);
    const float phase = random.unit();
    const Mesh& mesh = at_rest.meshes[instances[i].mesh];
    if (!moves || triangle_count(mesh) == 0) continue;
    std::optional<Box>& box = boxes[instances[i].mesh];
    if (!box) box = mesh_box(at_rest, mesh);
    const glm::mat4& m = instances[i].world_from_object;
    const glm::vec3 size = box->max - box->min;
    const glm::vec3 across(glm::length(glm::vec3(m[0])), glm::length(glm::vec3(m[1])), glm::length(glm::vec3(m[2])));
    if (!(glm::length(size * across) <= LARGEST_M)) continue;
    const glm::vec3 middle(m * glm::vec4((box->min + box->max) * 0.5F, 1.0F));
    const float angle = TURN * (share + phase);
    const glm::vec3 away(DRIFT_M * std::cos(angle), RISE_M * std::sin(2.0F * angle), DRIFT_M * std::sin(angle));
    instances[i].world_from_object = moved(m, middle, TURN * share, away);
  }
  return instances;
}

}  // namespace lamp::app
