// Weights, blending and parallax of reflection probes against double precision.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "gpu/dispatch.h"
#include "gpu/shaders/probe_case.h"
#include "render/place_probes.h"

namespace lamp::app {
namespace {

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

class RandomProbes {
 public:
  explicit RandomProbes(std::uint32_t seed) : engine_(seed) {}
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

std::vector<Probe> random_probes(RandomProbes& random, std::uint32_t count) {
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
  RandomProbes random(7);
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
    RandomProbes random(11);
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

}  // namespace
}  // namespace lamp::app
