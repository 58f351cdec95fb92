// What counts as rounding in the check of mirror rays: as much as 32 bits may take where a mesh lies and as large as it
// is, and no more.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/mirror_images.h"

namespace lamp::app {
namespace {

/// A floor with its front up, `half` from its middle to its sides, placed somewhere.
Scene floor_at(const glm::vec3& origin, float half) {
  Scene scene;
  scene.materials.resize(1);
  for (const glm::vec2 at : {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)})
    scene.vertices.push_back({.position = {half * at.x, 0.0F, half * at.y}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes = {{.index_count = 6}};
  Instance instance;
  instance.world_from_object[3] = glm::vec4(origin, 1.0F);
  scene.instances = {instance};
  return scene;
}

/// A ray down to the floor from 1 m above it, and its hit as a device without rounding has it.
struct Traced {
  explicit Traced(const Scene& scene) : bvh(make_bvh(scene)), reference(scene, bvh) {
    const glm::vec3 origin = glm::vec3(scene.instances[0].world_from_object[3]);
    ray.origin = Vec3(origin + glm::vec3(0.5F, 1.0F, 0.75F));
    ray.direction = Vec3(glm::vec3(0.6F, -0.8F, 0.0F));
    const glm::dvec3 at = glm::dvec3(glm::vec3(ray.origin)) - glm::dvec3(origin) + glm::dvec3(0.75, -1.0, 0.0);
    for (std::uint32_t t = 0; t < bvh.triangles.size(); ++t) {
      const auto& [a, b, c] = corners(t);
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      const double u = glm::dot(glm::cross(at - a, c - a), normal) / glm::dot(normal, normal);
      const double v = glm::dot(glm::cross(b - a, at - a), normal) / glm::dot(normal, normal);
      if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
      hit = {.triangle = t, .instance = 0, .u = static_cast<float>(u), .v = static_cast<float>(v)};
    }
    position = glm::vec3(at + glm::dvec3(origin));
  }

  [[nodiscard]] std::array<glm::dvec3, 3> corners(std::uint32_t t) const {
    const gpu::BvhTriangle& of = bvh.triangles[t];
    return {glm::dvec3(glm::vec3(of.a)), glm::dvec3(glm::vec3(of.b)), glm::dvec3(glm::vec3(of.c))};
  }

  /// Its place on the floor moved along x, m.
  [[nodiscard]] MirrorAnswer moved(double by) const {
    const auto& [a, b, c] = corners(hit.triangle);
    gpu::MirrorHit other = hit;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const glm::dvec3 x(by, 0.0, 0.0);
    other.u += static_cast<float>(glm::dot(glm::cross(x, c - a), normal) / glm::dot(normal, normal));
    other.v += static_cast<float>(glm::dot(glm::cross(b - a, x), normal) / glm::dot(normal, normal));
    return reference.compare(ray, other, position + glm::vec3(x)).answer;
  }

  Bvh bvh;
  MirrorReference reference;
  gpu::MirrorAsked ray{};
  gpu::MirrorHit hit{.triangle = gpu::MIRROR_SKY};
  glm::vec3 position{0.0F};
};

/// A position's 32 bits may be 2 mm apart there: they are the world's, not the ray's.
TEST(MirrorReference, KnowsThatPositionsAreRoundedFarFromTheOrigin) {
  const Scene scene = floor_at({3e4F, 5.0F, -3e4F}, 10.0F);
  const Traced traced(scene);
  ASSERT_LT(traced.hit.triangle, 2U);
  EXPECT_EQ(traced.reference.compare(traced.ray, traced.hit, traced.position).answer, MirrorAnswer::same);
  EXPECT_EQ(traced.reference.compare(traced.ray, traced.hit, traced.position + glm::vec3(0.1F, 0.0F, 0.0F)).answer,
            MirrorAnswer::wrong);
}

/// What a ray meets is as sure there as elsewhere: it is found in the mesh's own space.
TEST(MirrorReference, AllowsNoMoreWhereAMeshIsPlacedFarAway) {
  for (const float far_away : {0.0F, 3e4F}) {
    const Scene scene = floor_at({far_away, 0.0F, far_away}, 10.0F);
    const Traced traced(scene);
    EXPECT_EQ(traced.moved(0.0), MirrorAnswer::same) << far_away;
    EXPECT_EQ(traced.moved(0.02), MirrorAnswer::wrong) << far_away;
  }
}

TEST(MirrorReference, AllowsWhatRoundingTakesOfLargeTriangles) {
  const Scene scene = floor_at(glm::vec3(0.0F), 1e5F);
  const Traced traced(scene);
  EXPECT_EQ(traced.moved(0.02), MirrorAnswer::unclear) << "two of the last places of a corner";
  EXPECT_EQ(traced.moved(1.0), MirrorAnswer::wrong);
}

/// Where not all images fit a device's buffer, rays see coarser holes.
TEST(MirrorReference, SeesHolesAsRaysReadThem) {
  Scene scene = floor_at(glm::vec3(0.0F), 10.0F);
  Image leaf{.width = 2, .height = 2, .rgba = std::vector<std::uint8_t>(16, 255)};
  leaf.rgba[3] = leaf.rgba[7] = 0;  // half of it is cut out; the mean of all is kept
  scene.images = {leaf};
  scene.materials[0].base_color_texture.image = 0;
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.materials[0].alpha_cutoff = 0.4F;
  for (Vertex& vertex : scene.vertices) vertex.uv[0] = glm::vec2(0.5F, 0.2F);
  const Traced traced(scene);
  EXPECT_EQ(traced.moved(0.0), MirrorAnswer::wrong) << "nothing is there";
  const std::uint32_t levels[] = {1};
  const MirrorReference coarser(scene, traced.bvh, levels);
  EXPECT_EQ(coarser.compare(traced.ray, traced.hit, traced.position).answer, MirrorAnswer::same);
}

TEST(MirrorImages, ThoseThatCutHolesLoseLevelsLast) {
  Scene scene;
  for (const std::uint32_t side : {64U, 32U, 16U})
    scene.images.push_back({.width = side, .height = side, .rgba = std::vector<std::uint8_t>(4 * side * side, 255)});
  scene.materials.resize(2);
  scene.materials[0].base_color_texture.image = 1;
  scene.materials[1].base_color_texture.image = 0;
  scene.materials[1].alpha_mode = AlphaMode::mask;
  using Levels = std::vector<std::uint32_t>;
  const std::uint64_t holes = (4 * 64 * 64 - 1) / 3;  // and all its levels
  EXPECT_EQ(cuts_holes(scene), (std::vector<bool>{true, false, false}));
  EXPECT_EQ(levels_that_fit(scene, 2 * holes), (Levels{0, 0, 0}));
  EXPECT_EQ(levels_that_fit(scene, holes + 341 + 341), (Levels{0, 1, 0}));
  EXPECT_EQ(levels_that_fit(scene, holes + 2), (Levels{0, 5, 4}));
  EXPECT_EQ(levels_that_fit(scene, holes + 1), (Levels{1, 5, 4}));
  EXPECT_EQ(levels_that_fit(scene, 1), (Levels{6, 5, 4})) << "one texel of each is left";
}

TEST(MirrorReference, SaysWhatIsMetInstead) {
  const Scene scene = floor_at(glm::vec3(0.0F), 10.0F);
  const Traced traced(scene);
  const MirrorCompared sky = traced.reference.compare(traced.ray, {.triangle = gpu::MIRROR_SKY}, {});
  EXPECT_EQ(sky.answer, MirrorAnswer::wrong);
  EXPECT_EQ(sky.fault, "the sky, expected 1.25 m");
}

}  // namespace
}  // namespace lamp::app
