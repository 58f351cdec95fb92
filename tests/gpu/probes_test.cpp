// Reflection probes: looked up through every method without a miss, shaded alike by all of them on every path; odd
// cases.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "gpu/test_surfaces.h"
#include "render/box_shapes.h"
#include "render/decal_pass.h"
#include "render/pixel_lights.h"
#include "render/place_probes.h"
#include "scene/flight.h"
#include "scene/place_decals.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 80;
constexpr std::uint32_t HEIGHT = 45;
constexpr std::uint32_t LIGHTS = 40;
constexpr std::uint32_t DECALS = 30;
constexpr std::uint32_t PROBES = 60;
constexpr std::array PATHS{ShadingPath::deferred, ShadingPath::forward, ShadingPath::standard_deferred,
                           ShadingPath::tiled_deferred};

/// What a picture with probes is made of.
struct Reflecting {
  View view;
  std::vector<shared::Light> lights;
  std::vector<gpu::DecalData> decals;
  std::vector<Probe> probes;
};

class ProbeAtrium : public GpuTest {
 protected:
  ProbeAtrium() : scene_(builtin_test_scene("atrium")), captures_(test_context(), shader_library(), 0) {}

  [[nodiscard]] View view(std::string_view projection = "perspective") const {
    return view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, projection);
  }
  [[nodiscard]] Reflecting frame(std::string_view projection = "perspective") const {
    static const std::vector<Probe> PLACED = place_probes(scene_.scene, PROBES, 3);
    return {.view = view(projection),
            .lights = test_lights(scene_.air, view(projection), {.count = LIGHTS, .mix = Mix::both}),
            .decals = pack(place_decals(scene_.scene, DECALS, 5)),
            .probes = PLACED};
  }

  /// A renderer that shows a frame.
  Renderer& show(const Reflecting& shown) {
    renderer_.reset();
    packed_ = pack(shown.probes);
    set_.emplace(test_context(), captures_, shown.probes.empty() ? gpu::PROBES_OFF : gpu::PROBES_FLAT, packed_);
    renderer_.emplace(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT,
                      static_cast<std::uint32_t>(shown.lights.size()), static_cast<std::uint32_t>(shown.decals.size()));
    renderer_->light_probes(&*set_);
    renderer_->set_frame(shown.view, shown.lights, shown.decals);
    return *renderer_;
  }
  [[nodiscard]] Lighting lighting(const Method& method, ShadingPath path,
                                  const std::vector<std::string>& settings = {}) const {
    return {renderer_->device(),
            shader_library(),
            {.method = &method,
             .options = take(resolve_options(method, with_box_shapes(method, settings, /* boxes= */ true))),
             .width = WIDTH,
             .height = HEIGHT,
             .light_capacity = renderer_->data().entities().boxes.end,
             .path = path,
             .transparency = true,
             .decals = renderer_->data().entities().decals.count() != 0,
             .probes = renderer_->probes().kind()}};
  }
  [[nodiscard]] Truth truth_of_probes(const std::vector<float>& depth) const {
    const std::vector<shared::OrientedBox> boxes = boxes_of(packed_);
    const std::vector<EntityShape> shapes = shapes_of(packed_);
    return truth({.view = renderer_->view(),
                  .depth = depth,
                  .lights = {},
                  .rows = HEIGHT,
                  .boxes = boxes,
                  .shapes = shapes,
                  .first_id = renderer_->data().entities().probes.first});
  }

  /// What the separate look-up walks and misses of the probes.
  Findings findings_of(const Method& method, const std::vector<std::string>& settings) {
    Lighting lit = lighting(method, ShadingPath::deferred, settings);
    (void)renderer_->render(lit);
    const Truth truth = truth_of_probes(renderer_->read_depth());
    Verification verification(WIDTH);
    verification.add(truth, renderer_->visit(lit, truth, vulkan::PlanRunner::Passes::separate, Renderer::Kind::probes));
    return verification.findings();
  }

  void expect_none_missed(Lighting& lit, const Truth& truth, vulkan::PlanRunner::Passes which) {
    Verification verification(WIDTH);
    verification.add(truth, renderer_->visit(lit, truth, which, Renderer::Kind::probes));
    const Findings findings = verification.findings();
    EXPECT_LE(findings.list_max, packed_.size()) << "ids of another kind were walked";
    if (lit.runner().plan().approximate) return;
    EXPECT_EQ(findings.missed, 0U) << findings.first_miss;
    EXPECT_EQ(findings.useful, truth.lights.size());
  }

  /// A method's probes against the oracle, its picture against brute force's.
  void check(const Method& method, ShadingPath path, const std::vector<std::string>& settings = {}) {
    Lighting brute = lighting(brute_force(), path);
    const HdrImage reference = renderer_->render(brute).image;
    const Truth truth = truth_of_probes(renderer_->read_depth());
    Lighting lit = lighting(method, path, settings);
    const Plan& plan = lit.runner().plan();
    const HdrImage picture = renderer_->render(lit).image;
    expect_none_missed(lit, truth, vulkan::PlanRunner::Passes::separate);
    if (plan.fused) expect_none_missed(lit, truth, vulkan::PlanRunner::Passes::fused);
    if (plan.approximate) return;
    EXPECT_LE(max_abs_difference(picture, reference), picture_tolerance(plan, reference));
  }

  const TestScene& scene_;
  ProbeAtlas captures_;
  std::vector<gpu::ProbeData> packed_;
  std::optional<ProbeSet> set_;
  std::optional<Renderer> renderer_;
};

class ProbeMethods : public ProbeAtrium, public ::testing::WithParamInterface<const Method*> {};

/// With decals and without; which path and projection a method meets differs from method to method.
TEST_P(ProbeMethods, MissNoneAndShadeAsBruteForceDoes) {
  const auto number = static_cast<std::size_t>(GetParam() - methods().data());
  const ShadingPath path = PATHS[(number + number / PATHS.size()) % PATHS.size()];
  const std::vector<std::string_view> projections = tested_projections();
  Reflecting shown = frame(projections[number % projections.size()]);
  if (number / 2 % 2 == 1) shown.decals.clear();
  SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
  show(shown);
  check(*GetParam(), path);
}

std::vector<const Method*> all_methods() {
  std::vector<const Method*> all;
  for (const Method& method : methods()) all.push_back(&method);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Table, ProbeMethods, ::testing::ValuesIn(all_methods()),
                         [](const auto& test) { return test_name(test.param->name); });

/// By their shape, probes are walked far less in vain than by their spheres; lists that are pruned by pixel hold what
/// reaches a pixel of their tile and nothing else.
TEST_F(ProbeAtrium, ShapesShortenTheWalk) {
  show(frame());
  for (const char* name : {"tiled-bits", "clustered", "drobot-zbin", "drobot-raster-tile", "lamplight"}) {
    SCOPED_TRACE(name);
    const Method& method = *take(find_method(name));
    const Findings by_sphere = findings_of(method, {"boxes=sphere"});
    const Findings by_shape = findings_of(method, {"boxes=shape"});
    EXPECT_EQ(by_shape.missed, 0U) << by_shape.first_miss;
    EXPECT_EQ(by_shape.useful, by_sphere.useful);
    EXPECT_LT(by_shape.evaluations - by_shape.useful, (by_sphere.evaluations - by_sphere.useful) * 3 / 4);
  }
  const Method& tight = *take(find_method("tight"));
  EXPECT_EQ(findings_of(tight, {"boxes=shape"}).excess(), 1.0);
  EXPECT_GT(findings_of(tight, {"boxes=sphere"}).excess(), 1.2);
}

TEST_F(ProbeAtrium, OtherWalksAndListsThatOverflow) {
  show(frame());
  ShadingPath path = ShadingPath::deferred;
  for (const auto& [name, settings] : {std::pair<const char*, std::vector<std::string>>{"tiled", {"walk=scalar-cell"}},
                                       {"tiled", {"order=append", "walk=scalar-cell"}},
                                       {"tiled", {"order=type", "mean_capacity=1"}},
                                       {"tiled-bits", {"walk=scalar-entity"}},
                                       {"clustered", {"mean_capacity=1"}}}) {
    SCOPED_TRACE(fmt::format("{} {}", name, fmt::join(settings, " ")));
    check(*take(find_method(name)), path, settings);
    path = path == ShadingPath::deferred ? ShadingPath::forward : ShadingPath::deferred;
  }
}

/// A lighting that is ready for probes, and a frame without: the bits of one that is not.
TEST_F(ProbeAtrium, NoneLeaveThePictureAsItIs) {
  Reflecting shown = frame();
  show(shown);
  const Method& method = *take(find_method("clustered"));
  Lighting with = lighting(method, ShadingPath::deferred);
  const HdrImage reflecting = renderer_->render(with).image;
  shown.probes.clear();
  show(shown);
  Lighting without = lighting(method, ShadingPath::deferred);
  const HdrImage bare = renderer_->render(without).image;
  EXPECT_GT(max_abs_difference(reflecting, bare), 0.01F);
  EXPECT_EQ(max_abs_difference(renderer_->render(with).image, bare), 0.0F);
}

/// 60 in one place, around the eye; one around everything; tiny ones; together with lights and decals.
TEST_F(ProbeAtrium, OddOnes) {
  Reflecting shown = frame();
  const glm::vec3 eye = glm::vec3(glm::dmat4(shown.view.world_from_view())[3]);
  shown.probes.clear();
  for (int i = 0; i < 60; ++i)
    shown.probes.push_back({.shape = i % 2 == 0 ? ProbeShape::box : ProbeShape::ellipsoid,
                            .center = eye,
                            .half_extents = glm::vec3(6.0F),
                            .blend_m = 5.0F,
                            .parallax_center = eye,
                            .capture = eye});
  shown.probes.push_back({.half_extents = glm::vec3(1e6F)});
  shown.probes.push_back({.center = eye, .half_extents = glm::vec3(1e-5F)});
  show(shown);
  for (const char* name : {"tight", "tiled-append", "drobot-zbin"}) {
    const Result<const Method*> found = find_method(name);
    if (!found) continue;
    SCOPED_TRACE(name);
    check(*found.value(), ShadingPath::deferred);
  }
}

/// The check can fail: probes that the cells were not told of are missed.
TEST_F(ProbeAtrium, OnesThatWereNotCulledAreMissed) {
  Reflecting shown = frame();
  show(shown);
  const std::vector<gpu::ProbeData> there = packed_;
  for (Probe& probe : shown.probes) probe.center.y += 400.0F;
  show(shown);
  packed_ = there;
  Lighting lit = lighting(*take(find_method("tight")), ShadingPath::deferred);
  (void)renderer_->render(lit);
  const Truth truth = truth_of_probes(renderer_->read_depth());
  ASSERT_GT(truth.lights.size(), 100U);
  Verification verification(WIDTH);
  verification.add(truth, renderer_->visit(lit, truth, vulkan::PlanRunner::Passes::separate, Renderer::Kind::probes));
  EXPECT_EQ(verification.findings().missed, truth.lights.size());
}

// As the inspector shows it.
TEST_F(ProbeAtrium, TermsOfAPixelAddUpToItsRadiance) {
  Renderer& renderer = show(frame());
  const LightingInfo info{.method = &brute_force(),
                          .width = WIDTH,
                          .height = HEIGHT,
                          .light_capacity = renderer.data().entities().boxes.end,
                          .decals = true,
                          .probes = renderer.probes().kind()};
  Lighting lit(renderer.device(), shader_library(), info);
  const HdrImage picture = renderer.render(lit).image;
  const std::vector<float> depth = renderer.read_depth();
  std::uint32_t checked = 0;
  for (std::uint32_t pixel = 7; pixel < WIDTH * HEIGHT; pixel += 197) {
    if (depth[pixel] == 0.0F) continue;
    const std::vector<std::uint32_t> lights = lights_at(renderer, lit, pixel);
    const std::vector<std::uint32_t> probes = probes_at(renderer, lit, pixel);
    const PixelTerms terms =
        terms_at(renderer, shader_library(), scene_.gpu, info, pixel, {.lights = lights, .probes = probes});
    glm::vec3 sum = terms.surroundings;
    for (const glm::vec3& term : terms.lights) sum += term;
    const glm::vec3 shown(picture.pixels[pixel]);
    EXPECT_LT(glm::length(sum - shown), 1e-4F * (1.0F + glm::length(shown))) << pixel;
    const PixelTerms bare = terms_at(renderer, shader_library(), scene_.gpu, info, pixel, {.lights = lights});
    checked += glm::length(bare.surroundings - terms.surroundings) > 1e-3F ? 1 : 0;
  }
  EXPECT_GT(checked, 3U) << "probes are seen";
}

}  // namespace
}  // namespace lamp::app
