// Mirrored light: rays meet what a reference in double precision meets, the lists of hits miss no light, and the
// picture is the same whatever finds them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/hall.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/mirror_check.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 64;
constexpr std::uint32_t COUNT = 100;
constexpr float ALL = 0.9F;  // most surfaces mirror

struct Shown {
  const GpuScene& gpu;
  View view;
  std::vector<shared::Light> lights;
  MirrorSettings settings{.roughness = ALL};
  ShadingPath path = ShadingPath::deferred;
  std::optional<ShadowSettings> shadows;
};

class Mirror : public GpuTest {
 protected:
  static std::unique_ptr<Renderer> renderer_of(const Shown& shown) {
    auto renderer = std::make_unique<Renderer>(test_context(), shader_library(), shown.gpu, WIDTH, HEIGHT,
                                               static_cast<std::uint32_t>(shown.lights.size()));
    if (shown.shadows) renderer->cast_shadows(*shown.shadows);
    if (shown.settings.roughness > 0.0F) renderer->mirror(shown.settings);
    renderer->set_frame(shown.view, shown.lights);
    return renderer;
  }

  static HdrImage picture(Renderer& renderer, const Shown& shown) {
    Lighting lighting(renderer.device(), shader_library(),
                      {.method = &brute_force(),
                       .options = take(resolve_options(brute_force(), {})),
                       .width = WIDTH,
                       .height = HEIGHT,
                       .light_capacity = static_cast<std::uint32_t>(shown.lights.size()),
                       .path = shown.path,
                       .transparency = !shown.gpu.blended().empty(),
                       .shadows = shown.shadows ? std::optional(shown.shadows->filter) : std::nullopt});
    return renderer.render(lighting).image;
  }

  static HdrImage picture(const Shown& shown) {
    const std::unique_ptr<Renderer> renderer = renderer_of(shown);
    return picture(*renderer, shown);
  }
};

class MirrorInScene : public Mirror, public ::testing::WithParamInterface<std::string_view> {};

/// Instances, masked leaves, glass, back faces; far from the eye, too.
TEST_P(MirrorInScene, RaysMeetWhatTheReferenceMeets) {
  const TestScene& scene = builtin_test_scene(GetParam());
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  const Shown shown{.gpu = scene.gpu, .view = view, .lights = test_lights(scene.air, view, {.count = COUNT})};
  const std::unique_ptr<Renderer> renderer = renderer_of(shown);
  static_cast<void>(picture(*renderer, shown));
  const MirrorFindings found =
      check_mirror(*renderer, shader_library(), mirror_reference(*renderer, scene.scene), shown.lights, 4000);
  EXPECT_EQ(found.reason(), "");
  EXPECT_GT(found.checked, 1000U);
  EXPECT_GT(found.hits, found.checked / 4);
  EXPECT_LT(found.unclear, found.checked / 50);
  ASSERT_TRUE(found.lists);
  EXPECT_GT(found.lists->useful, 0U);
  const gpu::MirrorCounts counts = renderer->mirrored()->counts();
  EXPECT_EQ(counts.rays, found.rays);
  EXPECT_EQ(counts.ended, 0U);
}

INSTANTIATE_TEST_SUITE_P(Of, MirrorInScene, ::testing::Values("corridor", "atrium", "posts", "blocks"),
                         [](const auto& test) { return test_name(test.param); });

TEST_F(Mirror, PictureIsTheSameWhateverFindsTheLights) {
  const TestScene& scene = builtin_test_scene("corridor");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  Shown shown{
      .gpu = scene.gpu, .view = view, .lights = test_lights(scene.air, view, {.count = COUNT, .mix = Mix::both})};
  for (const bool has_shadows : {false, true}) {
    SCOPED_TRACE(has_shadows);
    if (has_shadows) shown.shadows = ShadowSettings{.atlas_size = 1024};
    shown.settings.lists = MirrorLists::brute_force;
    const HdrImage reference = picture(shown);
    shown.settings.lists = MirrorLists::world_cells;
    EXPECT_EQ(max_abs_difference(picture(shown), reference), 0.0F);
    shown.settings.lists = MirrorLists::ikkala_grid;  // which do not ascend
    EXPECT_LE(max_abs_difference(picture(shown), reference), UNORDERED_TOLERANCE * (1.0F + largest_value(reference)));
    Shown without = shown;
    without.settings.roughness = 0.0F;
    EXPECT_GT(max_abs_difference(picture(without), reference), 0.01F) << "something is mirrored";
  }
}

TEST_F(Mirror, EveryPathMirrorsTheSame) {
  const TestScene& scene = builtin_test_scene("atrium");
  const View view = view_of(find_camera(scene.scene, "close"), WIDTH, HEIGHT, "camera");
  Shown shown{.gpu = scene.gpu, .view = view, .lights = test_lights(scene.air, view, {.count = COUNT})};
  const auto added_by = [&](ShadingPath path) {
    shown.path = path;
    shown.settings.roughness = ALL;
    HdrImage with = picture(shown);
    shown.settings.roughness = 0.0F;
    const HdrImage without = picture(shown);
    for (std::size_t i = 0; i < with.pixels.size(); ++i) with.pixels[i] -= without.pixels[i];
    return with;
  };
  const HdrImage reference = added_by(ShadingPath::deferred);
  const float size = largest_value(reference);
  EXPECT_GT(size, 0.01F);
  for (const ShadingPath path : {ShadingPath::tiled_deferred, ShadingPath::forward, ShadingPath::standard_deferred}) {
    SCOPED_TRACE(static_cast<int>(path));
    // Sums that begin elsewhere are rounded otherwise.
    EXPECT_LT(max_abs_difference(added_by(path), reference), 1e-4F * size);
  }
}

glm::vec3 middle_of(const HdrImage& image) {
  return glm::vec3(image.pixels[std::size_t{HEIGHT / 2} * WIDTH + WIDTH / 2]);
}

TEST_F(Mirror, ShowsWhatIsKnownToBeThere) {
  const TestScene scene(hall(50.0F));
  Shown shown{.gpu = scene.gpu, .view = view_of(scene.scene.cameras[0], WIDTH, HEIGHT, "camera"), .lights = {}};
  const glm::vec3 mirrored = middle_of(picture(shown));
  EXPECT_NEAR(mirrored.g, 2.0F, 0.01F) << "a white metal reflects all";
  EXPECT_NEAR(mirrored.r, 0.0F, 1e-6F);
  const TestScene open(hall(0.01F));
  const Shown sky{.gpu = open.gpu, .view = shown.view, .lights = {}};
  EXPECT_NEAR(middle_of(picture(sky)).r, 0.5F, 0.01F);
  shown.settings.roughness = 0.05F;
  EXPECT_EQ(middle_of(picture(shown)), glm::vec3(0.0F)) << "the floor is as rough as the limit";
}

/// A matrix has no inverse where a scale is 0, and none in 32 bits where it is tiny; the quads look the same.
TEST_F(Mirror, ShowsWhatIsPlacedFlatOrTiny) {
  const TestScene plain(hall(50.0F));
  const View view = view_of(plain.scene.cameras[0], WIDTH, HEIGHT, "camera");
  std::vector<shared::Light> lights(1);
  lights[0].position = {0.0F, 1.5F, -1.0F};
  lights[0].range = 20.0F;
  lights[0].intensity = {0.0F, 0.0F, 9.0F};
  const HdrImage expected = picture({.gpu = plain.gpu, .view = view, .lights = lights});
  EXPECT_NEAR(middle_of(expected).g, 2.0F, 0.01F);
  for (const glm::vec3& size : {glm::vec3(1.0F, 0.0F, 1.0F), glm::vec3(1e-14F), glm::vec3(1.0F, 1e-30F, 1.0F)}) {
    SCOPED_TRACE(size.y);
    Scene made = hall(50.0F);
    for (Vertex& vertex : made.vertices)
      vertex.position = {vertex.position.x / size.x, 0.0F, vertex.position.z / size.z};
    for (std::size_t i = 0; i < 2; ++i) {
      glm::mat4& m = made.instances[i].world_from_object;
      for (int axis = 0; axis < 3; ++axis) m[axis] *= size[axis];
      m[3].y = i == 0 ? 0.0F : 3.0F;
    }
    const TestScene scene(std::move(made));
    const Shown shown{.gpu = scene.gpu, .view = view, .lights = lights};
    const std::unique_ptr<Renderer> renderer = renderer_of(shown);
    EXPECT_LT(max_abs_difference(picture(*renderer, shown), expected), 1e-3F);
    const MirrorFindings found =
        check_mirror(*renderer, shader_library(), mirror_reference(*renderer, scene.scene), lights, 4000);
    EXPECT_EQ(found.reason(), "");
    EXPECT_GT(found.hits, 0U);
  }
}

/// Where the last place of a position is coarser than rays begin above their surface: the floor has two sides, and a
/// ray that began below it would meet it.
TEST_F(Mirror, ShowsNoSurfaceInItselfFarFromTheOrigin) {
  for (const float far_m : {1e4F, 3e4F, 1e5F}) {
    SCOPED_TRACE(far_m);
    Scene made = hall(50.0F);
    made.materials[0].double_sided = true;
    const glm::mat4 there = glm::translate(glm::mat4(1.0F), {far_m, 0.0F, -far_m}) *
                            glm::rotate(glm::mat4(1.0F), 1.3F, glm::vec3(0.6F, 0.8F, 0.0F));
    for (Instance& instance : made.instances) instance.world_from_object = there;
    made.cameras[0].world_from_camera = there * made.cameras[0].world_from_camera;
    const TestScene scene(std::move(made));
    const HdrImage shown =
        picture({.gpu = scene.gpu, .view = view_of(scene.scene.cameras[0], WIDTH, HEIGHT, "camera"), .lights = {}});
    EXPECT_EQ(std::ranges::count_if(shown.pixels, [](const auto& pixel) { return !(pixel.g > 1.9F); }), 0)
        << "the ceiling is everywhere, and the floor is black";
  }
}

TEST_F(Mirror, FollowsAnInstanceThatMoves) {
  TestScene scene(hall(6.0F));
  Shown shown{.gpu = scene.gpu, .view = view_of(scene.scene.cameras[0], WIDTH, HEIGHT, "camera"), .lights = {}};
  shown.shadows = ShadowSettings{.atlas_size = 256};
  const std::unique_ptr<Renderer> renderer = renderer_of(shown);
  const auto moved_to = [&](float x) {
    scene.scene.instances[1].world_from_object[3].x = x;
    const std::vector<shared::LightSphere> moved = scene.gpu.move(test_context());
    renderer->move_instances(moved);
    renderer->set_frame(shown.view, shown.lights);
    EXPECT_EQ(moved.size(), 2U) << "where it was, and where it is";
    return middle_of(picture(*renderer, shown));
  };
  const glm::vec3 below = middle_of(picture(*renderer, shown));
  EXPECT_NEAR(below.g, 2.0F, 0.01F);
  EXPECT_NEAR(moved_to(40.0F).r, 0.5F, 0.01F) << "the sky";
  EXPECT_EQ(moved_to(0.0F), below);
}

TEST_F(Mirror, OfAnEmptySceneIsSky) {
  Scene empty{.name = "empty"};
  empty.materials = {Material{}};
  empty.sky = {0.25F, 0.5F, 0.75F};
  empty.cameras = {Camera{.name = "any"}};
  const TestScene scene(std::move(empty));
  const Shown shown{.gpu = scene.gpu, .view = view_of(scene.scene.cameras[0], WIDTH, HEIGHT, "camera"), .lights = {}};
  const std::unique_ptr<Renderer> renderer = renderer_of(shown);
  EXPECT_EQ(middle_of(picture(*renderer, shown)), scene.scene.sky);
  EXPECT_EQ(renderer->mirrored()->counts().rays, 0U);
}

}  // namespace
}  // namespace lamp::app
