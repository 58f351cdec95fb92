// Reflection probes: weights, blending and parallax against double precision; looked up through every method without a
// miss, shaded alike by all of them on every path; odd cases.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "gpu/dispatch.h"
#include "gpu/method_check.h"
#include "gpu/shaders/probe_case.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "gpu/test_surfaces.h"
#include "render/box_shapes.h"
#include "render/decal_pass.h"
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

using Place = glm::dvec3;

Place local_of(const shared::OrientedBox& box, const Place& position) {
  const Place from = position - Place(box.center);
  return {glm::dot(Place(box.axis_x), from), glm::dot(Place(box.axis_y), from), glm::dot(Place(box.axis_z), from)};
}

double weight_of(const gpu::ProbeData& p, const Place& position) {
  const Place half(p.volume.half_extents);
  const Place local = local_of(p.volume, position);
  const Place rest = half - glm::abs(local);
  double inside = std::min({rest.x, rest.y, rest.z});
  if (p.ellipsoid != 0) inside = (1.0 - glm::length(local / half)) * std::min({half.x, half.y, half.z});
  if (inside <= 0.0) return 0.0;
  return p.blend > 0.0F ? std::min(inside / p.blend, 1.0) : 1.0;
}

struct Blend {
  Place sum{0.0};
  double weight = 0.0;
};

/// Smallest first, until the weights sum to 1.
Blend blend_of(const std::vector<gpu::ProbeData>& probes, const Place& position) {
  Blend blend;
  for (const gpu::ProbeData& p : probes) {
    const double weight = std::min(weight_of(p, position), 1.0 - blend.weight);
    blend.sum += weight * Place(glm::vec3(p.flat_radiance));
    blend.weight += weight;
  }
  return blend;
}

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float between(float low, float high) { return std::uniform_real_distribution(low, high)(engine_); }
  glm::vec3 vector(float half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Probe probe(std::uint32_t i) {
    const glm::vec3 center = vector(3.0F);
    const glm::vec3 half = vector(1.0F) + 2.0F;
    return {.shape = i % 2 == 0 ? ProbeShape::box : ProbeShape::ellipsoid,
            .center = center,
            .orientation = glm::normalize(glm::quat(between(0.2F, 1), between(-1, 1), between(-1, 1), between(-1, 1))),
            .half_extents = half,
            .blend_m = i % 5 == 0 ? 0.0F : between(0.2F, 1.0F),
            .parallax_center = center + vector(0.3F),
            .parallax_half_extents = half + 0.5F,
            .capture = center + vector(0.2F)};
  }

 private:
  std::mt19937 engine_;
};

std::vector<Probe> random_probes(Random& random, std::uint32_t count) {
  std::vector<Probe> probes;
  for (std::uint32_t i = 0; i < count; ++i) probes.push_back(random.probe(i));
  return probes;
}

class ProbeBlending : public GpuTest {
 protected:
  static std::vector<shared::ProbeBlendAnswer> ask(const std::vector<gpu::ProbeData>& probes,
                                                   const std::vector<shared::ProbeCase>& cases) {
    const vulkan::Buffer buffers[] = {host_buffer_of("probes", probes), host_buffer_of("cases", cases),
                                      host_buffer("answers", cases.size() * sizeof(shared::ProbeBlendAnswer))};
    Dispatch what{.shader = "probe_blend", .groups = {static_cast<std::uint32_t>(cases.size() + 63) / 64, 1, 1}};
    for (const vulkan::Buffer& buffer : buffers) what.resources.push_back(vulkan::Resource::storage(buffer.handle()));
    dispatch(what);
    return contents<shared::ProbeBlendAnswer>(buffers[2]);
  }
};

/// Positions where a weight jumps within the rounding of a position are passed over.
bool on_edge(const std::vector<gpu::ProbeData>& probes, const Place& position) {
  return std::ranges::any_of(probes, [&](gpu::ProbeData p) {
    if (p.blend > 0.0F) return false;
    p.blend = 1e-4F;  // m
    const double weight = weight_of(p, position);
    return weight > 0.0 ? weight < 1.0 : false;
  });
}

TEST_F(ProbeBlending, IsWhatDoublePrecisionSays) {
  Random random(7);
  const std::vector<gpu::ProbeData> probes = pack(random_probes(random, 12));
  std::vector<shared::ProbeCase> cases;
  for (int i = 0; i < 20000; ++i)
    cases.push_back({.position = random.vector(5.0F), .direction = glm::normalize(random.vector(1.0F) + 1e-3F)});
  const std::vector<shared::ProbeBlendAnswer> answers = ask(probes, cases);
  std::size_t partly = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Place position(glm::vec3(cases[i].position));
    if (on_edge(probes, position)) continue;
    const Blend blend = blend_of(probes, position);
    // A place's rounding, 5e-7 m, over the shortest blend distance, for each of the probes there.
    ASSERT_NEAR(answers[i].weight, blend.weight, 2e-5) << i;
    ASSERT_LE(answers[i].weight, 1.0F);
    ASSERT_LT(glm::length(Place(glm::vec3(answers[i].sum)) - blend.sum), 3e-5) << i;
    partly += blend.weight > 0.0 && blend.weight < 1.0 ? 1 : 0;
  }
  EXPECT_GT(partly, 1000U);
}

/// With weights that are exact in 32 bits, so is their sum.
TEST_F(ProbeBlending, SumsWeightsToOne) {
  std::vector<Probe> probes;
  for (int i = 1; i < 30; ++i)
    probes.push_back({.half_extents = glm::vec3(static_cast<float>(i)), .blend_m = static_cast<float>(8 * i)});
  const std::vector<gpu::ProbeData> packed = pack(probes);
  std::vector<shared::ProbeCase> cases;
  for (int i = 0; i < 256; ++i)
    cases.push_back({.position = {static_cast<float>(i) / 16.0F, 0.25F, 0.125F}, .direction = {0, 0, 1}});
  const std::vector<shared::ProbeBlendAnswer> answers = ask(packed, cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Blend blend = blend_of(packed, Place(glm::vec3(cases[i].position)));
    EXPECT_NEAR(answers[i].weight, blend.weight, 1e-6) << i;
    const Place off = glm::abs(Place(glm::vec3(answers[i].sum)) - blend.sum);
    EXPECT_LE(std::max({off.x, off.y, off.z}), 1e-6 * std::max(1.0, glm::length(blend.sum))) << i;
  }
}

TEST_F(ProbeBlending, ReflectionsMeetTheWalls) {
  for (const ProbeShape shape : {ProbeShape::box, ProbeShape::ellipsoid}) {
    Random random(11);
    Probe probe = random.probe(0);
    probe.shape = shape;
    const std::vector<gpu::ProbeData> packed = pack({probe});
    const Place half(glm::vec3(packed[0].parallax_half_extents));
    shared::OrientedBox walls = packed[0].volume;
    walls.center = packed[0].parallax_center;
    std::vector<shared::ProbeCase> cases;
    for (int i = 0; i < 5000; ++i)
      cases.push_back({.position = glm::vec3(walls.center) + random.vector(3.0F),
                       .direction = glm::normalize(random.vector(1.0F) + glm::vec3(1e-3F, 0, 0))});
    cases.push_back({.position = walls.center, .direction = walls.axis_y});  // along an axis
    const std::vector<shared::ProbeBlendAnswer> answers = ask(packed, cases);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Place position(glm::vec3(cases[i].position));
      const Place given(glm::vec3(cases[i].direction));
      const Place found(glm::vec3(answers[i].direction));
      const Place local = local_of(walls, position) / half;
      const double out = shape == ProbeShape::box ? std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)})
                                                  : glm::length(local);
      if (std::abs(out - 1.0) < 1e-4) continue;
      if (out > 1.0) {
        ASSERT_LT(glm::length(found - given), 1e-6) << i;
        continue;
      }
      ++inside;
      // The wall is where the way from the surface meets the volume's surface: found by halving.
      double low = 0.0;
      double high = 100.0;
      for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        const Place at = local_of(walls, position + middle * given) / half;
        const bool is_in = shape == ProbeShape::box ? std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < 1.0
                                                    : glm::length(at) < 1.0;
        (is_in ? low : high) = middle;
      }
      const Place seen = glm::normalize(position + low * given - Place(glm::vec3(packed[0].capture)));
      ASSERT_LT(glm::length(found - seen), 1e-4) << i;
    }
    EXPECT_GT(inside, 500U);
  }
}

TEST_F(ProbeBlending, EndsBehindWalls) {
  const std::vector<gpu::ProbeData> probes = pack({Probe{}});
  std::vector<shared::ProbeCase> cases;
  for (const auto& [distance, nearest] :
       {std::pair(5.0F, 5.0F), {5.0F, 1e6F}, {5.2F, 5.0F}, {5.72F, 5.0F}, {9.0F, 5.0F}})
    cases.push_back({.direction = {0, 0, 1}, .distance_m = distance, .nearest_m = nearest});
  const std::vector<shared::ProbeBlendAnswer> answers = ask(probes, cases);
  const float expected[] = {1.0F, 1.0F, 1.0F, 0.5F, 0.0F};
  for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_NEAR(answers[i].seen, expected[i], 1e-5F) << i;
}

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

}  // namespace
}  // namespace lamp::app
