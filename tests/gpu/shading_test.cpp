// The four shading paths agree with each other on every scene under both reflection models; and through every method a
// path shows brute force's picture, transparent surfaces included. (Shading in compute meets every method in the
// matrix; here it is above all forward shading's turn.)
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 160;
constexpr std::uint32_t HEIGHT = 90;
constexpr std::uint32_t COUNT = 200;

/// A scene, and the way it is shaded.
struct PathParam {
  std::string_view scene;
  Brdf brdf;
  ShadingPath path = ShadingPath::forward;
  std::size_t number = 0;  ///< methods take turns
};

std::string name_of(const PathParam& param) {
  return test_name(fmt::format("{}__{}__{}", param.scene, param.brdf == Brdf::ggx ? "ggx" : "blinn_phong",
                               path_names()[static_cast<std::size_t>(param.path)]));
}

void PrintTo(const PathParam& param, std::ostream* out) { *out << name_of(param); }

std::vector<PathParam> scenes_and_brdfs() {
  std::vector<PathParam> params;
  for (const BuiltinScene& scene : ordinary_scenes())
    for (const Brdf brdf : {Brdf::ggx, Brdf::blinn_phong}) params.push_back({scene.name, brdf});
  return params;
}

/// Forward on every scene; the other paths and the other model where there is glass.
std::vector<PathParam> scenes_and_paths() {
  std::vector<PathParam> params;
  for (const BuiltinScene& scene : ordinary_scenes()) params.push_back({scene.name, Brdf::ggx});
  params.push_back({"atrium", Brdf::blinn_phong, ShadingPath::deferred});
  params.push_back({"atrium", Brdf::blinn_phong, ShadingPath::tiled_deferred});
  for (std::size_t i = 0; i < params.size(); ++i) params[i].number = i;
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

class ShadedScene : public GpuTest, public ::testing::WithParamInterface<PathParam> {
 protected:
  ShadedScene()
      : scene_(builtin_test_scene(GetParam().scene)),
        view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT) {
    renderer_.set_frame(view_, test_lights(scene_.air, view_, {.count = COUNT, .mix = Mix::both}));
  }

  Lighting lighting(const Method& method, ShadingPath path) {
    return Lighting(renderer_.device(), shader_library(),
                    {.method = &method,
                     .options = take(resolve_options(method, {})),
                     .width = WIDTH,
                     .height = HEIGHT,
                     .light_capacity = COUNT,
                     .path = path,
                     .brdf = GetParam().brdf,
                     .transparency = !scene_.gpu.blended().empty()});
  }

  HdrImage picture(Lighting lighting) { return renderer_.render(lighting).image; }

  const TestScene& scene_;
  View view_;
  Renderer renderer_;
};

class MethodPictures : public ShadedScene {};

TEST_P(MethodPictures, EqualBruteForce) {
  const HdrImage reference = picture(lighting(brute_force(), GetParam().path));
  EXPECT_GT(largest_value(reference), 0.01F);
  for (std::size_t m = 0; m < methods().size(); ++m) {
    if (!has_turn(m + GetParam().number, 2)) continue;
    const Method& method = methods()[m];
    SCOPED_TRACE(method.name);
    Lighting lit = lighting(method, GetParam().path);
    const Plan plan = lit.runner().plan();
    if (plan.approximate || &method == &brute_force()) continue;
    EXPECT_LE(max_abs_difference(picture(std::move(lit)), reference), picture_tolerance(plan, reference));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MethodPictures, ::testing::ValuesIn(scenes_and_paths()),
                         [](const auto& test) { return name_of(test.param); });

class Paths : public ShadedScene {};

TEST_P(Paths, AgreeWithEachOther) {
  const HdrImage deferred = picture(lighting(brute_force(), ShadingPath::deferred));
  // Light volumes add the same terms in the same order, but to the surroundings, so that sums round differently.
  EXPECT_LT(compare(picture(lighting(brute_force(), ShadingPath::standard_deferred)), deferred).largest, 1e-4);
  // Forward shading sees unquantised surfaces; glossy highlights show 8 bits of roughness most.
  const Difference forward = compare(picture(lighting(brute_force(), ShadingPath::forward)), deferred);
  EXPECT_LT(forward.mean, 0.01);
  EXPECT_LT(forward.share_above_5_percent, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Paths, ::testing::ValuesIn(scenes_and_brdfs()),
                         [](const auto& test) { return name_of(test.param); });

/// G-buffers keep emission in half floats, which end at 65504.
TEST_F(GpuTest, StrongEmissionIsTheSameThroughEveryPath) {
  Scene scene = builtin_test_scene("posts").scene;
  for (Material& material : scene.materials) material.emissive = glm::vec3(1e6F, 1.0F, 0.0F);
  const TestScene bright(std::move(scene));
  const View view = view_of(bright.scene.cameras.front(), WIDTH, HEIGHT, "perspective");
  Renderer renderer(test_context(), shader_library(), bright.gpu, WIDTH, HEIGHT, 1);
  renderer.set_frame(view, std::vector<shared::Light>(1));
  const auto picture = [&](ShadingPath path) {
    Lighting lighting(test_context().device(), shader_library(),
                      {.method = &brute_force(), .width = WIDTH, .height = HEIGHT, .light_capacity = 1, .path = path});
    return renderer.render(lighting).image;
  };
  const HdrImage deferred = picture(ShadingPath::deferred);
  EXPECT_NEAR(largest_value(deferred), 65504.0F, 100.0F);
  EXPECT_LT(max_abs_difference(picture(ShadingPath::forward), deferred), 100.0F);
}

TEST(TransparentScenes, TheAtriumHasGlass) {
  EXPECT_FALSE(builtin_test_scene("atrium").gpu.blended().empty()) << "nothing tests transparency";
}

}  // namespace
}  // namespace lamp::app
