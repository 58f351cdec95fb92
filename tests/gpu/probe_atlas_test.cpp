// Captures of probes against double precision: constant surroundings, filtered ones, the folds of the square,
// distances, and the split sum.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "gpu/dispatch.h"
#include "gpu/shaders/probe_question.h"
#include "render/probe_atlas.h"
#include "render/probe_capture.h"

namespace lamp::app {
namespace {

using shared::ProbeAnswer;
using shared::ProbeQuestion;
/// Radiance and distance (m) of a direction.
using Surroundings = std::function<glm::dvec4(const glm::dvec3&)>;

constexpr std::uint32_t SLOT = 2;

glm::dvec3 any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

std::vector<glm::dvec3> directions(int count) {
  std::mt19937 random(7);
  std::vector<glm::dvec3> all(count);
  std::ranges::generate(all, [&] { return any_direction(random); });
  return all;
}

class ProbeAtlasTest : public GpuTest {
 protected:
  ProbeAtlasTest() : atlas_(test_context(), shader_library(), 3) {}

  void fill(const Surroundings& surroundings) {
    std::vector<glm::vec4> faces;
    for (const View& view : probe_views({0.0F, 0.0F, 0.0F}))
      for (std::uint32_t y = 0; y < gpu::PROBE_SIDE; ++y)
        for (std::uint32_t x = 0; x < gpu::PROBE_SIDE; ++x) {
          const glm::dvec3 point = view.view_position({x + 0.5, y + 0.5}, 1.0);
          const glm::dvec3 direction = glm::dmat3(glm::dmat4(view.world_from_view())) * glm::normalize(point);
          glm::dvec4 seen = surroundings(direction);
          seen.w = 1.0 / seen.w;
          faces.emplace_back(seen);
        }
    const vulkan::Buffer staging = host_buffer_of("faces", faces);
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::AccessTracker tracker;
      tracker.assume(atlas_.image().sampled());
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      const vulkan::Resource to = vulkan::Resource::storage(atlas_.faces().handle());
      recorder.barrier({copies_from(vulkan::Resource::storage(staging.handle())), copies_to(to)});
      const VkBufferCopy all{.size = staging.bytes()};
      vkCmdCopyBuffer(commands, staging.handle(), atlas_.faces().handle(), 1, &all);
      atlas_.record(recorder, SLOT);
    });
  }

  std::vector<ProbeAnswer> ask(const std::vector<ProbeQuestion>& questions) {
    const vulkan::Buffer in = host_buffer_of("questions", questions);
    const vulkan::Buffer out = host_buffer("answers", questions.size() * sizeof(ProbeAnswer));
    const vulkan::Device& device = test_context().device();
    vulkan::PipelineInfo info{.name = "probe look-up", .bindings = {{0}, {1}}};
    add_probe_atlas(info);
    const vulkan::Pipeline pipeline = take(vulkan::Pipeline::compute(device, info, test_shader("probe_lookup")));
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::AccessTracker tracker;
      tracker.assume(atlas_.image().sampled());
      vulkan::Recorder recorder(device, commands, tracker);
      const vulkan::Resource answers = vulkan::Resource::storage(out.handle());
      recorder.begin_pass("ask", {{.resource = answers, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
      recorder.bind(pipeline, std::vector<vulkan::Bound>{
                                  {0, vulkan::Resource::storage(in.handle())}, {1, answers}, atlas_.bound().front()});
      vkCmdDispatch(commands, static_cast<std::uint32_t>(questions.size() + 63) / 64, 1, 1);
      recorder.end_pass();
      recorder.barrier({host_reads(answers)});
    });
    return contents<ProbeAnswer>(out);
  }

  std::vector<ProbeAnswer> ask(const std::vector<glm::dvec3>& toward, float roughness) {
    std::vector<ProbeQuestion> questions;
    for (const glm::dvec3& d : toward)
      questions.push_back({.direction = glm::vec3(d), .roughness = roughness, .n_dot_v = 1.0F, .slot = SLOT});
    return ask(questions);
  }

  ProbeAtlas atlas_;
};

TEST_F(ProbeAtlasTest, ConstantSurroundingsStayConstantAtAllRoughnesses) {
  const glm::dvec3 radiance(0.3, 7.0, 1000.0);
  fill([&](const glm::dvec3&) { return glm::dvec4(radiance, 5.0); });
  const std::vector<glm::dvec3> toward = directions(500);
  for (const float roughness : {0.0F, 0.045F, 0.1F, 0.15F, 0.28F, 0.5F, 0.77F, 1.0F})
    for (const ProbeAnswer& answer : ask(toward, roughness))
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(glm::vec3(answer.radiance)[c] / radiance[c], 1.0, 1e-3) << roughness;
  EXPECT_EQ(atlas_.clipped(), 0U);
}

TEST_F(ProbeAtlasTest, AnEmptySlotIsBlackAndInfinitelyFar) {
  for (const ProbeAnswer& answer : ask(directions(20), 0.5F)) {
    EXPECT_EQ(glm::vec3(answer.radiance), glm::vec3(0.0F));
    EXPECT_EQ(answer.distance_m, gpu::PROBE_SKY_M);
  }
}

TEST_F(ProbeAtlasTest, WhatIsTooBrightIsStoredAsTheBrightestAndCounted) {
  fill([](const glm::dvec3& d) { return d.x > 0.9 ? glm::dvec4(1e6, 1.0, 1.0, 2.0) : glm::dvec4(1.0, 1.0, 1.0, 2.0); });
  const std::vector<ProbeAnswer> answers = ask({glm::dvec3(1.0, 0.0, 0.0)}, 0.0F);
  EXPECT_EQ(glm::vec3(answers.front().radiance).x, gpu::PROBE_BRIGHTEST);
  EXPECT_GT(atlas_.clipped(), 100U);
}

/// A sky, a floor, a window and a lamp of a few degrees.
glm::dvec4 room(const glm::dvec3& d) {
  glm::dvec3 radiance = d.y > 0.0 ? glm::dvec3(0.4, 0.5, 0.7 + d.x * 0.2) : glm::dvec3(0.1, 0.08, 0.05);
  if (std::abs(d.x - 0.5) < 0.2 && std::abs(d.y - 0.1) < 0.3 && d.z < 0.0) radiance += glm::dvec3(8.0, 7.0, 6.0);
  if (glm::dot(d, glm::normalize(glm::dvec3(-1.0, 0.3, 0.4))) > std::cos(0.06)) radiance += 100.0;
  return {radiance, 3.0};
}

/// The sum that the shader makes, in double precision.
glm::dvec3 filtered(const std::vector<gpu::ProbeSource>& sources, const glm::dvec3& normal, double roughness) {
  const double a2 = std::pow(roughness, 4.0);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (const gpu::ProbeSource& source : sources) {
    const glm::dvec3 to = glm::normalize(glm::dvec3(glm::vec3(source.direction)));
    const double n_l = glm::dot(normal, to);
    if (n_l <= 0.0) continue;
    const double n_h = glm::dot(normal, glm::normalize(normal + to));
    const double d = n_h * n_h * (a2 - 1.0) + 1.0;
    const double weight = source.weight * n_l / (d * d);
    sum += weight * glm::dvec3(glm::vec3(source.radiance));
    weights += weight;
  }
  return sum / weights;
}

glm::dvec3 point_of(const glm::dvec2& place) {
  glm::dvec3 p(place, 1.0 - std::abs(place.x) - std::abs(place.y));
  if (p.z < 0.0) {
    const glm::dvec2 folded(1.0 - std::abs(place.y), 1.0 - std::abs(place.x));
    p.x = place.x >= 0.0 ? folded.x : -folded.x;
    p.y = place.y >= 0.0 ? folded.y : -folded.y;
  }
  return glm::normalize(p);
}

TEST_F(ProbeAtlasTest, LevelsEqualASumInDoublePrecision) {
  fill(room);
  const vulkan::Buffer copy = host_buffer("sources", atlas_.sources().bytes());
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    recorder.order(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_COPY_BIT);
    const VkBufferCopy all{.size = copy.bytes()};
    vkCmdCopyBuffer(commands, atlas_.sources().handle(), copy.handle(), 1, &all);
    recorder.order(VK_PIPELINE_STAGE_2_COPY_BIT, VK_PIPELINE_STAGE_2_HOST_BIT);
  });
  const std::vector<gpu::ProbeSource> sources = contents<gpu::ProbeSource>(copy);
  double solid_angle = 0.0;
  for (const gpu::ProbeSource& source : sources) solid_angle += source.weight * std::pow(4.0 / 512.0 / 2.0, 2.0);
  EXPECT_NEAR(solid_angle, 4.0 * std::numbers::pi, 1e-3);
  for (std::uint32_t level = 1; level < gpu::PROBE_LEVELS; ++level) {
    const HdrImage image = atlas_.read_level(test_context(), SLOT, level);
    const double roughness = double{gpu::PROBE_SHARP} + double{gpu::PROBE_STEP} * level;
    for (std::uint32_t i = 0; i < image.pixels.size(); i += 7) {
      const glm::dvec2 place = (glm::dvec2(i % image.width, i / image.width) + 0.5) * (2.0 / image.width) - 1.0;
      const glm::dvec3 expected = filtered(sources, point_of(place), roughness);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.pixels[i][c] / expected[c], 1.0, 1e-3) << level << ", " << i;
    }
  }
}

/// GGX's directions as seen along the normal, on a grid, weighted by the cosine: no texels anywhere.
glm::dvec3 integrated(const Surroundings& surroundings, const glm::dvec3& normal, double roughness) {
  constexpr int STEPS = 96;
  const double a2 = std::pow(roughness, 4.0);
  const glm::dvec3 side = glm::normalize(glm::cross(normal, glm::dvec3(0.31, 0.83, -0.46)));
  const glm::dvec3 other = glm::cross(normal, side);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int i = 0; i < STEPS; ++i)
    for (int k = 0; k < STEPS; ++k) {
      const double u = (i + 0.5) / STEPS;
      const double turn = 2.0 * std::numbers::pi * (k + 0.5) / STEPS;
      const double cosine = std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u));
      const double sine = std::sqrt(1.0 - cosine * cosine);
      const glm::dvec3 half = cosine * normal + sine * (std::cos(turn) * side + std::sin(turn) * other);
      const glm::dvec3 to = 2.0 * cosine * half - normal;
      const double n_l = glm::dot(normal, to);
      if (n_l <= 0.0) continue;
      sum += n_l * glm::dvec3(surroundings(to));
      weights += n_l;
    }
  return sum / weights;
}

/// Texels, levels and what lies between them: all that the look-up is not exact in.
TEST_F(ProbeAtlasTest, LookUpIsCloseToTheIntegral) {
  const auto smooth = [](const glm::dvec3& d) {
    return glm::dvec4(1.0 + 0.5 * d.x, 2.0 + d.y * d.z, 1.5 + std::sin(3.0 * d.z + d.x), 4.0);
  };
  fill(smooth);
  const std::vector<glm::dvec3> toward = directions(150);
  for (const float roughness : {0.1F, 0.28F, 0.4F, 0.55F, 0.8F, 1.0F}) {
    const std::vector<ProbeAnswer> answers = ask(toward, roughness);
    for (std::size_t i = 0; i < toward.size(); ++i) {
      const glm::dvec3 expected = integrated(smooth, toward[i], roughness);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(glm::vec3(answers[i].radiance)[c] / expected[c], 1.0, 0.04) << roughness << ", " << i;
    }
  }
}

/// Across the square's edges (below z = 0, where x or y is 0), its diagonals (z = 0) and the edges of the cube.
TEST_F(ProbeAtlasTest, RadianceHasNoSeam) {
  fill([](const glm::dvec3& d) {
    return glm::dvec4(2.0 + d.x, 2.0 + d.y * d.z, 2.0 + std::sin(4.0 * d.z), 1.0 / (1.0 + 0.5 * d.x));
  });
  std::vector<glm::dvec3> toward;
  for (glm::dvec3 d : directions(2000)) {
    const int kind = static_cast<int>(toward.size() / 2) % 4;
    if (kind < 3) d[kind] = 0.0;
    if (kind == 3) d.x = d.y;  // an edge of the cube, for many
    if (kind < 2) d.z = -std::abs(d.z);
    d = glm::normalize(d);
    glm::dvec3 step(0.0);
    step[kind == 3 ? 0 : kind] = 1e-4;
    toward.push_back(glm::normalize(d - step));
    toward.push_back(glm::normalize(d + step));
  }
  for (const float roughness : {0.0F, 0.2F, 0.46F, 0.9F}) {
    const std::vector<ProbeAnswer> answers = ask(toward, roughness);
    for (std::size_t i = 0; i < answers.size(); i += 2)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(glm::vec3(answers[i].radiance)[c], glm::vec3(answers[i + 1].radiance)[c], 6e-3)
            << roughness << ", " << toward[i].x << ' ' << toward[i].y << ' ' << toward[i].z;
  }
}

TEST_F(ProbeAtlasTest, DistancesToTheWallsOfARoomAreRightWithinFivePercent) {
  const glm::dvec3 half(4.0, 1.5, 9.0);
  const auto distance = [&](const glm::dvec3& d) {
    const glm::dvec3 along = half / glm::max(glm::abs(d), glm::dvec3(1e-9));
    return std::min({along.x, along.y, along.z});
  };
  fill([&](const glm::dvec3& d) { return glm::dvec4(1.0, 1.0, 1.0, distance(d)); });
  const std::vector<glm::dvec3> toward = directions(2000);
  const std::vector<ProbeAnswer> answers = ask(toward, 0.0F);
  double worst = 0.0;
  for (std::size_t i = 0; i < toward.size(); ++i)
    worst = std::max(worst, std::abs(answers[i].distance_m / distance(toward[i]) - 1.0));
  EXPECT_LT(worst, 0.05);
  RecordProperty("worst_distance_error", std::to_string(worst));
}

/// F0 times the first and the second: GGX with height-correlated masking, Schlick's Fresnel.
glm::dvec2 split_integral(double n_v, double roughness) {
  constexpr int STEPS = 400;
  const double a2 = std::pow(roughness, 4.0);
  const glm::dvec3 eye(std::sqrt(1.0 - n_v * n_v), 0.0, n_v);
  glm::dvec2 sum(0.0);
  for (int i = 0; i < STEPS; ++i)
    for (int k = 0; k < STEPS; ++k) {
      const double u = (i + 0.5) / STEPS;
      const double turn = 2.0 * std::numbers::pi * (k + 0.5) / STEPS;
      const double n_h = std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u));
      const double sine = std::sqrt(1.0 - n_h * n_h);
      const glm::dvec3 half(sine * std::cos(turn), sine * std::sin(turn), n_h);
      const double v_h = glm::dot(eye, half);
      const double n_l = 2.0 * v_h * n_h - n_v;
      if (n_l <= 0.0 || v_h <= 0.0) continue;
      const double masked =
          2.0 * n_l / (n_l * std::sqrt(a2 + (1.0 - a2) * n_v * n_v) + n_v * std::sqrt(a2 + (1.0 - a2) * n_l * n_l));
      const double visible = masked * v_h / n_h;
      const double grazing = std::pow(1.0 - v_h, 5.0);
      sum += visible * glm::dvec2(1.0 - grazing, grazing);
    }
  return sum / double{STEPS * STEPS};
}

/// A fit, and the one of ambient light, so that both agree. It is off most for rough surfaces at grazing angles.
TEST_F(ProbeAtlasTest, SplitSumIsCloseToTheIntegral) {
  std::vector<ProbeQuestion> questions;
  for (const float roughness : {0.1F, 0.3F, 0.5F, 0.7F, 0.85F, 1.0F})
    for (const float n_v : {0.05F, 0.2F, 0.4F, 0.6F, 0.8F, 1.0F})
      questions.push_back({.direction = {0.0F, 0.0F, 1.0F}, .roughness = roughness, .n_dot_v = n_v, .slot = SLOT});
  const std::vector<ProbeAnswer> answers = ask(questions);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const ProbeQuestion& q = questions[i];
    const glm::dvec2 expected = split_integral(q.n_dot_v, q.roughness);
    const glm::dvec2 found(glm::vec2(answers[i].split));
    const double allowed = q.roughness > 0.8F ? 0.28 : q.n_dot_v < 0.1F ? 0.15 : 0.06;
    for (const double f0 : {0.04, 0.5, 1.0})
      EXPECT_NEAR(f0 * found.x + found.y, f0 * expected.x + expected.y, allowed) << q.roughness << ", " << q.n_dot_v;
  }
}

}  // namespace
}  // namespace lamp::app
