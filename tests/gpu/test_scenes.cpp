// Makes and keeps the tests' scenes.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/test_scenes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>

#include "scene/flight.h"

namespace lamp::app {
namespace {

std::map<std::string, std::unique_ptr<TestScene>> scenes;

void add_facing_quad(Scene& scene, const View& view, glm::uvec2 pixel, double z_view) {
  constexpr std::array<glm::uvec2, 4> COUNTER_CLOCKWISE{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const glm::uvec2 corner : COUNTER_CLOCKWISE) {
    Vertex vertex;
    const glm::dvec3 position = view.view_position(glm::dvec2(pixel + corner), z_view);
    vertex.position = glm::vec3(glm::dmat4(view.world_from_view()) * glm::dvec4(position, 1.0));
    vertex.normal = glm::vec3(glm::dmat4(view.world_from_view())[2]);
    vertex.tangent = glm::vec4(glm::vec3(glm::dmat4(view.world_from_view())[0]), 1.0F);
    scene.vertices.push_back(vertex);
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) scene.indices.push_back(first + i);
}

}  // namespace

const TestScene& builtin_test_scene(std::string_view name) {
  if (scenes.empty()) at_context_end([] { scenes.clear(); });
  std::unique_ptr<TestScene>& scene = scenes[std::string(name)];
  if (scene == nullptr)
    scene = std::make_unique<TestScene>(std::ranges::find(builtin_scenes(), name, &BuiltinScene::name)->make());
  return *scene;
}

std::vector<BuiltinScene> ordinary_scenes() {
  std::vector<BuiltinScene> rows(builtin_scenes().begin(), builtin_scenes().end());
  std::erase_if(rows, [](const BuiltinScene& row) { return row.adversarial; });
  return rows;
}

std::vector<BuiltinScene> adversarial_scenes() {
  std::vector<BuiltinScene> rows(builtin_scenes().begin(), builtin_scenes().end());
  std::erase_if(rows, [](const BuiltinScene& row) { return !row.adversarial; });
  return rows;
}

std::vector<std::string_view> tested_projections() {
  std::vector<std::string_view> names(projection_names().begin(), projection_names().end());
  std::erase(names, "camera");
  return names;
}

std::string test_name(std::string_view name) {
  std::string letters(name);
  std::ranges::replace_if(letters, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return letters;
}

Scene relief_of(const View& view, std::span<const float> depth) {
  Scene scene;
  scene.name = "relief";
  scene.materials.push_back({.name = "grey", .base_color = glm::vec4(0.6F, 0.5F, 0.4F, 1.0F), .roughness = 0.5F});
  for (std::uint32_t y = 0; y < view.height(); ++y) {
    for (std::uint32_t x = 0; x < view.width(); ++x) {
      const float d = depth[std::size_t{y} * view.width() + x];
      if (d > 0.0F) add_facing_quad(scene, view, {x, y}, view.z_view(d));
    }
  }
  if (scene.indices.empty()) return scene;  // only sky: nothing to draw
  scene.meshes.push_back({.index_count = static_cast<std::uint32_t>(scene.indices.size())});
  scene.instances.push_back({});
  return scene;
}

}  // namespace lamp::app
