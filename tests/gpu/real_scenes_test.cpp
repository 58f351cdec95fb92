// Real scenes: whole levels and halls from glTF files, their own lights and generated ones; nothing missed.
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/mirror_check.h"
#include "render/mirror_reference.h"
#include "scene/flight.h"
#include "scene/gltf.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

class RealScenes : public GpuTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(RealScenes, NothingIsMissed) {
  const std::filesystem::path file = std::filesystem::path(LAMPLIGHT_SHARED_SCENES) / GetParam();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not there; this test needs it";
  constexpr std::uint32_t WIDTH = 96;
  constexpr std::uint32_t HEIGHT = 54;
  const Scene scene = load_gltf(file);
  const GpuScene gpu(test_context(), scene);
  const View view = view_of(find_camera(scene, ""), WIDTH, HEIGHT, "camera");
  for (const std::uint32_t count : {64U, 1024U}) {
    std::vector<shared::Light> lights = pack(scene.lights);
    const std::vector<shared::Light> more = pack(place_lights(scene, {.count = count}));
    lights.insert(lights.end(), more.begin(), more.end());
    const auto capacity = static_cast<std::uint32_t>(lights.size());
    Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, capacity);
    const LitCase lit = make_case(renderer, view, std::move(lights));
    EXPECT_GT(lit.truth.lights.size(), 0U);
    for (std::size_t m = 0; m < methods().size(); ++m) {
      if (!has_turn(m + (count == 64U ? 0 : 1), 2)) continue;
      const Method& method = methods()[m];
      SCOPED_TRACE(method.name);
      check_method(renderer, lit, {.method = &method, .light_capacity = capacity});
    }
  }
}

class RealMirrors : public GpuTest {};

/// Its images do not fit the largest buffer of a small device, and masked leaves are among them.
TEST_F(RealMirrors, RaysThroughHolesMeetWhatTheReferenceMeets) {
  const std::filesystem::path file = std::filesystem::path(LAMPLIGHT_SHARED_SCENES) / "sponza/Sponza.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file.string() << " is not there; this test needs it";
  constexpr std::uint32_t WIDTH = 201;
  constexpr std::uint32_t HEIGHT = 48;
  const Scene scene = load_gltf(file);
  const GpuScene gpu(test_context(), scene);
  Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, 1);
  renderer.mirror({.roughness = 1.0F});
  renderer.set_frame(view_of(find_camera(scene, ""), WIDTH, HEIGHT, "camera"), {});
  Lighting lighting(renderer.device(), shader_library(),
                    {.method = &brute_force(),
                     .options = take(resolve_options(brute_force(), {})),
                     .width = WIDTH,
                     .height = HEIGHT,
                     .light_capacity = 1});
  static_cast<void>(renderer.render(lighting));
  const MirrorScene& traced = renderer.mirrored()->scene();
  const MirrorReference reference(scene, traced.bvh(), traced.first_levels());
  const MirrorFindings found = check_mirror(renderer, shader_library(), reference, {}, std::size_t{WIDTH} * HEIGHT);
  EXPECT_GT(found.checked, 1000U);
  EXPECT_EQ(found.wrong, 0U) << found.first_wrong;
}

INSTANTIATE_TEST_SUITE_P(Files, RealScenes,
                         ::testing::Values("sponza/Sponza.gltf", "sponza/Sponza_lights.gltf", "quake/e1m1.glb",
                                           "quake/e3m4.glb", "tps-lights/lights.glb"),
                         [](const auto& given) { return test_name(given.param); });

}  // namespace
}  // namespace lamp::app
