// Meshes around what lights light: closed, of few triangles, and nothing that the look-up finds lit lies outside, for
// any depths, normals and seeds; nor when a view widens them by a margin.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <map>

#include "gpu/lit_lights.h"
#include "gpu/shaders/mesh_corner.h"
#include "lamplight/shared/light_mesh.h"

namespace lamp::app {
namespace {

using shared::MeshCorner;
using shared::ShadowCase;

constexpr std::uint32_t MARGIN_MM = 20;

/// In double precision, around the origin.
struct Triangle {
  std::array<glm::dvec3, 3> corners;
  glm::dmat3 inverse;  ///< of its corners

  explicit Triangle(const MeshCorner* of)
      : corners{glm::dvec3(glm::vec3(of[0].position)), glm::dvec3(glm::vec3(of[1].position)),
                glm::dvec3(glm::vec3(of[2].position))},
        inverse(glm::inverse(glm::dmat3(corners[0], corners[1], corners[2]))) {}
  /// Shares of the corners that add up to the point: all positive where it lies towards the triangle, more than 1 in
  /// all where it lies beyond.
  [[nodiscard]] glm::dvec3 shares(const glm::dvec3& point) const { return inverse * point; }
};

struct Mesh {
  std::vector<MeshCorner> corners;  ///< three a triangle

  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (std::size_t i = 0; i < corners.size(); i += 3) all.emplace_back(&corners[i]);
    return all;
  }
};

/// Of triangles on whose edges it lies, the one that holds it best decides.
bool holds(const std::vector<Triangle>& mesh, const glm::dvec3& point) {
  bool held = false;
  bool found = false;
  for (const Triangle& triangle : mesh) {
    const glm::dvec3 shares = triangle.shares(point);
    const double sum = shares.x + shares.y + shares.z;
    if (!(std::min({shares.x, shares.y, shares.z}) >= -1e-7 * std::abs(sum))) continue;
    found = true;
    held = held || sum <= 1.0 + 1e-6;
  }
  EXPECT_TRUE(found) << "the mesh has a hole";
  return held;
}

std::vector<Mesh> corners_of(const ShadowReach& meshes, std::uint32_t lights, std::uint32_t margin_mm) {
  const vulkan::Buffer corners = host_buffer("corners", lights * shared::MESH_VERTICES * sizeof(MeshCorner));
  dispatch(
      {.shader = "mesh_corners",
       .constants = {margin_mm},
       .resources = {vulkan::Resource::storage(meshes.buffer().handle()), vulkan::Resource::storage(corners.handle())},
       .groups = {(shared::MESH_TRIANGLES + 63) / 64, lights, 1}});
  const std::vector<MeshCorner> all = contents<MeshCorner>(corners);
  std::vector<Mesh> found(lights);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].point != 0) found[i / shared::MESH_VERTICES].corners.push_back(all[i]);
  return found;
}

class LightMeshes : public GpuTest, public ::testing::WithParamInterface<ShadowFilter> {};

/// How many points of a light's cases are what.
struct Held {
  std::uint32_t dark = 0;
  std::uint32_t cut = 0;          ///< of the dark ones: outside
  std::uint32_t lost = 0;         ///< lit, and outside
  std::uint32_t lost_beside = 0;  ///< lit, and a point within the margin of it outside of the mesh that was widened
};

std::vector<std::vector<Triangle>> triangles_of(const ShadowReach& reach, std::uint32_t lights,
                                                std::uint32_t margin_mm) {
  std::vector<std::vector<Triangle>> all;
  for (const Mesh& mesh : corners_of(reach, lights, margin_mm)) all.push_back(mesh.triangles());
  return all;
}

/// Of each light; none of one that has no mesh.
std::vector<std::optional<Held>> held_by_meshes(const LitLights& lit, ShadowFilter filter) {
  test::Random random(7);
  const auto count = static_cast<std::uint32_t>(lit.lights.size());
  const std::vector<ShadowCase> cases = some_lit_cases(lit, random);
  const GpuImage atlas = depth_image(LIT_ATLAS, LIT_ATLAS, some_wall_depths(random));
  const std::vector<float> shadows = shadows_of(cases, lit, atlas, filter);
  const ShadowReach reach = reach_of(ShadowReach::Kind::meshes, lit, atlas, filter);
  const std::vector<std::vector<Triangle>> exact = triangles_of(reach, count, 0);
  const std::vector<std::vector<Triangle>> wide = triangles_of(reach, count, MARGIN_MM);
  std::vector<std::optional<Held>> all(count);
  for (std::size_t i = 0; i < cases.size(); i += 4) {
    const std::uint32_t light = cases[i].light;
    if (exact[light].empty()) continue;
    if (!all[light]) all[light].emplace();
    Held& found = *all[light];
    const glm::dvec3 point(glm::vec3(cases[i].position) - glm::vec3(lit.maps[light].position));
    const bool is_lit = shadows[i] > 0.0F;
    const bool held = holds(exact[light], point);
    found.dark += is_lit ? 0 : 1;
    found.cut += is_lit || held ? 0 : 1;
    found.lost += is_lit && !held ? 1 : 0;
    if (!is_lit) continue;
    const glm::dvec3 beside = point + 0.000999 * MARGIN_MM * glm::dvec3(random.direction());
    found.lost_beside += holds(wide[light], beside) ? 0 : 1;
  }
  return all;
}

void expect_nothing_lost(const Held& found) {
  EXPECT_EQ(found.lost, 0U) << "loses what is lit";
  EXPECT_EQ(found.lost_beside, 0U) << "loses what is beside that";
}

TEST_P(LightMeshes, HoldEverythingThatIsLit) {
  const LitLights lit = some_lit_lights(GetParam());
  const std::vector<std::optional<Held>> found = held_by_meshes(lit, GetParam());
  EXPECT_FALSE(found.back()) << "it has moved since";
  for (std::uint32_t light = 0; light + 1 < found.size(); ++light) {
    SCOPED_TRACE(light);
    ASSERT_TRUE(found[light]);
    expect_nothing_lost(*found[light]);
    if (lit.maps[light].side < 64) continue;
    EXPECT_GT(found[light]->cut, found[light]->dark / 8) << "is hardly cut";
  }
}

TEST_P(LightMeshes, HoldWhatAWideSpotWithASmallMapLights) {
  const std::optional<Held> found = held_by_meshes(wide_lit_light(GetParam()), GetParam()).front();
  ASSERT_TRUE(found);
  expect_nothing_lost(*found);
  EXPECT_GT(found->dark, LIT_CASES / 16);
}

INSTANTIATE_TEST_SUITE_P(Of, LightMeshes, ::testing::Values(ShadowFilter::hard, ShadowFilter::pcf),
                         [](const auto& test) { return test.param == ShadowFilter::hard ? "hard" : "pcf"; });

TEST_F(GpuTest, LightMeshesAreClosedAndSmall) {
  test::Random random(9);
  const LitLights lit = some_lit_lights(ShadowFilter::hard);
  const GpuImage atlas = depth_image(LIT_ATLAS, LIT_ATLAS, some_wall_depths(random));
  const ShadowReach reach = reach_of(ShadowReach::Kind::meshes, lit, atlas, ShadowFilter::hard);
  const std::vector<Mesh> meshes = corners_of(reach, static_cast<std::uint32_t>(lit.lights.size()), MARGIN_MM);
  for (std::uint32_t light = 0; light + 1 < meshes.size(); ++light) {
    SCOPED_TRACE(light);
    const std::vector<MeshCorner>& corners = meshes[light].corners;
    EXPECT_EQ(corners.size(), lit.maps[light].kind == shared::SHADOW_SPOT ? 292U * 3 : 300U * 3);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) ++edges[{corners[i + k].point, corners[i + (k + 1) % 3].point}];
      const Triangle triangle(&corners[i]);
      EXPECT_GT(glm::dot(triangle.corners[0], glm::cross(triangle.corners[1], triangle.corners[2])), 0.0)
          << "triangle " << i / 3 << " is turned inwards";
    }
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1);
      EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << " to " << edge.second;
    }
  }
}

/// Of triangles whose corners are as far away as flatness says, none comes nearer than 1.
TEST_F(GpuTest, FlatTrianglesOfLightMeshesKeepTheirDistance) {
  LitLights lit = some_lit_lights(ShadowFilter::hard);
  lit.lights.push_back(
      pack(Light{.type = LightType::spot, .range = 4.0F, .direction = {0, 0, 1}, .outer_angle = 0.05F}));
  lit.lights.push_back(
      pack(Light{.type = LightType::spot, .range = 4.0F, .direction = {0, 1, 0}, .outer_angle = 1.3F}));
  for (std::size_t i = lit.maps.size(); i < lit.lights.size(); ++i)
    lit.maps.push_back(
        shadow_map(lit.lights[i], {.size = LIT_ATLAS, .filter = ShadowFilter::pcf}, 16, std::vector<UVec2>{{0, 0}}));
  const GpuImage atlas = depth_image(LIT_ATLAS, LIT_ATLAS, std::vector<float>(std::size_t{LIT_ATLAS} * LIT_ATLAS));
  const ShadowReach reach = reach_of(ShadowReach::Kind::meshes, lit, atlas, ShadowFilter::hard);
  for (const Mesh& mesh : corners_of(reach, static_cast<std::uint32_t>(lit.lights.size()), 0))
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
      std::array<glm::dvec3, 3> v{};
      for (std::size_t k = 0; k < 3; ++k)
        v[k] = glm::dvec3(glm::vec3(mesh.corners[i + k].way)) * double{mesh.corners[i + k].flatness};
      for (int a = 0; a <= 20; ++a)
        for (int b = 0; a + b <= 20; ++b)
          ASSERT_GE(glm::length((v[0] * double(a) + v[1] * double(b) + v[2] * double(20 - a - b)) / 20.0), 1.0)
              << "triangle " << i / 3;
    }
}

}  // namespace
}  // namespace lamp::app
