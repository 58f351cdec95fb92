// Decals: looked up through every method without a miss, painted alike by all of them on every path; one decal's known
// texels; what lies on top; captures.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "gpu/test_surfaces.h"
#include "render/box_shapes.h"
#include "render/decal_pass.h"
#include "scene/flight.h"
#include "scene/place_decals.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 80;
constexpr std::uint32_t HEIGHT = 45;
constexpr std::uint32_t LIGHTS = 70;
constexpr std::uint32_t DECALS = 90;
constexpr std::array PATHS{ShadingPath::deferred, ShadingPath::forward, ShadingPath::standard_deferred,
                           ShadingPath::tiled_deferred};

/// What a picture with decals is made of.
struct Decorated {
  View view;
  std::vector<shared::Light> lights;
  std::vector<gpu::DecalData> decals;
};

/// A renderer over a scene, and lightings for its frames.
class DecalTest : public GpuTest {
 protected:
  static Lighting lighting(const Renderer& renderer, const Method& method, ShadingPath path, bool decals,
                           const std::vector<std::string>& settings = {}, bool glass = false) {
    return {renderer.device(),
            shader_library(),
            {.method = &method,
             .options = take(resolve_options(method, with_box_shapes(method, settings, /* boxes= */ true))),
             .width = renderer.targets().width,
             .height = renderer.targets().height,
             .light_capacity = LIGHTS + DECALS,
             .path = path,
             .transparency = glass,
             .decals = decals}};
  }

  static Findings find_decals(Renderer& renderer, Lighting& lit, const Truth& truth,
                              vulkan::PlanRunner::Passes which = vulkan::PlanRunner::Passes::separate) {
    Verification verification(renderer.targets().width);
    verification.add(truth, renderer.visit(lit, truth, which, Renderer::Kind::decals));
    return verification.findings();
  }
};

Truth truth_of_decals(const Decorated& frame, const std::vector<float>& depth) {
  const std::vector<shared::OrientedBox> boxes = boxes_of(frame.decals);
  return truth({.view = frame.view,
                .depth = depth,
                .lights = {},
                .rows = frame.view.height(),
                .boxes = boxes,
                .first_id = static_cast<std::uint32_t>(frame.lights.size())});
}

class DecoratedAtrium : public DecalTest {
 protected:
  explicit DecoratedAtrium()
      : scene_(builtin_test_scene("atrium")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, LIGHTS, DECALS) {}

  Decorated frame(std::string_view projection) const {
    const View view = view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, projection);
    return {.view = view,
            .lights = test_lights(scene_.air, view, {.count = LIGHTS, .mix = Mix::both}),
            .decals = pack(place_decals(scene_.scene, DECALS, 5))};
  }

  /// A method's decals and lights against the oracle, its picture against brute force's.
  void check(const Method& method, const Decorated& shown, ShadingPath path,
             const std::vector<std::string>& settings = {}) {
    renderer_.set_frame(shown.view, shown.lights, shown.decals);
    Lighting brute = lighting(renderer_, brute_force(), path, true, {}, true);
    const HdrImage reference = renderer_.render(brute).image;
    const std::vector<float> depth = renderer_.read_depth();
    const Truth of_decals = truth_of_decals(shown, depth);
    EXPECT_GT(of_decals.lights.size(), 50U) << "nothing to miss";
    const Truth of_lights = truth({.view = shown.view, .depth = depth, .lights = shown.lights, .rows = HEIGHT});

    Lighting lit = lighting(renderer_, method, path, true, settings, true);
    const Plan& plan = lit.runner().plan();
    const HdrImage picture = renderer_.render(lit).image;
    Verification verification(WIDTH);
    verification.add(of_lights, renderer_.visit(lit, of_lights));
    expect_kept(plan, verification.findings(), of_lights, LIGHTS);
    expect_kept(plan, find_decals(renderer_, lit, of_decals), of_decals, DECALS);
    if (plan.fused) {
      SCOPED_TRACE("fused");
      expect_kept(plan, find_decals(renderer_, lit, of_decals, vulkan::PlanRunner::Passes::fused), of_decals, DECALS);
    }
    if (!plan.approximate) {
      EXPECT_LE(max_abs_difference(picture, reference), picture_tolerance(plan, reference));
    }
  }

  static void expect_kept(const Plan& plan, const Findings& findings, const Truth& truth, std::uint32_t most) {
    EXPECT_FALSE(plan.ordered && findings.unordered);
    EXPECT_LE(findings.list_max, most) << "ids of another kind were walked";
    if (plan.approximate) return;
    EXPECT_EQ(findings.missed, 0U) << findings.first_miss;
    EXPECT_EQ(findings.useful, truth.lights.size());
    EXPECT_GE(findings.evaluations, findings.useful);
  }

  const TestScene& scene_;
  Renderer renderer_;
};

class DecalMethods : public DecoratedAtrium, public ::testing::WithParamInterface<const Method*> {};

/// Each projection and each path, or every other in turn; which of them together differs from method to method.
TEST_P(DecalMethods, MissNoneAndPaintAsBruteForceDoes) {
  const auto number = static_cast<std::size_t>(GetParam() - methods().data());
  const std::vector<std::string_view> projections = tested_projections();
  for (std::size_t i = 0; i < std::max(projections.size(), PATHS.size()); ++i) {
    if (!has_turn(i + number / PATHS.size(), 2)) continue;
    const std::string_view projection = projections[i % projections.size()];
    const ShadingPath path = PATHS[(i + number) % PATHS.size()];
    SCOPED_TRACE(fmt::format("{}, {}", projection, path_names()[static_cast<std::size_t>(path)]));
    check(*GetParam(), frame(projection), path);
    if (HasFailure()) return;
  }
}

std::vector<const Method*> all_methods() {
  std::vector<const Method*> all;
  for (const Method& method : methods()) all.push_back(&method);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Table, DecalMethods, ::testing::ValuesIn(all_methods()),
                         [](const auto& test) { return test_name(test.param->name); });

/// Walks that the rows do not use by default, lists in no order, and lists that do not fit.
TEST_F(DecoratedAtrium, OtherWalksAndListsThatOverflow) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"tiled", {"walk=scalar-cell"}},
      {"tiled", {"order=append", "walk=scalar-cell"}},
      {"tiled", {"capacity=1"}},
      {"tiled", {"order=type", "mean_capacity=1"}},
      {"tiled-bits", {"walk=scalar-entity"}},
      {"clustered", {"mean_capacity=1"}},
      {"clustered", {"mean_capacity=1", "walk=scalar-cell"}},
      {"clustered", {"container=bits", "walk=plain"}},
      {"drobot-zbin", {"walk=plain"}},
      {"drobot-zbin", {"sort=cpu"}}};
  const Decorated shown = frame("perspective");
  ShadingPath path = ShadingPath::deferred;
  for (const auto& [name, settings] : cases) {
    SCOPED_TRACE(fmt::format("{} {}", name, fmt::join(settings, " ")));
    check(*take(find_method(name)), shown, path, settings);
    path = path == ShadingPath::deferred ? ShadingPath::forward : ShadingPath::deferred;
  }
}

TEST_F(DecoratedAtrium, AreSeen) {
  Decorated shown = frame("perspective");
  renderer_.set_frame(shown.view, shown.lights, shown.decals);
  for (const ShadingPath path : PATHS) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    Lighting with = lighting(renderer_, *take(find_method("clustered")), path, true);
    renderer_.set_frame(shown.view, shown.lights, shown.decals);
    const HdrImage painted = renderer_.render(with).image;
    renderer_.set_frame(shown.view, shown.lights);
    Lighting without = lighting(renderer_, *take(find_method("clustered")), path, false);
    const HdrImage bare = renderer_.render(without).image;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < bare.pixels.size(); ++i) changed += painted.pixels[i] != bare.pixels[i] ? 1 : 0;
    EXPECT_GT(changed, bare.pixels.size() / 50);
    EXPECT_LT(changed, bare.pixels.size() / 2);
    // A lighting that is ready for decals, and a frame that has none: the same bits.
    EXPECT_EQ(max_abs_difference(renderer_.render(with).image, bare), 0.0F);
  }
}

/// The check can fail: decals that the cells were not told of are missed.
TEST_F(DecoratedAtrium, OnesThatWereNotCulledAreMissed) {
  const Decorated shown = frame("perspective");
  Decorated moved = shown;
  for (gpu::DecalData& decal : moved.decals) decal.box.center.y += 400.0F;
  renderer_.set_frame(moved.view, moved.lights, moved.decals);
  Lighting lit = lighting(renderer_, *take(find_method("tight")), ShadingPath::deferred, true);
  (void)renderer_.render(lit);
  const Truth of_decals = truth_of_decals(shown, renderer_.read_depth());
  const Findings findings = find_decals(renderer_, lit, of_decals);
  EXPECT_EQ(findings.missed, of_decals.lights.size());
  EXPECT_NE(findings.first_miss.find("pixel"), std::string::npos);
}

/// A wall, and decals on it, as the G-buffer shows them.
class DecoratedWall : public DecalTest {
 protected:
  static constexpr glm::vec3 GREY{0.5F};

  DecoratedWall()
      : scene_(wall_scene({.base_color = glm::vec4(GREY, 1.0F)})),
        gpu_(test_context(), scene_),
        renderer_(test_context(), shader_library(), gpu_, WIDTH, HEIGHT, LIGHTS, DECALS) {}

  static Decal on_wall(const glm::vec3& center, float turn, const glm::vec3& color) {
    return {.center = center,
            .orientation = glm::angleAxis(turn, glm::vec3(0.0F, 0.0F, 1.0F)),
            .half_extents = {0.8F, 0.4F, 0.1F},
            .pattern = DecalPattern::plain,
            .color_a = color};
  }

  CapturedFrame surfaces(const std::vector<Decal>& decals, std::string_view method = "clustered",
                         std::string_view projection = "camera") {
    decals_ = pack(decals);
    view_ = view_of(find_camera(scene_, ""), WIDTH, HEIGHT, projection);
    renderer_.set_frame(view_, {}, decals_);
    Lighting lit = lighting(renderer_, *take(find_method(method)), ShadingPath::deferred, true);
    return renderer_.capture(&lit);
  }

  Scene scene_;
  GpuScene gpu_;
  Renderer renderer_;
  View view_;
  std::vector<gpu::DecalData> decals_;
};

/// Inside the box the decal's colour and no other, outside it the wall's, as the oracle says; normals stay.
TEST_F(DecoratedWall, OneDecalCoversWhatTheOracleSays) {
  const glm::vec3 color(0.8F, 0.1F, 0.05F);
  for (const std::string_view projection : tested_projections()) {
    SCOPED_TRACE(projection);
    const CapturedFrame frame = surfaces({on_wall({0.3F, -0.2F, 0.02F}, 0.5F, color)}, "clustered", projection);
    std::size_t inside = 0;
    for (std::uint32_t y = 0; y < HEIGHT; ++y) {
      for (std::uint32_t x = 0; x < WIDTH; ++x) {
        const std::size_t i = std::size_t{y} * WIDTH + x;
        if (frame.depth[i] == 0.0F) continue;
        // The shader's 32-bit position is some 1e-6 m off: too near to the edge, either is right.
        const glm::dvec3 position = view_.world_position(x, y, static_cast<double>(frame.depth[i]));
        shared::OrientedBox smaller = decals_[0].box;
        shared::OrientedBox larger = decals_[0].box;
        smaller.half_extents = glm::vec3(smaller.half_extents) * 0.9999F;
        larger.half_extents = glm::vec3(larger.half_extents) * 1.0001F;
        const bool is_inside = reach(smaller, position) == Reach::inside;
        if (!is_inside && reach(larger, position) == Reach::inside) continue;
        inside += is_inside ? 1 : 0;
        EXPECT_LT(glm::length(frame.albedo[i] - (is_inside ? color : GREY)), 0.02F) << x << ", " << y;
        EXPECT_LT(glm::length(frame.normal[i] - glm::vec3(0.0F, 0.0F, 1.0F)), 1e-3F);
      }
    }
    EXPECT_GT(inside, 20U);
  }
}

/// The later of two lies on top, through lists in any order; half of opacity is half of the paint.
TEST_F(DecoratedWall, LaterOnesLieOnTop) {
  const glm::vec3 red(0.6F, 0.0F, 0.0F);
  const glm::vec3 blue(0.0F, 0.0F, 0.6F);
  std::size_t number = 0;
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    std::vector<Decal> decals{on_wall({}, 0.0F, red), on_wall({}, 0.0F, blue)};
    ++number;
    for (std::size_t order = 0; order < 2; ++order, std::swap(decals[0], decals[1])) {
      if (!has_turn(number + order, 2)) continue;
      const CapturedFrame frame = surfaces(decals, method.name);
      const glm::vec3 middle = frame.albedo[std::size_t{HEIGHT / 2} * WIDTH + WIDTH / 2];
      EXPECT_LT(glm::length(middle - decals[1].color_a), 0.02F);
    }
  }
  std::vector<Decal> half{on_wall({}, 0.0F, red), on_wall({}, 0.0F, blue)};
  half[1].opacity = 0.5F;
  const glm::vec3 mixed = surfaces(half).albedo[std::size_t{HEIGHT / 2} * WIDTH + WIDTH / 2];
  EXPECT_LT(glm::length(mixed - 0.5F * (red + blue)), 0.02F);
}

TEST_F(DecoratedWall, FadesByTheAngleAndBendsNormals) {
  const std::size_t middle = std::size_t{HEIGHT / 2} * WIDTH + WIDTH / 2;
  const glm::vec3 red(0.6F, 0.0F, 0.0F);
  const auto tilted = [&](float angle) {
    Decal decal = on_wall({}, 0.0F, red);
    decal.orientation = glm::angleAxis(angle, glm::vec3(1.0F, 0.0F, 0.0F));
    decal.full_angle = 0.4F;
    decal.none_angle = 1.0F;
    return surfaces({decal}).albedo[middle];
  };
  EXPECT_LT(glm::length(tilted(0.3F) - red), 0.02F);
  EXPECT_LT(glm::length(tilted(1.1F) - GREY), 0.02F);
  EXPECT_LT(glm::length(tilted(3.1F) - GREY), 0.02F) << "painted from behind";
  const auto share = static_cast<float>((std::cos(0.7) - std::cos(1.0)) / (std::cos(0.4) - std::cos(1.0)));
  EXPECT_LT(glm::length(tilted(0.7F) - glm::mix(GREY, red, share)), 0.03F);

  Decal moss = on_wall({}, 0.0F, red);
  moss.pattern = DecalPattern::moss;
  moss.relief = 0.03F;
  const CapturedFrame frame = surfaces({moss});
  const auto bent = std::ranges::count_if(
      frame.normal, [](const glm::vec3& n) { return glm::length(n - glm::vec3(0.0F, 0.0F, 1.0F)) > 0.05F; });
  EXPECT_GT(bent, 10);
  for (const glm::vec3& n : frame.normal) EXPECT_NEAR(glm::length(n), 1.0F, 1e-3F);
}

/// A capture of a decorated frame, shown again without decals, is the same picture.
TEST_F(DecoratedAtrium, StayInCaptures) {
  const Decorated shown = frame("perspective");
  renderer_.set_frame(shown.view, shown.lights, shown.decals);
  Lighting lit = lighting(renderer_, brute_force(), ShadingPath::deferred, true);
  const HdrImage picture = renderer_.render(lit).image;
  const Scene captured{.directional_lights = scene_.scene.directional_lights,
                       .sky = scene_.scene.sky,
                       .ambient = scene_.scene.ambient,
                       .captured = renderer_.capture(&lit)};
  const GpuScene gpu(test_context(), captured);
  Renderer again(test_context(), shader_library(), gpu, WIDTH, HEIGHT, LIGHTS);
  again.set_frame(shown.view, shown.lights);
  Lighting bare = lighting(again, brute_force(), ShadingPath::deferred, false);
  EXPECT_EQ(max_abs_difference(again.render(bare).image, picture), 0.0F);
}

}  // namespace
}  // namespace lamp::app
