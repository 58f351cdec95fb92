// Every method against the oracle and brute force: scenes x projections x sizes x light counts x mixes.
// The design. At 1x1 and 17x31 pixels: methods x scenes x counts, on reliefs of the scenes (test_scenes.h), projections
// and every other count in turn (in_turn.h), so that each method meets each of them; the mix rotates with these, and
// every other time the fused look-up is checked too. The scenes themselves at 257x129: half of scenes x projections, as
// on a chessboard, with counts and mixes that rotate; at 640x360: each scene once. Methods take turns there too, and
// only brute force sits out what is too slow for it. Adversarial scenes: adversarial_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <ostream>
#include <set>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t LARGEST_COUNT = 4096;
constexpr std::uint64_t SLOW_EVALUATIONS = 1U << 28;  ///< of pixels times lights
constexpr glm::uvec2 SMALL_SIZES[] = {{1, 1}, {17, 31}};
constexpr glm::uvec2 MIDDLE(257, 129);
constexpr glm::uvec2 LARGE(640, 360);
constexpr Mix MIXES[] = {Mix::points, Mix::spots, Mix::both};

/// Room for exactly as many lights as there are, for one count at one size, which rotates slower than mixes do; else
/// for more. Each other capacity makes other pipelines, and a software device takes longer to compile them than to run
/// them.
std::uint32_t small_capacity(glm::uvec2 size, std::uint32_t count, std::size_t round) {
  constexpr std::uint32_t EXACT[] = {1, 33, 513};
  return size.x != 1 && count == EXACT[round / std::size(MIXES) % std::size(EXACT)] ? count : LARGEST_COUNT;
}

Mix small_mix(std::size_t count, std::size_t round, glm::uvec2 size) {
  return MIXES[(count + round + (size.x == 1 ? 1 : 0)) % std::size(MIXES)];
}

/// A scene as one projection shows it at one size, and the cases made of it so far.
class Stage {
 public:
  Stage(const TestScene& from, const Scene& scene, const View& view)
      : air_(from.air), view_(view), gpu_(test_context(), scene), renderer_(make_renderer(view)) {}

  Renderer& renderer() { return renderer_; }

  const LitCase& lit_case(std::uint32_t count, Mix mix) {
    const auto key = std::pair(count, mix);
    const auto found = cases_.find(key);
    if (found != cases_.end()) return found->second;
    const std::uint32_t seed = count + static_cast<std::uint32_t>(cases_.size());
    std::vector<shared::Light> lights = test_lights(air_, view_, {.count = count, .mix = mix, .seed = seed});
    return cases_.emplace(key, make_case(renderer_, view_, std::move(lights))).first->second;
  }

 private:
  [[nodiscard]] Renderer make_renderer(const View& view) const {
    return {test_context(), shader_library(), gpu_, view.width(), view.height(), LARGEST_COUNT};
  }

  const OpenAir& air_;
  View view_;
  GpuScene gpu_;
  Renderer renderer_;
  std::map<std::pair<std::uint32_t, Mix>, LitCase> cases_;
};

View view_of_test(const Scene& scene, std::string_view projection, glm::uvec2 size) {
  return view_of(find_camera(scene, ""), size.x, size.y, projection);
}

/// The relief of a built-in scene under a projection.
struct Relief {
  Relief(const TestScene& from, std::string_view projection, glm::uvec2 size)
      : view(view_of_test(from.scene, projection, size)),
        scene(relief_of(view, depth_of(from, view))),
        stage(from, scene, view) {}

  static std::vector<float> depth_of(const TestScene& from, const View& view) {
    Renderer renderer(test_context(), shader_library(), from.gpu, view.width(), view.height(), 0);
    return make_case(renderer, view, {}).depth;
  }

  View view;
  Scene scene;
  Stage stage;
};

struct SmallParam {
  std::string_view scene;
  std::string_view projection;
  const Method* method;
  std::size_t round;  ///< of this method: the mix rotates with it
};

void PrintTo(const SmallParam& param, std::ostream* out) {
  *out << param.method->name << ", " << param.scene << ", " << param.projection;
}

std::vector<SmallParam> small_params() {
  std::vector<SmallParam> params;
  const std::vector<std::string_view> projections = tested_projections();
  std::vector<std::size_t> rounds(methods().size());
  std::iota(rounds.begin(), rounds.end(), 0);
  std::size_t number_of_scene = 0;
  for (const BuiltinScene& scene : ordinary_scenes()) {
    for (std::size_t p = 0; p < projections.size(); ++p)
      for (std::size_t m = 0; m < methods().size(); ++m)
        if (has_turn(number_of_scene + p + m, projections.size()))
          params.push_back({scene.name, projections[p], &methods()[m], rounds[m]++});
    ++number_of_scene;
  }
  return params;
}

class SmallMatrix : public GpuTest, public ::testing::WithParamInterface<SmallParam> {
 protected:
  /// Tests of one scene and projection follow each other and share their reliefs.
  static Relief& relief(const SmallParam& param, glm::uvec2 size) {
    static std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<Relief>> reliefs;
    static std::string shown;
    if (shown.empty()) at_context_end([] { reliefs.clear(); });
    const std::string wanted = fmt::format("{} {}", param.scene, param.projection);
    if (wanted != shown) reliefs.clear();
    shown = wanted;
    std::unique_ptr<Relief>& kept = reliefs[{size.x, size.y}];
    if (kept == nullptr) kept = std::make_unique<Relief>(builtin_test_scene(param.scene), param.projection, size);
    return *kept;
  }
};

TEST_P(SmallMatrix, MissesNothingAndEqualsBruteForce) {
  for (const glm::uvec2 size : SMALL_SIZES) {
    Stage& stage = relief(GetParam(), size).stage;
    for (std::size_t c = 0; c < std::size(LIGHT_COUNTS); ++c) {
      const std::uint32_t count = LIGHT_COUNTS[c];
      if (!has_turn(c + GetParam().round + (size.x == 1 ? 1 : 0), 2)) continue;
      const Mix mix = small_mix(c, GetParam().round, size);
      SCOPED_TRACE(fmt::format("{}x{}, {} lights, {}", size.x, size.y, count, MIX_NAMES[static_cast<int>(mix)]));
      check_method(stage.renderer(), stage.lit_case(count, mix),
                   {.method = GetParam().method, .light_capacity = small_capacity(size, count, GetParam().round)},
                   (c / 2 + GetParam().round) % 2 == 0 ? Check::separate_and_fused : Check::separate);
      if (HasFailure()) return;  // one report is enough
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Full, SmallMatrix, ::testing::ValuesIn(small_params()), [](const auto& test) {
  return test_name(fmt::format("{}__{}__{}", test.param.method->name, test.param.scene, test.param.projection));
});

struct LargeParam {
  std::string_view scene;
  std::string_view projection;
  glm::uvec2 size;
  std::uint32_t count;
  Mix mix;
  std::size_t number = 0;  ///< methods take turns
};

void PrintTo(const LargeParam& param, std::ostream* out) {
  *out << fmt::format("{}, {}, {}x{}, {} lights, {}", param.scene, param.projection, param.size.x, param.size.y,
                      param.count, MIX_NAMES[static_cast<int>(param.mix)]);
}

std::vector<LargeParam> large_params() {
  std::vector<LargeParam> params;
  const std::vector<std::string_view> projections = tested_projections();
  const std::vector<BuiltinScene> scenes = ordinary_scenes();
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (std::size_t p = s % 2; p < projections.size(); p += 2) {
      const std::size_t round = params.size();
      params.push_back({scenes[s].name, projections[p], MIDDLE, LIGHT_COUNTS[round % std::size(LIGHT_COUNTS)],
                        MIXES[round % std::size(MIXES)]});
    }
  }
  params.push_back({"atrium", "perspective", LARGE, 129, Mix::both});
  params.push_back({"blocks", "off-centre", LARGE, 31, Mix::points});
  params.push_back({"posts", "orthographic", LARGE, 33, Mix::spots});
  params.push_back({"corridor", "infinite", LARGE, 32, Mix::both});
  params.push_back({"plane", "perspective", LARGE, 1, Mix::points});
  for (std::size_t i = 0; i < params.size(); ++i) params[i].number = i;
  return params;
}

class LargeMatrix : public GpuTest, public ::testing::WithParamInterface<LargeParam> {};

TEST_P(LargeMatrix, MissesNothingAndEqualsBruteForce) {
  const auto& [name, projection, size, count, mix, number] = GetParam();
  const TestScene& scene = builtin_test_scene(name);
  const View view = view_of_test(scene.scene, projection, size);
  const std::uint32_t capacity = size.x == LARGE.x ? count : LARGEST_COUNT;
  Renderer renderer(test_context(), shader_library(), scene.gpu, size.x, size.y, capacity);
  const LitCase lit =
      make_case(renderer, view, test_lights(scene.air, view, {.count = count, .mix = mix, .seed = count}));
  const bool slow = std::uint64_t{size.x} * size.y * count > SLOW_EVALUATIONS;
  for (std::size_t m = 0; m < methods().size(); ++m) {
    const Method& method = methods()[m];
    if (!has_turn(m + number, 2) || (slow && &method == &brute_force())) continue;
    SCOPED_TRACE(method.name);
    check_method(renderer, lit, {.method = &method, .light_capacity = capacity});
  }
}

INSTANTIATE_TEST_SUITE_P(Rotating, LargeMatrix, ::testing::ValuesIn(large_params()), [](const auto& test) {
  const LargeParam& p = test.param;
  return test_name(fmt::format("{}__{}__{}x{}", p.scene, p.projection, p.size.x, p.size.y));
});

TEST(MatrixDesign, EveryMethodMeetsEveryValue) {
  std::map<std::string_view, std::set<std::string>> met;
  for (const SmallParam& param : small_params()) {
    std::set<std::string>& values = met[param.method->name];
    values.insert({std::string(param.scene), std::string(param.projection)});
    for (std::size_t c = 0; c < std::size(LIGHT_COUNTS); ++c)
      if (has_turn(c + param.round, 2))
        values.insert({std::to_string(LIGHT_COUNTS[c]),
                       std::string(MIX_NAMES[static_cast<int>(small_mix(c, param.round, SMALL_SIZES[1]))])});
  }
  EXPECT_EQ(met.size(), methods().size());
  const std::size_t values = ordinary_scenes().size() + tested_projections().size();
  for (const auto& [name, of_method] : met)
    EXPECT_EQ(of_method.size(), values + std::size(LIGHT_COUNTS) + std::size(MIXES)) << name;
}

TEST(MatrixDesign, EveryValueOccursAtTheLargerSizes) {
  std::set<std::pair<std::uint32_t, std::string>> met;
  for (const LargeParam& param : large_params())
    for (const std::string& value : {std::string(param.scene), std::string(param.projection),
                                     std::to_string(param.count), std::string(MIX_NAMES[static_cast<int>(param.mix)])})
      met.emplace(param.size.x, value);
  for (const std::uint32_t width : {257U, 640U}) {
    for (const BuiltinScene& scene : ordinary_scenes()) EXPECT_TRUE(met.contains({width, std::string(scene.name)}));
    for (const std::string_view name : tested_projections()) EXPECT_TRUE(met.contains({width, std::string(name)}));
    for (const std::string_view mix : MIX_NAMES) EXPECT_TRUE(met.contains({width, std::string(mix)}));
  }
  for (const std::uint32_t count : LIGHT_COUNTS) EXPECT_TRUE(met.contains({257, std::to_string(count)})) << count;
}

}  // namespace
}  // namespace lamp::app
