// Scenes with numbered triangles, the triangles that lists are made for, and which generated lights stand still.
// SPDX-License-Identifier: Apache-2.0
#include "scene/still_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "scene/builtin.h"
#include "scene/number_triangles.h"
#include "scene/place_lights.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

const Scene& scene_of(std::string_view name) {
  static std::map<std::string, Scene, std::less<>> made;
  auto found = made.find(name);
  if (found == made.end())
    found = made.emplace(name, std::ranges::find(builtin_scenes(), name, &BuiltinScene::name)->make()).first;
  return found->second;
}

std::array<Vertex, 3> corners(const Scene& scene, const Mesh& mesh, std::uint32_t triangle) {
  std::array<Vertex, 3> all;
  for (std::uint32_t i = 0; i < 3; ++i)
    all[i] = scene.vertices[scene.indices[mesh.first_index + 3 * triangle + i] + mesh.vertex_offset];
  return all;
}

bool same(const Vertex& a, const Vertex& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent && a.uv == b.uv &&
         a.color == b.color;
}

TEST(NumberTriangles, FirstCornersCountThem) {
  for (const char* name : {"corridor", "blocks"}) {
    const Scene& before = scene_of(name);
    Scene after = before;
    number_triangles(after);
    ASSERT_EQ(after.meshes.size(), before.meshes.size());
    std::set<std::uint32_t> offsets;
    for (std::size_t m = 0; m < before.meshes.size(); ++m) {
      const Mesh& mesh = after.meshes[m];
      EXPECT_TRUE(mesh.index_count == 0 || offsets.insert(mesh.vertex_offset).second) << "vertices of its own";
      ASSERT_EQ(triangle_count(mesh), triangle_count(before.meshes[m]));
      EXPECT_EQ(mesh.material, before.meshes[m].material);
      for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
        EXPECT_EQ(after.indices[mesh.first_index + 3 * t], t);
        const std::array<Vertex, 3> is = corners(after, mesh, t);
        const std::array<Vertex, 3> was = corners(before, before.meshes[m], t);
        const bool turned = (same(is[0], was[0]) && same(is[1], was[1]) && same(is[2], was[2])) ||
                            (same(is[0], was[1]) && same(is[1], was[2]) && same(is[2], was[0])) ||
                            (same(is[0], was[2]) && same(is[1], was[0]) && same(is[2], was[1]));
        EXPECT_TRUE(turned) << "triangle " << t << " of mesh " << m;
      }
    }
    EXPECT_LE(after.vertices.size(), before.vertices.size() + after.indices.size() / 3);
  }
}

TEST(StillSurfaces, ComeInstanceByInstance) {
  Scene scene = scene_of("corridor");
  number_triangles(scene);
  const std::vector<StillTriangle> triangles = still_surfaces(scene, /*painted=*/false);
  const std::vector<std::uint32_t> firsts = first_triangles(scene);
  ASSERT_EQ(firsts.size(), scene.instances.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    EXPECT_EQ(firsts[i], next);
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t t = 0; t < triangle_count(mesh); t += 7) {
      const glm::vec3 at = corners(scene, mesh, t)[0].position;
      const glm::dvec3 world(glm::dmat4(instance.world_from_object) * glm::dvec4(glm::dvec3(at), 1.0));
      EXPECT_LT(glm::distance(world, glm::dvec3(triangles[next + t].corners[0])), 1e-5);
    }
    next += triangle_count(mesh);
  }
  EXPECT_EQ(next, triangles.size());
  for (const StillTriangle& triangle : still_surfaces(scene, /*painted=*/true))
    ASSERT_EQ(triangle.normal_tilt, ANY_NORMAL);
}

TEST(StillSurfaces, NormalsLeanAsFarAsTheirTexture) {
  Scene scene;
  Material material;
  EXPECT_EQ(normal_tilt(scene, material), 0.0F);
  material.normal_texture.image = 0;
  scene.images.push_back(
      {.name = "normals", .width = 2, .height = 1, .rgba = {128, 128, 255, 255, 191, 128, 238, 255}});
  EXPECT_NEAR(normal_tilt(scene, material), 0.52F, 0.02F);  // asin(0.5)
  material.normal_scale = 0.0F;
  EXPECT_LT(normal_tilt(scene, material), 0.02F);
  material.normal_scale = 1.0F;
  scene.images[0].rgba = {255, 128, 100, 255, 128, 128, 255, 255};  // one looks into the surface
  EXPECT_EQ(normal_tilt(scene, material), ANY_NORMAL);
  material.normal_texture.image = -1;
  material.double_sided = true;
  EXPECT_EQ(normal_tilt(scene, material), ANY_NORMAL);
}

TEST(PlaceLights, TheLastOnesStandStill) {
  const Scene& scene = scene_of("corridor");
  const OpenAir air = find_open_air(scene);
  const auto at = [&](std::uint32_t frame, float still) {
    return place_lights(air, {.count = 40, .still = still, .frame = frame});
  };
  EXPECT_EQ(still_count({.count = 40, .still = 0.25F}), 10U);
  const std::vector<Light> begin = at(0, 0.25F);
  const std::vector<Light> later = at(77, 0.25F);
  const std::vector<Light> all_move = at(77, 0.0F);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(later[i].position == begin[i].position, i >= 30) << i;
    EXPECT_EQ(later[i].position == all_move[i].position, i < 30) << i;
  }
}

}  // namespace
}  // namespace lamp::app
