// Captured frames: what is captured, written and read again has the same lists through every method and the same
// picture, bit for bit; the four shading paths agree on it.
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstring>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/capture.h"
#include "scene/flight.h"
#include "scene/place_lights.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 54;
constexpr std::uint32_t COUNT = 150;

struct CaptureParam {
  std::string_view scene;
  std::string_view projection;
  LightsFormat lights;
};

std::string name_of(const CaptureParam& param) {
  return test_name(std::string(param.scene) + "__" + std::string(param.projection));
}

void PrintTo(const CaptureParam& param, std::ostream* out) { *out << name_of(param); }

/// Written and read again.
Scene through_files(const Scene& frame, LightsFormat lights) {
  const TemporaryFolder folder;
  write_capture(folder.path(), frame, lights);
  return load_capture(folder.path());
}

class Captures : public GpuTest, public ::testing::WithParamInterface<CaptureParam> {
 protected:
  Captures()
      : source_(builtin_test_scene(GetParam().scene)),
        view_(view_of(find_camera(source_.scene, ""), WIDTH, HEIGHT, GetParam().projection)),
        lights_(source_.scene.lights),
        renderer_(test_context(), shader_library(), source_.gpu, WIDTH, HEIGHT, COUNT + 64) {
    const std::vector<Light> more = place_lights(source_.air, {.count = COUNT});
    lights_.insert(lights_.end(), more.begin(), more.end());
    renderer_.set_frame(view_, pack(lights_));
  }

  Scene frame() {
    return {.lights = lights_,
            .directional_lights = source_.scene.directional_lights,
            .sky = source_.scene.sky,
            .ambient = source_.scene.ambient,
            .captured = renderer_.capture()};
  }

  const TestScene& source_;
  View view_;
  std::vector<Light> lights_;
  Renderer renderer_;
};

/// Which cell a pixel asked, and how many lights it walked; which ones, the counts of misses and of useful ones tell.
void expect_same_lists(Renderer& a, Renderer& b, const LitCase& lit) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    const Candidate candidate{.method = &method, .light_capacity = static_cast<std::uint32_t>(lit.lights.size())};
    Lighting with_a = make_lighting(a, candidate);
    Lighting with_b = make_lighting(b, candidate);
    std::vector<Visit> of_a = a.visit(with_a, lit.truth);
    std::vector<Visit> of_b = b.visit(with_b, lit.truth);
    if (!method.ordered)  // in which order lights come may be a race, which only a GPU of many cores shows
      for (std::vector<Visit>* visits : {&of_a, &of_b})
        for (Visit& visit : *visits) {
          visit.unordered = false;
          visit.hash = 0;
        }
    EXPECT_TRUE(of_a == of_b);
  }
}

TEST_P(Captures, ComeBackExactly) {
  const Scene read = through_files(frame(), GetParam().lights);
  ASSERT_TRUE(read.captured);
  EXPECT_EQ(read.captured->view.clip_from_view(), view_.clip_from_view());
  EXPECT_EQ(read.captured->view.view_from_world(), view_.view_from_world());
  const std::vector<shared::Light> before = pack(lights_);
  const std::vector<shared::Light> after = pack(read.lights);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(std::memcmp(after.data(), before.data(), before.size() * sizeof(shared::Light)), 0);

  const GpuScene gpu(test_context(), read);
  Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, COUNT + 64);
  const LitCase source = make_case(renderer_, view_, before);
  const LitCase copy = make_case(renderer, read.captured->view, after);
  EXPECT_GT(source.truth.lights.size(), 0U);
  EXPECT_EQ(copy.depth, source.depth);
  EXPECT_EQ(copy.truth.lights, source.truth.lights);
  EXPECT_GT(largest_value(source.reference), 0.01F);
  EXPECT_EQ(max_abs_difference(copy.reference, source.reference), 0.0F);
  expect_same_lists(renderer_, renderer, source);
}

bool has_pass(const Rendered& rendered, std::string_view name) {
  return std::ranges::any_of(rendered.passes, [&](const PassTime& pass) { return pass.name == name; });
}

TEST_P(Captures, KeptSurfacesStandForDrawnOnesUntilTheViewChanges) {
  Lighting lighting = make_lighting(renderer_, {.method = take(find_method("tiled")), .light_capacity = COUNT + 64});
  const Rendered drawn = renderer_.render(lighting);
  EXPECT_TRUE(has_pass(drawn, "g-buffer"));
  EXPECT_GT(largest_value(drawn.image), 0.01F);
  renderer_.keep_surfaces();
  const Rendered copied = renderer_.render(lighting, 2);
  EXPECT_TRUE(has_pass(copied, "captured surfaces"));
  EXPECT_FALSE(has_pass(copied, "g-buffer"));
  EXPECT_EQ(max_abs_difference(copied.image, drawn.image), 0.0F);

  const View other = view_of(find_camera(source_.scene, ""), WIDTH, HEIGHT,
                             GetParam().projection == "orthographic" ? "perspective" : "orthographic");
  renderer_.set_frame(other, pack(lights_));
  EXPECT_TRUE(has_pass(renderer_.render(lighting), "g-buffer"));
}

TEST_P(Captures, PathsAgree) {
  const Scene read = frame();
  const GpuScene gpu(test_context(), read);
  Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, COUNT + 64);
  renderer.set_frame(read.captured->view, pack(read.lights));
  const Method& method = *take(find_method("tiled"));
  const auto picture = [&](ShadingPath path) {
    Lighting lighting(renderer.device(), shader_library(),
                      {.method = &method,
                       .options = take(resolve_options(method, {})),
                       .width = WIDTH,
                       .height = HEIGHT,
                       .light_capacity = static_cast<std::uint32_t>(read.lights.size()),
                       .path = path,
                       .captured = true});
    return renderer.render(lighting).image;
  };
  const HdrImage deferred = picture(ShadingPath::deferred);
  EXPECT_EQ(max_abs_difference(picture(ShadingPath::tiled_deferred), deferred), 0.0F);
  EXPECT_LE(max_abs_difference(picture(ShadingPath::forward), deferred), 1e-5F * (1.0F + largest_value(deferred)));
  // Light volumes add to the surroundings, light by light, so that sums round differently.
  EXPECT_LE(max_abs_difference(picture(ShadingPath::standard_deferred), deferred),
            1e-4F * (1.0F + largest_value(deferred)));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Captures,
                         ::testing::Values(CaptureParam{"atrium", "camera", LightsFormat::npy},
                                           CaptureParam{"blocks", "orthographic", LightsFormat::json},
                                           CaptureParam{"posts", "off-centre", LightsFormat::npy},
                                           CaptureParam{"corridor", "perspective", LightsFormat::json},
                                           CaptureParam{"plane", "infinite", LightsFormat::npy}),
                         [](const auto& given) { return name_of(given.param); });

}  // namespace
}  // namespace lamp::app
