// The built-in scenes: well-formed data, outward faces, the same bytes twice, flights through open air, known numbers.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/builtin.h"
#include "scene/flight.h"

namespace {

using lamp::app::AlphaMode;
using lamp::app::builtin_scenes;
using lamp::app::BuiltinScene;
using lamp::app::Camera;
using lamp::app::Image;
using lamp::app::Instance;
using lamp::app::Material;
using lamp::app::Mesh;
using lamp::app::Scene;
using lamp::app::Texture;
using lamp::app::Vertex;

/// Each scene once for all tests.
const Scene& made(const BuiltinScene& row) {
  static std::map<std::string_view, Scene> scenes;
  const auto found = scenes.find(row.name);
  return found != scenes.end() ? found->second : scenes.emplace(row.name, row.make()).first->second;
}

class EveryScene : public testing::TestWithParam<BuiltinScene> {
 protected:
  const Scene& scene() const { return made(GetParam()); }
};

std::span<const std::uint32_t> indices_of(const Scene& scene, const Mesh& mesh) {
  return std::span(scene.indices).subspan(mesh.first_index, mesh.index_count);
}

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Two vectors of plain numbers are the same bytes.
template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST_P(EveryScene, NamesItselfItsCamerasAndAFlight) {
  EXPECT_EQ(scene().name, GetParam().name);
  EXPECT_FALSE(GetParam().summary.empty());
  ASSERT_FALSE(scene().cameras.empty());
  std::set<std::string> names;
  for (const Camera& camera : scene().cameras) EXPECT_TRUE(!camera.name.empty() && names.insert(camera.name).second);
  ASSERT_TRUE(scene().flight.has_value());
  EXPECT_GE(scene().flight->keys.size(), 8U);
  EXPECT_EQ(scene().flight->frames, 300U);
}

TEST_P(EveryScene, CamerasMakeViewsUnderEveryProjection) {
  for (const Camera& camera : scene().cameras) {
    for (const std::string_view projection : lamp::app::projection_names()) {
      EXPECT_NO_THROW((void)lamp::app::view_of(camera, 64, 36, projection)) << camera.name << " " << projection;
    }
  }
}

TEST_P(EveryScene, IndicesAndMaterialsExist) {
  const Scene& s = scene();
  ASSERT_FALSE(s.instances.empty());
  for (const Instance& instance : s.instances) ASSERT_LT(instance.mesh, s.meshes.size());
  for (const Mesh& mesh : s.meshes) {
    ASSERT_LT(mesh.material, s.materials.size());
    ASSERT_GT(mesh.index_count, 0U);
    ASSERT_EQ(mesh.index_count % 3, 0U);
    ASSERT_LE(std::size_t{mesh.first_index} + mesh.index_count, s.indices.size());
    for (const std::uint32_t index : indices_of(s, mesh)) {
      ASSERT_LT(std::size_t{mesh.vertex_offset} + index, s.vertices.size());
    }
  }
}

TEST_P(EveryScene, VerticesHaveUnitFramesAndFiniteNumbers) {
  for (const Vertex& vertex : scene().vertices) {
    const glm::vec3 tangent(vertex.tangent);
    ASSERT_TRUE(finite(vertex.position) && finite(vertex.normal) && finite(tangent));
    ASSERT_TRUE(std::isfinite(vertex.uv[0].x) && std::isfinite(vertex.uv[0].y));
    ASSERT_NEAR(glm::length(vertex.normal), 1.0F, 1e-4F);
    ASSERT_NEAR(glm::length(tangent), 1.0F, 1e-4F);
    ASSERT_NEAR(glm::dot(vertex.normal, tangent), 0.0F, 1e-3F);
    ASSERT_EQ(std::abs(vertex.tangent.w), 1.0F);
  }
}

// Counter-clockwise faces look where their vertices' normals look: at least 99.9 % of a scene's triangles, by count.
// The rest is room for the strongly curved rims of leaves and cloths, not for whole parts that are inside out.
TEST_P(EveryScene, FacesLookWhereTheirNormalsLook) {
  const Scene& s = scene();
  std::size_t triangles = 0;
  std::size_t wrong = 0;
  for (const Mesh& mesh : s.meshes) {
    const auto indices = indices_of(s, mesh);
    std::size_t wrong_here = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) -> const Vertex& {
        return s.vertices[std::size_t{mesh.vertex_offset} + indices[i + k]];
      };
      const glm::dvec3 origin(corner(0).position);
      const glm::dvec3 area =
          glm::cross(glm::dvec3(corner(1).position) - origin, glm::dvec3(corner(2).position) - origin);
      const double longest = std::max(glm::distance(origin, glm::dvec3(corner(1).position)),
                                      glm::distance(origin, glm::dvec3(corner(2).position)));
      if (glm::length(area) <= 1e-5 * longest * longest) continue;  // no face: the poles of grids
      for (std::size_t k = 0; k < 3; ++k) {
        if (glm::dot(area, glm::dvec3(corner(k).normal)) > 0.0) continue;
        ++wrong_here;
        break;
      }
    }
    const std::string& material = s.materials[mesh.material].name;
    EXPECT_LT(wrong_here * 4, indices.size() / 3) << "a mesh of material " << material << " is inside out";
    triangles += indices.size() / 3;
    wrong += wrong_here;
  }
  EXPECT_LE(wrong * 1000, triangles);
}

TEST_P(EveryScene, InstancesAreRigidButForUniformScale) {
  for (const Instance& instance : scene().instances) {
    const glm::mat3 linear(instance.world_from_object);
    const float scale = glm::length(linear[0]);
    ASSERT_GT(scale, 0.0F);
    ASSERT_NEAR(glm::length(linear[1]) / scale, 1.0F, 1e-4F);
    ASSERT_NEAR(glm::length(linear[2]) / scale, 1.0F, 1e-4F);
    ASSERT_NEAR(glm::determinant(linear) / (scale * scale * scale), 1.0F, 1e-3F);  // no mirror, no shear
  }
}

TEST_P(EveryScene, ImagesAreConsistent) {
  const Scene& s = scene();
  for (const Image& image : s.images) {
    ASSERT_GT(image.width, 0U) << image.name;
    ASSERT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height) << image.name;
  }
  const auto check = [&](const Texture& texture, bool srgb, const std::string& name) {
    if (texture.image < 0) return;
    ASSERT_LT(static_cast<std::size_t>(texture.image), s.images.size()) << name;
    EXPECT_EQ(s.images[static_cast<std::size_t>(texture.image)].srgb, srgb) << name;
  };
  for (const Material& material : s.materials) {
    check(material.base_color_texture, true, material.name);
    check(material.emissive_texture, true, material.name);
    check(material.normal_texture, false, material.name);
    check(material.metallic_roughness_texture, false, material.name);
    check(material.occlusion_texture, false, material.name);
  }
}

TEST_P(EveryScene, MaterialsAreInRangeAndVaried) {
  const Scene& s = scene();
  std::size_t textured = 0;
  for (const Material& m : s.materials) {
    textured += m.base_color_texture.image >= 0 ? 1 : 0;
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(m.base_color[i] >= 0.0F && m.base_color[i] <= 1.0F) << m.name;
    EXPECT_TRUE(m.roughness >= 0.0F && m.roughness <= 1.0F && m.metallic >= 0.0F && m.metallic <= 1.0F) << m.name;
    EXPECT_TRUE(m.alpha_mode == AlphaMode::blend || m.base_color.a == 1.0F) << m.name;
  }
  EXPECT_GE(textured, s.name == "plane" ? 0U : 6U);
}

TEST_P(EveryScene, IsTheSameEveryTime) {
  const Scene& a = scene();
  const Scene b = GetParam().make();
  EXPECT_TRUE(same_bytes(a.vertices, b.vertices));
  EXPECT_TRUE(same_bytes(a.indices, b.indices));
  EXPECT_TRUE(same_bytes(a.instances, b.instances));
  EXPECT_TRUE(same_bytes(a.meshes, b.meshes));
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(a.images[i].rgba, b.images[i].rgba) << a.images[i].name;
}

/// Distance from a point to a triangle: to its plane above its inside, else to its nearest edge.
float distance_to_triangle(const glm::vec3& p, const std::array<glm::vec3, 3>& t) {
  const glm::vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  bool inside = glm::dot(normal, normal) > 0.0F;
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 a = t[i];
    const glm::vec3 edge = t[(i + 1) % 3] - a;
    const float length2 = glm::dot(edge, edge);
    const float along = length2 > 0.0F ? std::clamp(glm::dot(p - a, edge) / length2, 0.0F, 1.0F) : 0.0F;
    nearest = std::min(nearest, glm::length(p - a - edge * along));
    inside = inside && glm::dot(glm::cross(normal, edge), p - a) >= 0.0F;
  }
  return inside ? std::abs(glm::dot(p - t[0], normal)) / glm::length(normal) : nearest;
}

/// For each point, the distance to the nearest triangle, as far as `reach`.
std::vector<float> clearance(const Scene& s, const std::vector<glm::vec3>& points, float reach) {
  glm::vec3 low(std::numeric_limits<float>::infinity());
  glm::vec3 high = -low;
  for (const glm::vec3& p : points) {
    low = glm::min(low, p - reach);
    high = glm::max(high, p + reach);
  }
  std::vector<float> nearest(points.size(), reach);
  for (const Instance& instance : s.instances) {
    const Mesh& mesh = s.meshes[instance.mesh];
    const auto indices = indices_of(s, mesh);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      std::array<glm::vec3, 3> t{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vertex& vertex = s.vertices[std::size_t{mesh.vertex_offset} + indices[i + k]];
        t[k] = glm::vec3(instance.world_from_object * glm::vec4(vertex.position, 1.0F));
      }
      const glm::vec3 t_low = glm::min(t[0], glm::min(t[1], t[2]));
      const glm::vec3 t_high = glm::max(t[0], glm::max(t[1], t[2]));
      if (glm::any(glm::greaterThan(t_low, high)) || glm::any(glm::lessThan(t_high, low))) continue;
      for (std::size_t p = 0; p < points.size(); ++p) {
        const glm::vec3 gap = glm::max(glm::max(t_low - points[p], points[p] - t_high), glm::vec3(0.0F));
        if (glm::dot(gap, gap) < nearest[p] * nearest[p]) {
          nearest[p] = std::min(nearest[p], distance_to_triangle(points[p], t));
        }
      }
    }
  }
  return nearest;
}

// The eye stays 0.3 m clear of every surface. Steps between samples (five a frame) are shorter than the clearance, so
// the way between them crosses no surface either.
TEST_P(EveryScene, FlightStaysInOpenAir) {
  const Scene& s = scene();
  lamp::app::Flight flight = *s.flight;
  flight.frames *= 2;
  std::vector<glm::vec3> eyes;
  eyes.reserve(flight.frames);
  for (std::uint32_t frame = 0; frame < flight.frames; ++frame) {
    eyes.emplace_back(lamp::app::flight_camera(flight, frame).world_from_camera[3]);
  }
  const std::vector<float> clear = clearance(s, eyes, 3.0F);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    EXPECT_GT(clear[i], 0.3F) << "sample " << i;
    const float step = glm::length(eyes[(i + 1) % eyes.size()] - eyes[i]);
    EXPECT_LT(step, clear[i] + clear[(i + 1) % eyes.size()]) << "sample " << i;
  }
}

TEST_P(EveryScene, CamerasStandInOpenAir) {
  std::vector<glm::vec3> eyes;
  for (const Camera& camera : scene().cameras) eyes.emplace_back(camera.world_from_camera[3]);
  const std::vector<float> clear = clearance(scene(), eyes, 1.0F);
  for (std::size_t i = 0; i < eyes.size(); ++i) EXPECT_GT(clear[i], 0.2F) << scene().cameras[i].name;
}

INSTANTIATE_TEST_SUITE_P(BuiltinScenes, EveryScene, testing::ValuesIn(builtin_scenes().begin(), builtin_scenes().end()),
                         [](const auto& row) {
                           std::string name(row.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

const Scene& scene_named(std::string_view name) {
  const auto rows = builtin_scenes();
  return made(*std::find_if(rows.begin(), rows.end(), [&](const BuiltinScene& row) { return row.name == name; }));
}

std::size_t drawn_triangles(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.meshes[instance.mesh].index_count / 3;
  return count;
}

std::size_t surfaces(const Scene& scene, AlphaMode mode) {
  return static_cast<std::size_t>(std::count_if(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
    return scene.materials[scene.meshes[i.mesh].material].alpha_mode == mode;
  }));
}

TEST(BuiltinScenes, TableHasItsOrder) {
  std::vector<std::string_view> names;
  for (const BuiltinScene& row : builtin_scenes()) names.push_back(row.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"atrium", "blocks", "posts", "corridor", "plane", "one-tile",
                                                  "near-plane", "huge-and-tiny", "needles", "wall", "stack"}));
}

TEST(BuiltinScenes, AtriumHasMasksBlendsAndItsSize) {
  const Scene& atrium = scene_named("atrium");
  EXPECT_GE(atrium.cameras.size(), 3U);
  EXPECT_GE(surfaces(atrium, AlphaMode::mask), 1U);
  EXPECT_GE(surfaces(atrium, AlphaMode::blend), 2U);
  EXPECT_GT(drawn_triangles(atrium), 100'000U);
  EXPECT_LT(drawn_triangles(atrium), 400'000U);
}

TEST(BuiltinScenes, BlocksIsDeepAndGlows) {
  const Scene& blocks = scene_named("blocks");
  const glm::vec3 eye(blocks.cameras.front().world_from_camera[3]);
  const glm::vec3 ahead = -glm::vec3(blocks.cameras.front().world_from_camera[2]);
  float deepest = 0.0F;
  for (const Instance& instance : blocks.instances) {
    for (const std::uint32_t index : indices_of(blocks, blocks.meshes[instance.mesh])) {
      const Vertex& vertex = blocks.vertices[std::size_t{blocks.meshes[instance.mesh].vertex_offset} + index];
      const glm::vec3 p(instance.world_from_object * glm::vec4(vertex.position, 1.0F));
      const float depth = glm::dot(p - eye, ahead);
      deepest = std::max(deepest, depth);
    }
  }
  EXPECT_GT(deepest, 1000.0F);
  std::size_t buildings = 0;  // each has four walls of shops
  for (const Mesh& mesh : blocks.meshes) {
    if (blocks.materials[mesh.material].name == "shop fronts") buildings += mesh.index_count / 24;
  }
  EXPECT_GE(buildings, 200U);
  EXPECT_LE(buildings, 600U);
  EXPECT_TRUE(std::any_of(blocks.materials.begin(), blocks.materials.end(),
                          [](const Material& m) { return m.emissive_texture.image >= 0; }));
}

TEST(BuiltinScenes, PostsAreManyButNotTooMany) {
  const Scene& posts = scene_named("posts");
  EXPECT_GT(posts.instances.size(), 3000U);
  EXPECT_LT(drawn_triangles(posts), 1'500'000U);
  EXPECT_GE(surfaces(posts, AlphaMode::mask), 1U);
}

TEST(BuiltinScenes, PlaneHasItsKnownNumbers) {
  const Scene& plane = scene_named("plane");
  ASSERT_EQ(plane.indices.size(), 6U);
  ASSERT_EQ(plane.instances.size(), 1U);
  EXPECT_EQ(plane.instances[0].world_from_object, glm::mat4(1.0F));
  for (const Vertex& vertex : plane.vertices) {
    EXPECT_EQ(glm::abs(vertex.position), glm::vec3(10, 0, 10));
    EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(vertex.color, glm::u8vec4(255));
  }
  ASSERT_EQ(plane.materials.size(), 1U);
  EXPECT_EQ(plane.materials[0].base_color, glm::vec4(0.5F, 0.5F, 0.5F, 1.0F));
  EXPECT_EQ(plane.materials[0].roughness, 1.0F);
  EXPECT_EQ(plane.materials[0].metallic, 0.0F);
  EXPECT_EQ(plane.materials[0].emissive, glm::vec3(0.0F));
  EXPECT_TRUE(plane.images.empty());
  EXPECT_EQ(plane.sky, glm::vec3(0.0F));
  EXPECT_EQ(plane.ambient, glm::vec3(0.0F));
  EXPECT_TRUE(plane.directional_lights.empty());
  ASSERT_EQ(plane.lights.size(), 1U);
  EXPECT_EQ(plane.lights[0].type, lamp::LightType::point);
  EXPECT_EQ(plane.lights[0].position, glm::vec3(0, 2, 0));
  EXPECT_EQ(plane.lights[0].range, 1000.0F);
  EXPECT_EQ(plane.lights[0].intensity, 100.0F);
  EXPECT_EQ(plane.lights[0].color, glm::vec3(1.0F));
  EXPECT_EQ(glm::vec3(plane.cameras[0].world_from_camera[3]), glm::vec3(0, 4, 6));
  const glm::vec3 ahead = -glm::vec3(plane.cameras[0].world_from_camera[2]);
  EXPECT_NEAR(glm::length(ahead - glm::normalize(glm::vec3(0, -4, -6))), 0.0F, 1e-6F);
}

}  // namespace
