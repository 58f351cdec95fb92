// The four shading paths agree with each other on every scene, and each of them shows the same picture through every
// method: opaque and transparent surfaces, both reflection models.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/builtin.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 160;
constexpr std::uint32_t HEIGHT = 90;
constexpr std::uint32_t COUNT = 200;

struct PathParam {
  std::string_view scene;
  Brdf brdf;
};

void PrintTo(const PathParam& param, std::ostream* out) {
  *out << param.scene << (param.brdf == Brdf::ggx ? ", GGX" : ", Blinn-Phong");
}

std::vector<PathParam> path_params() {
  std::vector<PathParam> params;
  for (const BuiltinScene& scene : builtin_scenes())
    for (const Brdf brdf : {Brdf::ggx, Brdf::blinn_phong}) params.push_back({scene.name, brdf});
  return params;
}

/// Relative differences of two pictures' luminances.
struct Difference {
  double mean = 0.0;
  double share_above_5_percent = 0.0;
  double largest = 0.0;
};

Difference compare(const HdrImage& a, const HdrImage& b) {
  Difference difference;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double la = glm::dot(glm::dvec3(a.pixels[i]), glm::dvec3(0.2126, 0.7152, 0.0722));
    const double lb = glm::dot(glm::dvec3(b.pixels[i]), glm::dvec3(0.2126, 0.7152, 0.0722));
    const double relative = std::abs(la - lb) / (0.5 * (la + lb) + 1e-3);
    difference.mean += relative / static_cast<double>(a.pixels.size());
    difference.share_above_5_percent += (relative > 0.05 ? 1.0 : 0.0) / static_cast<double>(a.pixels.size());
    difference.largest = std::max(difference.largest, relative);
  }
  return difference;
}

class Paths : public GpuTest, public ::testing::WithParamInterface<PathParam> {
 protected:
  Paths()
      : scene_(builtin_test_scene(GetParam().scene)),
        view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT) {
    renderer_.set_frame(view_, test_lights(scene_.air, view_, {.count = COUNT, .mix = Mix::both}));
  }

  HdrImage picture(const Method& method, ShadingPath path) {
    Lighting lighting(renderer_.device(), shader_library(),
                      {.method = &method,
                       .options = take(resolve_options(method, {})),
                       .width = WIDTH,
                       .height = HEIGHT,
                       .light_capacity = COUNT,
                       .path = path,
                       .brdf = GetParam().brdf,
                       .transparency = !scene_.gpu.blended().empty()});
    return renderer_.render(lighting).image;
  }

  const TestScene& scene_;
  View view_;
  Renderer renderer_;
};

TEST_P(Paths, EveryMethodShowsBruteForcesPictureOnEveryPath) {
  for (const ShadingPath path : {ShadingPath::forward, ShadingPath::deferred, ShadingPath::tiled_deferred}) {
    const HdrImage reference = picture(brute_force(), path);
    EXPECT_GT(largest_value(reference), 0.01F);
    for (const Method& method : methods()) {
      if (method.approximate || &method == &brute_force()) continue;
      SCOPED_TRACE(fmt::format("{}, {}", method.name, path_names()[static_cast<std::size_t>(path)]));
      const float tolerance = method.ordered ? 0.0F : UNORDERED_TOLERANCE * (1.0F + largest_value(reference));
      EXPECT_LE(max_abs_difference(picture(method, path), reference), tolerance);
    }
  }
}

TEST_P(Paths, AgreeWithEachOther) {
  const HdrImage deferred = picture(brute_force(), ShadingPath::deferred);
  // Light volumes add the same terms in the same order, but to the surroundings, so that sums round differently.
  EXPECT_LT(compare(picture(brute_force(), ShadingPath::standard_deferred), deferred).largest, 1e-4);
  // Forward shading sees unquantised surfaces; glossy highlights show 8 bits of roughness most.
  const Difference forward = compare(picture(brute_force(), ShadingPath::forward), deferred);
  EXPECT_LT(forward.mean, 0.01);
  EXPECT_LT(forward.share_above_5_percent, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Paths, ::testing::ValuesIn(path_params()), [](const auto& test) {
  return fmt::format("{}__{}", test.param.scene, test.param.brdf == Brdf::ggx ? "ggx" : "blinn_phong");
});

TEST(PathsOfScenes, SomeSceneIsTransparent) {
  EXPECT_TRUE(std::ranges::any_of(builtin_scenes(), [](const BuiltinScene& scene) {
    return !builtin_test_scene(scene.name).gpu.blended().empty();
  })) << "no scene tests the transparent pass";
}

}  // namespace
}  // namespace lamp::app
