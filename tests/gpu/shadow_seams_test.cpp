// A plane casts no shadow on itself, at the seams of faces and octants least of all: there a point that is moved along
// its normal may be looked up in another face than its own.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <tuple>

#include "gpu/lit_lights.h"
#include "gpu/test_scenes.h"
#include "render/shadows.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t ATLAS = 2048;
/// Of the light's height: what is farther away the light grazes, where the offset is bounded.
constexpr float MOST_ASIDE = 1.6F;

class ShadowSeams : public GpuTest, public ::testing::WithParamInterface<std::tuple<PointShadows, ShadowFilter>> {};

std::vector<Light> lights_over_a_plane(test::Random& random) {
  std::vector<Light> lights;
  for (int i = 0; i < 12; ++i)
    lights.push_back(
        {.position = {random.in(-3.0F, 3.0F), random.in(0.5F, 3.0F), random.in(-3.0F, 3.0F)}, .range = 9.0F});
  return lights;
}

std::vector<shared::ShadowCase> cases_on_the_plane(const std::vector<Light>& lights, test::Random& random) {
  std::vector<shared::ShadowCase> cases(LIT_CASES);
  for (shared::ShadowCase& c : cases) {
    c.light = random.below(static_cast<std::uint32_t>(lights.size()));
    const glm::vec3 light = lights[c.light].position;
    const float aside = light.y * random.in(0.0F, MOST_ASIDE);
    const float angle = random.in(-3.2F, 3.2F);
    c.position = {light.x + aside * std::cos(angle), 0.0F, light.z + aside * std::sin(angle)};
    c.normal = {0.0F, 1.0F, 0.0F};
    c.seed = random.below(~0U);
  }
  return cases;
}

TEST_P(ShadowSeams, APlaneCastsNoShadowOnItself) {
  const auto [points, filter] = GetParam();
  test::Random random(3);
  const TestScene& scene = builtin_test_scene("plane");
  const View view = view_of(scene.scene.cameras.front(), 480, 270, "camera");
  const std::vector<Light> lights = lights_over_a_plane(random);
  Shadows shadows(test_context(), shader_library(), scene.gpu,
                  {.filter = filter, .points = points, .atlas_size = ATLAS}, static_cast<std::uint32_t>(lights.size()));
  shadows.schedule({&view, 1}, pack(lights));
  ASSERT_EQ(shadows.counts().shadowed, lights.size());
  vulkan::AccessTracker tracker;
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    shadows.record(recorder);
    recorder.barrier({reads(shadows.atlas().sampled(), VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)});
  });
  const std::vector<shared::ShadowCase> cases = cases_on_the_plane(lights, random);
  const LitLights lit{.maps = {shadows.maps().begin(), shadows.maps().end()}};
  const std::vector<float> lit_shares = shadows_of(cases, lit, shadows.atlas(), filter);
  std::uint32_t shaded = 0;
  for (const float share : lit_shares) shaded += share < 1.0F ? 1 : 0;
  EXPECT_EQ(shaded, 0U);
}

INSTANTIATE_TEST_SUITE_P(Of, ShadowSeams,
                         ::testing::Combine(::testing::Values(PointShadows::faces, PointShadows::octahedron),
                                            ::testing::Values(ShadowFilter::hard, ShadowFilter::pcf)));

}  // namespace
}  // namespace lamp::app
