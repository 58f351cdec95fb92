// The hierarchy that rays walk in compute: it holds every triangle, skips nothing that a plain loop meets, and follows
// instances that move.
// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "random.h"
#include "scene/builtin.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

struct Met {
  double at = std::numeric_limits<double>::infinity();
  std::uint32_t instance = 0;     ///< the scene's
  std::uint32_t first_index = 0;  ///< of the triangle
};

struct TestRay {
  glm::dvec3 origin;
  glm::dvec3 direction;
};

/// Moeller, Trumbore (1997); infinite where it passes by.
double distance_to(const std::array<glm::dvec3, 3>& c, const TestRay& ray) {
  const glm::dvec3 p = glm::cross(ray.direction, c[2] - c[0]);
  const double determinant = glm::dot(c[1] - c[0], p);
  const glm::dvec3 from = ray.origin - c[0];
  const double u = glm::dot(from, p) / determinant;
  const glm::dvec3 q = glm::cross(from, c[1] - c[0]);
  const double v = glm::dot(ray.direction, q) / determinant;
  const double at = glm::dot(c[2] - c[0], q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > 0.0 ? at : std::numeric_limits<double>::infinity();
}

bool passes(const Vec3& low, const Vec3& high, const TestRay& ray) {
  const glm::dvec3 a = (glm::dvec3(glm::vec3(low)) - ray.origin) / ray.direction;
  const glm::dvec3 b = (glm::dvec3(glm::vec3(high)) - ray.origin) / ray.direction;
  const glm::dvec3 near = glm::min(a, b);
  const glm::dvec3 far = glm::max(a, b);
  return std::max({near.x, near.y, near.z, 0.0}) <= std::min({far.x, far.y, far.z});
}

/// Walks both levels, in double precision.
class Walk {
 public:
  explicit Walk(const Bvh& bvh) : bvh_(bvh) {}

  Met first(const TestRay& ray) {
    met_ = {};
    if (bvh_.root != gpu::BVH_NOTHING) upper(bvh_.root, ray);
    return met_;
  }

 private:
  void upper(std::uint32_t code, const TestRay& ray) {
    const std::uint32_t number = code / gpu::BVH_COUNTS;
    if (code % gpu::BVH_COUNTS == 0) return children(bvh_.nodes[number], ray, &Walk::upper);
    instance_ = &bvh_.instances[number];
    const gpu::BvhInstance& i = *instance_;
    const glm::dmat3 columns(glm::dvec3(glm::vec3(i.column_x)), glm::dvec3(glm::vec3(i.column_y)),
                             glm::dvec3(glm::vec3(i.column_z)));
    const glm::dmat3 inverse = glm::inverse(columns);
    lower(i.root, {inverse * (ray.origin - glm::dvec3(glm::vec3(i.origin))), inverse * ray.direction});
  }

  void lower(std::uint32_t code, const TestRay& ray) {
    const std::uint32_t number = code / gpu::BVH_COUNTS;
    if (code % gpu::BVH_COUNTS == 0) return children(bvh_.nodes[number], ray, &Walk::lower);
    for (std::uint32_t t = number; t < number + code % gpu::BVH_COUNTS; ++t) {
      const gpu::BvhTriangle& triangle = bvh_.triangles[t];
      const double at = distance_to(
          {glm::dvec3(glm::vec3(triangle.a)), glm::dvec3(glm::vec3(triangle.b)), glm::dvec3(glm::vec3(triangle.c))},
          ray);
      if (at < met_.at) met_ = {at, instance_->scene_instance, triangle.first_index};
    }
  }

  void children(const gpu::BvhNode& node, const TestRay& ray, void (Walk::*go)(std::uint32_t, const TestRay&)) {
    if (passes(node.min_first, node.max_first, ray)) (this->*go)(node.first, ray);
    if (passes(node.min_second, node.max_second, ray)) (this->*go)(node.second, ray);
  }

  const Bvh& bvh_;
  const gpu::BvhInstance* instance_ = nullptr;
  Met met_;
};

Met first_of_all(const Scene& scene, const TestRay& ray) {
  Met met;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    if (scene.materials[mesh.material].alpha_mode == AlphaMode::blend) continue;
    for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
      const double at = distance_to(world_triangle<double>(scene, scene.instances[i], t), ray);
      if (at < met.at) met = {at, i, mesh.first_index + 3 * t};
    }
  }
  return met;
}

glm::mat4 placed(test::Random& random, float far_away) {
  glm::mat4 m(1.0F);
  for (int axis = 0; axis < 3; ++axis) m[axis] = glm::vec4(random.vector(1.5F), 0.0F);
  m[3] = glm::vec4(random.vector(12.0F) + far_away, 1.0F);
  return m;
}

/// Meshes of scattered triangles, some flat, one of glass; instances turned, stretched and mirrored.
Scene scattered(test::Random& random, float far_away, std::uint32_t meshes, std::uint32_t instances,
                std::uint32_t triangles) {
  Scene scene;
  scene.materials = {Material{}, Material{.alpha_mode = AlphaMode::blend}};
  for (std::uint32_t m = 0; m < meshes; ++m) {
    scene.meshes.push_back({.first_index = static_cast<std::uint32_t>(scene.indices.size()),
                            .index_count = 3 * triangles,
                            .vertex_offset = static_cast<std::uint32_t>(scene.vertices.size()),
                            .material = m == 1 ? 1U : 0U});
    for (std::uint32_t i = 0; i < 3 * triangles; ++i) scene.indices.push_back(i);
    for (std::uint32_t t = 0; t < triangles; ++t) {
      const glm::vec3 at = random.vector(4.0F);
      for (int corner = 0; corner < 3; ++corner) {
        Vertex vertex{.position = at + random.vector(2.5F)};
        if (t % 3 == 0) vertex.position.y = at.y;  // boxes without thickness
        scene.vertices.push_back(vertex);
      }
    }
  }
  for (std::uint32_t i = 0; i < instances; ++i)
    scene.instances.push_back({.mesh = i % meshes, .world_from_object = placed(random, far_away)});
  return scene;
}

void expect_same_hits(const Scene& scene, const Bvh& bvh, test::Random& random, float far_away) {
  Walk walk(bvh);
  int hits = 0;
  for (int i = 0; i < 600; ++i) {
    TestRay ray{glm::dvec3(random.vector(15.0F) + far_away), glm::dvec3(random.vector(1.0F))};
    if (i % 4 == 0) ray.direction[i % 3] = 1e-9;
    const Met by_loop = first_of_all(scene, ray);
    const Met by_walk = walk.first(ray);
    if (std::isinf(by_loop.at)) {
      EXPECT_TRUE(std::isinf(by_walk.at));
      continue;
    }
    ++hits;
    // It may be another triangle at the same place, such as of a mesh that a matrix flattens.
    const Instance& instance = scene.instances[by_walk.instance];
    const std::uint32_t triangle = (by_walk.first_index - scene.meshes[instance.mesh].first_index) / 3;
    const double error = 1e-5 * (1.0 + by_loop.at + far_away);
    EXPECT_NEAR(by_walk.at, by_loop.at, error);
    EXPECT_NEAR(distance_to(world_triangle<double>(scene, instance, triangle), ray), by_loop.at, error);
  }
  EXPECT_GT(hits, 50);
}

/// How many codes wait at most, whichever way a ray goes.
std::uint32_t depth_below(const Bvh& bvh, std::uint32_t code, bool is_upper) {
  const std::uint32_t number = code / gpu::BVH_COUNTS;
  if (code % gpu::BVH_COUNTS != 0) return is_upper ? depth_below(bvh, bvh.instances[number].root, false) : 0;
  const gpu::BvhNode& node = bvh.nodes[number];
  return 1 + std::max(depth_below(bvh, node.first, is_upper), depth_below(bvh, node.second, is_upper));
}

TEST(Bvh, HoldsEveryTriangleOnceForEachMesh) {
  for (const char* name : {"corridor", "atrium", "needles"}) {
    SCOPED_TRACE(name);
    const auto found = std::ranges::find(builtin_scenes(), std::string_view(name), &BuiltinScene::name);
    ASSERT_NE(found, builtin_scenes().end());
    const Scene scene = found->make();
    const Bvh bvh = make_bvh(scene);
    std::multiset<std::uint32_t> expected;
    std::set<std::uint32_t> meshes;
    std::size_t instances = 0;
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = scene.meshes[instance.mesh];
      if (scene.materials[mesh.material].alpha_mode == AlphaMode::blend) continue;
      ++instances;
      if (!meshes.insert(instance.mesh).second) continue;
      for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) expected.insert(mesh.first_index + 3 * t);
    }
    std::multiset<std::uint32_t> held;
    for (const gpu::BvhTriangle& t : bvh.triangles) held.insert(t.first_index);
    EXPECT_EQ(held, expected);
    EXPECT_EQ(bvh.instances.size(), instances);
    EXPECT_LE(depth_below(bvh, bvh.root, true), bvh.stack);
  }
}

TEST(Bvh, SkipsNothingThatALoopMeets) {
  test::Random random(7);
  for (const float far_away : {0.0F, 3e4F}) {
    const Scene scene = scattered(random, far_away, 5, 40, 60);
    expect_same_hits(scene, make_bvh(scene), random, far_away);
  }
}

TEST(Bvh, FollowsInstancesThatMove) {
  test::Random random(7);
  Scene scene = scattered(random, 0.0F, 5, 40, 60);
  Bvh bvh = make_bvh(scene);
  const auto lower = [&] {
    std::vector<std::uint32_t> codes;
    for (std::uint32_t i = 0; i < bvh.first_upper; ++i) codes.push_back(bvh.nodes[i].first);
    return codes;
  };
  const std::vector<std::uint32_t> before = lower();
  for (std::size_t i = 0; i < scene.instances.size(); i += 2)
    scene.instances[i].world_from_object = placed(random, 0.0F);
  EXPECT_TRUE(refit(bvh, scene)) << "the meshes' trees stay";
  EXPECT_EQ(lower(), before);
  expect_same_hits(scene, bvh, random, 0.0F);
}

TEST(Bvh, BuildsAnewWhatAMatrixFlattens) {
  test::Random random(7);
  Scene scene = scattered(random, 0.0F, 3, 12, 30);
  Bvh bvh = make_bvh(scene);
  scene.instances[0].world_from_object[1] = glm::vec4(0.0F);  // flat
  EXPECT_FALSE(refit(bvh, scene));
  EXPECT_EQ(std::ranges::count_if(bvh.instances, [](const auto& i) { return (i.kind & gpu::BVH_FLATTENED) != 0; }), 1);
  expect_same_hits(scene, bvh, random, 0.0F);
  EXPECT_FALSE(refit(bvh, scene)) << "its triangles lie where they lay";
}

TEST(Bvh, OfNothingIsNothing) {
  const Bvh empty = make_bvh({});
  EXPECT_EQ(empty.root, gpu::BVH_NOTHING);
  EXPECT_EQ(empty.stack, 0U);
  Scene glass;
  glass.materials = {Material{.alpha_mode = AlphaMode::blend}};
  glass.vertices.resize(3);
  glass.indices = {0, 1, 2};
  glass.meshes = {{.index_count = 3}};
  glass.instances = {{}};
  EXPECT_EQ(make_bvh(glass).root, gpu::BVH_NOTHING);
  Scene two_indices = glass;
  two_indices.materials = {Material{}};
  two_indices.meshes[0].index_count = 2;
  EXPECT_EQ(make_bvh(two_indices).root, gpu::BVH_NOTHING);
}

TEST(Bvh, TakesDegenerateAndEnormousTriangles) {
  Scene scene;
  scene.materials = {Material{}};
  const float huge = FURTHEST_M;
  for (const glm::vec3& p :
       {glm::vec3(0), glm::vec3(0), glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(2, 0, 0), glm::vec3(3, 0, 0),
        glm::vec3(-huge, -1, -huge), glm::vec3(huge, -1, -huge), glm::vec3(0, -1, huge)})
    scene.vertices.push_back({.position = p});
  for (int copy = 0; copy < 100; ++copy)
    for (std::uint32_t i = 0; i < scene.vertices.size(); ++i) scene.indices.push_back(i);
  scene.meshes = {{.index_count = static_cast<std::uint32_t>(scene.indices.size())}};
  scene.instances = {{}};
  const Bvh bvh = make_bvh(scene);
  EXPECT_EQ(bvh.triangles.size(), 300U);
  EXPECT_NEAR(Walk(bvh).first({{0.1, 5.0, 0.2}, {0.0, -1.0, 0.0}}).at, 6.0, 1e-6);
  EXPECT_TRUE(std::isinf(Walk(bvh).first({{0.1, 5.0, 0.2}, {0.0, 1.0, 0.0}}).at));
}

TEST(BoxTree, KeepsToItsDepth) {
  // Each box twice as far as the last: by area alone, one box would be split off at a time.
  std::vector<Box> boxes;
  float at = 1e-12F;
  for (int i = 0; i < 80; ++i, at *= 2.0F) boxes.push_back({glm::vec3(at), glm::vec3(at * 1.1F)});
  for (const std::uint32_t depth : {0U, 5U, 8U, 30U}) {
    const BoxTree tree = make_box_tree(boxes, {.leaf = 4, .max_depth = depth});
    EXPECT_LE(tree.depth, std::max(depth, 5U)) << "80 boxes of 4 fit in no less than 5 levels";
    EXPECT_EQ(std::set(tree.order.begin(), tree.order.end()).size(), boxes.size());
  }
}

}  // namespace
}  // namespace lamp::app
