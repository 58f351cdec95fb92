// Walks of whole subgroups against the plain walk: each thread meets the same lights, in compute and in fragment
// shaders, over thin posts and cut-out leaves, where pixels of a subgroup lie in many cells and some are not shaded at
// all.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 161;
constexpr std::uint32_t HEIGHT = 91;
constexpr std::uint32_t LIGHTS = 200;

struct Param {
  const Method* method;
  std::string setting;
};

void PrintTo(const Param& param, std::ostream* out) { *out << param.method->name << " " << param.setting; }

/// Every row with walks, unless an earlier row makes the same look-ups; with every scalar walk that it takes.
std::vector<Param> params() {
  std::vector<Param> params;
  std::vector<std::string_view> results;
  for (const Method& method : methods()) {
    if (std::ranges::find(method.options, "walk", &OptionSpec::key) == method.options.end()) continue;
    if (std::ranges::find(results, method.result) != results.end()) continue;
    results.push_back(method.result);
    for (const char* walk : {"walk=scalar-cell", "walk=scalar-entity"})
      if (method.check({.width = 1, .height = 1, .options = take(resolve_options(method, {walk}))}) == std::nullopt)
        params.push_back({&method, walk});
  }
  return params;
}

class Walks : public GpuTest, public ::testing::WithParamInterface<Param> {};

TEST_P(Walks, MeetTheLightsOfThePlainWalk) {
  const auto& [method, setting] = GetParam();
  for (const char* name : {"posts", "atrium"}) {
    SCOPED_TRACE(name);
    const TestScene& scene = builtin_test_scene(name);
    const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "infinite");
    Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, LIGHTS);
    const LitCase lit = make_case(renderer, view, test_lights(scene.air, view, {.count = LIGHTS}));
    const Candidate plain{.method = method, .settings = {"walk=plain"}, .light_capacity = LIGHTS};
    const Candidate scalar{.method = method, .settings = {setting}, .light_capacity = LIGHTS};
    ASSERT_TRUE(
        kept_lighting(renderer, scalar, ShadingPath::deferred).runner().plan().lookup.name.ends_with("_scalar"));

    const Findings found = check_method(renderer, lit, scalar, Check::separate);
    const Findings expected = check_method(renderer, lit, plain, Check::separate);
    EXPECT_EQ(found.evaluations, expected.evaluations);
    EXPECT_EQ(found.list_sum, expected.list_sum);
    EXPECT_EQ(found.list_max, expected.list_max);
    renderer.set_frame(view, lit.lights);
    const HdrImage by_scalar = renderer.render(kept_lighting(renderer, scalar, ShadingPath::forward)).image;
    const HdrImage by_plain = renderer.render(kept_lighting(renderer, plain, ShadingPath::forward)).image;
    EXPECT_EQ(max_abs_difference(by_scalar, by_plain), 0.0F) << "forward shading";
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Walks, ::testing::ValuesIn(params()),
                         [](const auto& test) { return test_name(test.param.method->name); });

}  // namespace
}  // namespace lamp::app
