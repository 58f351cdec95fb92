// Real scenes: whole levels and halls from glTF files, their own lights and generated ones; nothing missed.
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
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

INSTANTIATE_TEST_SUITE_P(Files, RealScenes,
                         ::testing::Values("sponza/Sponza.gltf", "sponza/Sponza_lights.gltf", "quake/e1m1.glb",
                                           "quake/e3m4.glb", "tps-lights/lights.glb"),
                         [](const auto& given) { return test_name(given.param); });

}  // namespace
}  // namespace lamp::app
