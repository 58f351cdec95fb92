// Probes that show what they saw: the same picture through methods and paths, other than with one colour each, and
// captures that follow lights within a budget.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_captures.h"

#include <algorithm>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/place_probes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 54;
constexpr std::uint32_t LIGHTS = 40;
constexpr std::uint32_t PROBES = 5;

class CapturedProbes : public GpuTest {
 protected:
  CapturedProbes()
      : view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera")),
        lights_(test_lights(scene_.air, view_, {.count = LIGHTS, .mix = Mix::both})),
        probes_(pack(place_probes(scene_.scene, PROBES, 1))),
        captures_(test_context(), shader_library(), scene_.gpu, {.light_capacity = LIGHTS}, probes_),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, LIGHTS) {}

  void renew(std::uint32_t budget) { captures_.renew({.views = {&view_, 1}, .lights = lights_}, budget); }

  HdrImage picture(std::string_view name, ShadingPath path) {
    const Method& method = *take(find_method(name));
    renderer_.set_frame(view_, lights_);
    Lighting lighting(renderer_.device(), shader_library(),
                      {.method = &method,
                       .options = take(resolve_options(method, {})),
                       .width = WIDTH,
                       .height = HEIGHT,
                       .light_capacity = LIGHTS + static_cast<std::uint32_t>(renderer_.probes().probes().size()),
                       .path = path,
                       .transparency = !scene_.gpu.blended().empty(),
                       .probes = renderer_.probes().kind()});
    return renderer_.render(lighting).image;
  }

  const TestScene& scene_ = builtin_test_scene("atrium");
  View view_;
  std::vector<shared::Light> lights_;
  std::vector<gpu::ProbeData> probes_;
  ProbeCaptures captures_;
  Renderer renderer_;
};

TEST_F(CapturedProbes, GiveOnePictureThroughMethodsAndPaths) {
  const HdrImage without = picture("all", ShadingPath::deferred);
  renew(PROBES);
  EXPECT_EQ(captures_.counts().drawn, PROBES);
  renderer_.light_probes(&captures_.set());
  const HdrImage reference = picture("all", ShadingPath::deferred);
  EXPECT_GT(max_abs_difference(reference, without), 0.01F);
  EXPECT_EQ(max_abs_difference(picture("tight", ShadingPath::deferred), reference), 0.0F);
  const HdrImage forward = picture("all", ShadingPath::forward);
  EXPECT_EQ(max_abs_difference(picture("lamplight", ShadingPath::forward), forward), 0.0F);
  const ProbeAtlas nothing(test_context(), shader_library(), 0);
  const ProbeSet flat(test_context(), nothing, gpu::PROBES_FLAT, probes_);
  renderer_.light_probes(&flat);
  EXPECT_GT(max_abs_difference(picture("all", ShadingPath::deferred), reference), 0.01F);
  renderer_.light_probes(nullptr);
}

TEST_F(CapturedProbes, FollowLightsWithinABudget) {
  renew(~0U);
  renderer_.light_probes(&captures_.set());
  const HdrImage before = picture("tight", ShadingPath::deferred);
  for (shared::Light& light : lights_) light.intensity = Vec3{};
  std::uint32_t drawn = 0;
  for (std::uint32_t frame = 0; frame < PROBES; ++frame) {
    captures_.renew({.views = {&view_, 1}, .lights = lights_, .changed = frame == 0}, 2);
    drawn += captures_.counts().drawn;
    EXPECT_LE(captures_.counts().drawn, 2U);
  }
  EXPECT_EQ(drawn, PROBES);
  EXPECT_EQ(captures_.counts().waiting, 0U);
  EXPECT_EQ(captures_.counts().captured, PROBES);
  const HdrImage dark = picture("tight", ShadingPath::deferred);
  for (std::size_t i = 0; i < dark.pixels.size(); ++i)
    ASSERT_TRUE(glm::all(glm::lessThanEqual(glm::vec3(dark.pixels[i]), glm::vec3(before.pixels[i]) + 0.05F))) << i;
  renderer_.light_probes(nullptr);
}

}  // namespace
}  // namespace lamp::app
