// What mirror rays meet where 32 bits are few: long thin triangles, surfaces that rays graze far from the origin,
// places farther away, and triangles that are enormous.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/hall.h"
#include "gpu/method_check.h"
#include "gpu/test_scenes.h"
#include "render/mirror_check.h"
#include "scene/flight.h"
#include "scene/gltf.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 64;

class MirrorRays : public GpuTest {
 protected:
  static MirrorFindings found_in(const TestScene& scene) {
    return found_in(scene.scene, scene.gpu, {WIDTH, HEIGHT}, 0.5F);
  }

  static MirrorFindings found_in(const Scene& scene, const GpuScene& gpu, const glm::uvec2& size, float roughness) {
    Renderer renderer(test_context(), shader_library(), gpu, size.x, size.y, 1);
    renderer.mirror({.roughness = roughness});
    renderer.set_frame(view_of(find_camera(scene, ""), size.x, size.y, "camera"), {});
    Lighting lighting(renderer.device(), shader_library(),
                      {.method = &brute_force(),
                       .options = take(resolve_options(brute_force(), {})),
                       .width = size.x,
                       .height = size.y,
                       .light_capacity = 1});
    static_cast<void>(renderer.render(lighting));
    return check_mirror(renderer, shader_library(), mirror_reference(renderer, scene), {},
                        std::size_t{size.x} * size.y);
  }
};

void add_quad_of(Scene& scene, const std::array<glm::vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
  for (const glm::vec3& corner : corners) scene.vertices.push_back({.position = corner, .normal = normal});
  scene.meshes.push_back({.first_index = static_cast<std::uint32_t>(scene.indices.size()),
                          .index_count = 6,
                          .vertex_offset = first,
                          .material = 1});
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) scene.indices.push_back(i);
  scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size()) - 1});
}

/// Laths above the floor, in no axis's direction.
Scene lath_hall() {
  constexpr float LENGTH_M = 80.0F;
  constexpr float WIDTH_M = 0.01F;
  Scene scene = hall(50.0F);
  scene.materials[1].double_sided = true;
  const glm::vec3 along = glm::normalize(glm::vec3(0.6F, 0.05F, -0.8F));
  const glm::vec3 across = glm::normalize(glm::cross(along, glm::vec3(0.0F, 1.0F, 0.0F)));
  const glm::vec3 aside = glm::normalize(across + glm::vec3(0.0F, 0.8F, 0.0F));
  for (int i = -100; i < 100; ++i) {
    const glm::vec3 middle = glm::vec3(0.0F, 0.6F, -1.5F) + WIDTH_M * static_cast<float>(i) * across;
    const glm::vec3 a = middle - 0.4F * LENGTH_M * along;
    const glm::vec3 b = middle + 0.6F * LENGTH_M * along;
    add_quad_of(scene, {a, b, b + WIDTH_M * aside, a + WIDTH_M * aside});
  }
  return scene;
}

/// What rounding makes of a hit does not grow with a triangle's length over its width.
TEST_F(MirrorRays, MeetLongThinTriangles) {
  const MirrorFindings found = found_in(TestScene(lath_hall()));
  EXPECT_EQ(found.reason(), "");
  EXPECT_GT(found.hits, found.checked / 2);
  EXPECT_LT(found.unclear, found.checked / 50);
}

/// Two slopes as steep as the picture's middle ray after the floor: one above it, one below.
Scene grazed_hall() {
  constexpr float TILT = 0.8F;  // the camera's, radians
  Scene scene = hall(0.01F);
  scene.materials[1].double_sided = true;
  const glm::vec3 up_slope(0.0F, std::sin(TILT), -std::cos(TILT));
  const glm::vec3 off_slope(0.0F, std::cos(TILT), std::sin(TILT));
  for (const float off : {0.3F, -0.3F}) {
    const glm::vec3 middle = glm::vec3(0.0F, -1.0F, 0.0F) + off * off_slope;  // of the eye behind the mirror
    const glm::vec3 top = middle + 60.0F * up_slope;
    const glm::vec3 bottom = middle + 1.5F * up_slope;
    const glm::vec3 side(30.0F, 0.0F, 0.0F);
    add_quad_of(scene, {bottom - side, bottom + side, top + side, top - side});
  }
  // Rays are rounded where they come into the space of a mesh that is turned.
  const glm::vec3 far_away(700.0F, 0.0F, 900.0F);
  glm::mat3 turn(1.0F);
  turn[0] = {std::cos(0.7F), 0.0F, std::sin(0.7F)};
  turn[2] = {-std::sin(0.7F), 0.0F, std::cos(0.7F)};
  for (Vertex& vertex : scene.vertices) {
    vertex.position = (vertex.position + far_away) * turn;
    vertex.normal = vertex.normal * turn;
  }
  for (Instance& instance : scene.instances) instance.world_from_object = glm::mat4(turn);
  scene.cameras[0].world_from_camera[3] += glm::vec4(far_away, 0.0F);
  return scene;
}

/// A hit that lies on its surface and on its ray, both as far as 32 bits say, is not wrong, wherever along the ray.
TEST_F(MirrorRays, HangOnRoundingWhereTheyGraze) {
  const MirrorFindings found = found_in(TestScene(grazed_hall()));
  EXPECT_EQ(found.reason(), "");
  EXPECT_GT(found.hits, found.checked / 2);
  EXPECT_GT(found.unclear, 0U) << "no ray hangs on rounding: nothing is tested";
}

/// Where a position's last place is more than a ray's start was above its surface.
TEST_F(MirrorRays, BeginAboveTheirSurfaceFarFromTheOrigin) {
  for (const float far_m : {3e4F, 1e5F}) {
    SCOPED_TRACE(far_m);
    Scene scene = hall(50.0F);
    const glm::vec4 far_away(far_m, 0.0F, -far_m, 0.0F);
    for (Instance& instance : scene.instances) instance.world_from_object[3] += far_away;
    scene.cameras[0].world_from_camera[3] += far_away + glm::vec4(0.3F, 0.1F, 0.7F, 0.0F);
    const MirrorFindings found = found_in(TestScene(std::move(scene)));
    EXPECT_EQ(found.reason(), "");
    EXPECT_EQ(found.hits, found.checked) << "the ceiling is everywhere";
    EXPECT_LT(found.unclear, found.checked / 50) << "the mesh's own space holds what the world does not";
  }
}

/// What rounding takes of a triangle's corners is not wrong, and not less than it is.
TEST_F(MirrorRays, MeetTrianglesThatAreEnormous) {
  for (const float half : {1e4F, 1e5F, 1e6F}) {
    SCOPED_TRACE(half);
    Scene scene = hall(half);
    const glm::vec3 axis = glm::normalize(glm::vec3(1.0F, 0.0F, 0.4F));
    scene.instances[1].world_from_object = glm::rotate(glm::mat4(1.0F), 0.2F, axis);  // in no axis's plane
    const MirrorFindings found = found_in(TestScene(std::move(scene)));
    EXPECT_EQ(found.reason(), "");
    EXPECT_EQ(found.hits, found.checked);
  }
}

/// Its images do not fit the largest buffer of a small device, and masked leaves are among them.
TEST_F(MirrorRays, ThroughTheHolesOfARealSceneMeetWhatTheReferenceMeets) {
  const std::filesystem::path file = std::filesystem::path(LAMPLIGHT_SHARED_SCENES) / "sponza/Sponza.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not there; this test needs it";
  const Scene scene = load_gltf(file);
  const MirrorFindings found = found_in(scene, GpuScene(test_context(), scene), {201, 48}, 1.0F);
  EXPECT_GT(found.checked, 1000U);
  EXPECT_EQ(found.wrong, 0U) << found.first_wrong;
}

}  // namespace
}  // namespace lamp::app
