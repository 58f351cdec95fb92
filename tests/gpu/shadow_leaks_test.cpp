// Leaks of each pixel, by rays on the GPU, against rays in double precision.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_leaks.h"

#include "gpu/hall.h"
#include "gpu/test_scenes.h"
#include "render/kept_rays.h"
#include "render/scene_occluders.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 64;
constexpr std::uint32_t HEIGHT = 36;

struct Listing {
  const char* method = "tight";
  std::vector<std::string> options;
};

/// Lights and their shadows, drawn where somebody asks for more than whether they can be.
class Shadowed {
 public:
  Shadowed(const GpuScene& scene, const ShadowSettings& settings, std::vector<shared::Light> lights,
           const Listing& listing = {})
      : scene_(scene),
        lights_(std::move(lights)),
        renderer_(test_context(), shader_library(), scene, WIDTH, HEIGHT, static_cast<std::uint32_t>(lights_.size())) {
    renderer_.cast_shadows(settings);
    renderer_.set_frame(view_of(scene.scene().cameras.front(), WIDTH, HEIGHT, "perspective"), lights_);
    LightingInfo info{.method = take(find_method(listing.method)),
                      .width = WIDTH,
                      .height = HEIGHT,
                      .light_capacity = static_cast<std::uint32_t>(lights_.size()),
                      .transparency = !scene.blended().empty(),
                      .shadows = settings.filter};
    info.options = take(resolve_options(*info.method, listing.options));
    lighting_.emplace(test_context().device(), shader_library(), info);
  }

  void draw() { static_cast<void>(renderer_.render(*lighting_)); }

  [[nodiscard]] std::vector<gpu::ShadowLeak> leaks() {
    return shadow_leaks(renderer_, *lighting_, rays_.of(test_context(), scene_, renderer_));
  }
  /// Instances have, from and to these places.
  void move(std::span<const shared::LightSphere> moved) {
    renderer_.move_instances(moved);
    rays_.move();
    renderer_.set_frame(view_of(scene_.scene().cameras.front(), WIDTH, HEIGHT, "perspective"), lights_);
  }
  [[nodiscard]] ShadowFindings truth() {
    return check_shadows(renderer_, shader_library(), scene_occluders(scene_.scene()), lights_);
  }
  [[nodiscard]] std::string why_not() const { return why_no_leaks(renderer_, *lighting_, scene_.scene()); }

 private:
  const GpuScene& scene_;
  std::vector<shared::Light> lights_;
  KeptRays rays_;  // lives on while the renderer remembers its use
  Renderer renderer_;
  std::optional<Lighting> lighting_;
};

std::vector<shared::Light> lights_in(const TestScene& scene) {
  return pack(place_lights(scene.air, {.count = 24, .spots = 0.5F, .min_range = 3.0F, .max_range = 8.0F}));
}

/// Sums that differ by a hundredth of themselves, and by what a few pairs bring whose ray passes an edge: 32 bits may
/// have it on the other side.
void expect_same(const ShadowFindings& truth, const LeakSums& sums) {
  const double few = 1e-4 * (truth.all.arriving + truth.all.stopped);
  const auto near = [&](const char* what, double found, double expected) {
    EXPECT_NEAR(found, expected, 0.01 * expected + few) << what;
  };
  near("arriving", sums.light.arriving, truth.all.arriving);
  near("stopped", sums.light.stopped, truth.all.stopped);
  near("leaked", sums.light.leaked, truth.all.leaked);
  near("lost", sums.light.lost, truth.all.lost);
  EXPECT_NEAR(static_cast<double>(sums.unclear), static_cast<double>(truth.unclear),
              0.01 * static_cast<double>(truth.pairs));
  EXPECT_EQ(sums.ended, 0U);
}

class ShadowLeaks : public GpuTest, public testing::WithParamInterface<std::tuple<const char*, ShadowFilter>> {};

TEST_P(ShadowLeaks, AreThoseOfRaysInDoublePrecision) {
  const auto [name, filter] = GetParam();
  const TestScene& scene = builtin_test_scene(name);
  Shadowed shadowed(scene.gpu, {.filter = filter, .atlas_size = 1024}, lights_in(scene));
  ASSERT_EQ(shadowed.why_not(), "");
  shadowed.draw();
  const ShadowFindings truth = shadowed.truth();
  ASSERT_EQ(truth.thinned, 1U);
  ASSERT_GT(truth.all.stopped, 0.0);
  ASSERT_GT(truth.all.leaked, 0.0);
  expect_same(truth, sum_of(shadowed.leaks()));
}

INSTANTIATE_TEST_SUITE_P(, ShadowLeaks,
                         testing::Combine(testing::Values("corridor", "posts"),
                                          testing::Values(ShadowFilter::hard, ShadowFilter::vsm)),
                         [](const auto& test) {
                           return test_name(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) == ShadowFilter::hard ? "Hard" : "Vsm");
                         });

TEST_F(GpuTest, WithoutMapsAllThatIsStoppedLeaksInEveryPixel) {
  const TestScene& scene = builtin_test_scene("corridor");
  Shadowed shadowed(scene.gpu, {.filter = ShadowFilter::hard, .budget_texels = 0}, lights_in(scene));
  shadowed.draw();
  std::size_t stopped = 0;
  for (const gpu::ShadowLeak& pixel : shadowed.leaks()) {
    ASSERT_EQ(pixel.leaked, pixel.stopped);
    ASSERT_EQ(pixel.lost, 0.0F);
    stopped += pixel.stopped > 0.0F ? 1 : 0;
  }
  EXPECT_GT(stopped, 20U);
}

/// A floor, and a light above it.
TEST_F(GpuTest, NothingLeaksWhereNothingIsStopped) {
  Scene scene = hall(1.0F);
  scene.materials[0] = {.roughness = 1.0F};
  scene.instances.resize(1);
  const GpuScene on_gpu(test_context(), scene);
  Shadowed shadowed(on_gpu, {.filter = ShadowFilter::vsm},
                    pack(std::vector<Light>{{.position = {0.0F, 2.0F, 0.0F}, .range = 20.0F}}));
  shadowed.draw();
  double arriving = 0.0;
  for (const gpu::ShadowLeak& pixel : shadowed.leaks()) {
    ASSERT_EQ(pixel.found, gpu::LEAK_FOUND);
    ASSERT_EQ(pixel.stopped, 0.0F);
    ASSERT_EQ(pixel.leaked, 0.0F);
    arriving += double{pixel.arriving};
  }
  EXPECT_GT(arriving, 0.0);
}

/// How much of a floor's light a square stops, in a scene that is scaled, then moved.
struct StoppedPart {
  double truth = 0.0;
  double leaks = 0.0;
};

StoppedPart stopped_by_a_square(float scale, float shift_m) {
  Scene scene = hall(0.4F);
  scene.materials[0] = {.roughness = 1.0F};
  const glm::vec3 shift(shift_m, 0.0F, shift_m);
  for (Instance& instance : scene.instances) {
    for (int axis = 0; axis < 3; ++axis) instance.world_from_object[axis] *= scale;
    instance.world_from_object[3] = glm::vec4(shift, 1.0F);
  }
  Camera& camera = scene.cameras.front();
  camera.world_from_camera[3] = glm::vec4(scale * glm::vec3(camera.world_from_camera[3]) + shift, 1.0F);
  camera.near_m *= scale;
  const GpuScene on_gpu(test_context(), scene);
  Light light;
  light.position = scale * glm::vec3(0.0F, 4.5F, 0.0F) + shift;
  light.range = 20.0F * scale;
  light.intensity = scale * scale;
  Shadowed shadowed(on_gpu, {.filter = ShadowFilter::hard}, pack(std::vector{light}));
  shadowed.draw();
  const ShadowFindings truth = shadowed.truth();
  const LeakSums leaks = sum_of(shadowed.leaks());
  EXPECT_EQ(truth.pairs, std::uint64_t{WIDTH} * HEIGHT);
  EXPECT_LT(truth.unclear, truth.pairs / 20);
  return {.truth = truth.all.stopped / (truth.all.stopped + truth.all.arriving),
          .leaks = leaks.light.stopped / (leaks.light.stopped + leaks.light.arriving)};
}

TEST_F(GpuTest, RaysAnswerInScenesOfAnySizeFarFromTheOriginToo) {
  const StoppedPart expected = stopped_by_a_square(1.0F, 0.0F);
  ASSERT_GT(expected.truth, 0.1);
  ASSERT_LT(expected.truth, 0.9);
  ASSERT_NEAR(expected.leaks, expected.truth, 0.01);
  const auto expect_same_part = [&](float scale, float shift_m) {
    SCOPED_TRACE(testing::Message() << "scaled by " << scale << ", moved by " << shift_m << " m");
    const StoppedPart found = stopped_by_a_square(scale, shift_m);
    const double row = 0.05;  // an edge lies along a row of pixels, and positions are coarse far out
    EXPECT_NEAR(found.truth, expected.truth, row);
    EXPECT_NEAR(found.leaks, expected.leaks, row);
  };
  expect_same_part(1.0F, 1e5F);
  expect_same_part(1e-3F, 0.0F);
  expect_same_part(100.0F, 0.0F);
}

/// A light above a ceiling, which goes and comes back.
TEST_F(GpuTest, RaysFollowAnInstanceThatMoves) {
  Scene scene = hall(6.0F);
  scene.materials[0] = {.roughness = 1.0F};
  scene.materials[1].double_sided = true;
  GpuScene on_gpu(test_context(), scene);
  Shadowed shadowed(on_gpu, {.filter = ShadowFilter::hard},
                    pack(std::vector<Light>{{.position = {0.0F, 5.0F, 0.0F}, .range = 40.0F}}));
  const auto light_at = [&](float x) {
    scene.instances[1].world_from_object[3].x = x;
    shadowed.move(on_gpu.move(test_context()));
    shadowed.draw();
    return sum_of(shadowed.leaks());
  };
  const LeakSums below = light_at(0.0F);
  EXPECT_GT(below.light.stopped, 0.0);
  EXPECT_EQ(below.light.arriving, 0.0);
  const LeakSums open = light_at(40.0F);
  EXPECT_EQ(open.light.stopped, 0.0);
  EXPECT_GT(open.light.arriving, 0.0);
  EXPECT_EQ(light_at(0.0F), below);
}

TEST_F(GpuTest, ListsThatShadowMapsCutSayNothingOfLeaks) {
  const TestScene& scene = builtin_test_scene("corridor");
  const Shadowed shadowed(scene.gpu, {.filter = ShadowFilter::hard, .atlas_size = 512}, lights_in(scene),
                          {.method = "lamplight", .options = {"occlusion=radial"}});
  EXPECT_NE(shadowed.why_not().find("lists leave out lights"), std::string::npos) << shadowed.why_not();
}

}  // namespace
}  // namespace lamp::app
