// Reflection in 32 bits against double precision, for every roughness and angle; and the light of surroundings against
// the sum of lights all around.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "gpu/dispatch.h"
#include "gpu/shaders/reflect_case.h"
#include "gpu/test_surfaces.h"

namespace lamp::app {
namespace {

constexpr float ROUGHNESSES[] = {0.045F, 0.06F, 0.1F, 0.2F, 0.35F, 0.5F, 0.7F, 0.85F, 1.0F};

class Reflections : public GpuTest {
 protected:
  static std::vector<shared::ReflectAnswer> ask(const std::vector<shared::ReflectCase>& cases, Brdf brdf) {
    const vulkan::Buffer in = host_buffer_of("cases", cases);
    const vulkan::Buffer out = host_buffer("answers", cases.size() * sizeof(shared::ReflectAnswer));
    std::vector<std::uint32_t> constants(11);
    constants[10] = static_cast<std::uint32_t>(brdf);
    dispatch({.shader = "reflect",
              .constants = constants,
              .resources = {vulkan::Resource::storage(in.handle()), vulkan::Resource::storage(out.handle())},
              .groups = {static_cast<std::uint32_t>(cases.size() + 63) / 64, 1, 1}});
    return contents<shared::ReflectAnswer>(out);
  }
};

/// Unit in 32 bits as far as they go.
glm::vec3 unit(const glm::dvec3& v) { return glm::vec3(glm::normalize(v)); }

glm::dvec3 any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// A surface turned anyhow, the eye `eye_angle` from its normal, and a light that puts the half vector `half_angle`
/// from it, anywhere around.
shared::ReflectCase turned_case(std::mt19937& random, double eye_angle, double half_angle) {
  const glm::dvec3 normal = any_direction(random);
  const glm::dvec3 side = glm::normalize(glm::cross(normal, any_direction(random)));
  const glm::dvec3 other = glm::cross(normal, side);
  const double turn = std::uniform_real_distribution(0.0, 2.0 * std::numbers::pi)(random);
  const glm::dvec3 eye = std::cos(eye_angle) * normal + std::sin(eye_angle) * side;
  const glm::dvec3 half =
      std::cos(half_angle) * normal + std::sin(half_angle) * (std::cos(turn) * side + std::sin(turn) * other);
  return {.normal = unit(normal), .to_eye = unit(eye), .to_light = unit(2.0 * glm::dot(eye, half) * half - eye)};
}

/// Whether both are above the surface by more than rounding can hide.
bool is_ordinary(const shared::ReflectCase& c) {
  const glm::vec3 normal = c.normal;
  return glm::dot(normal, glm::vec3(c.to_light)) > 0.02F && glm::dot(normal, glm::vec3(c.to_eye)) > 0.02F;
}

/// Half vectors from the middle of the highlight to far outside of it: the highlight is as wide as alpha.
std::vector<shared::ReflectCase> all_cases() {
  std::mt19937 random(1);
  std::vector<shared::ReflectCase> cases;
  for (const float roughness : ROUGHNESSES)
    for (const float metallic : {0.0F, 1.0F})
      for (const double eye_angle : {0.0, 0.3, 0.8, 1.2, 1.5})
        for (const double widths : {0.0, 0.1, 0.3, 0.6, 1.0, 1.5, 2.5, 5.0, 20.0, 200.0})
          for (int i = 0; i < 8; ++i) {
            const double half_angle = std::atan(widths * roughness * roughness);
            shared::ReflectCase made = turned_case(random, eye_angle, half_angle);
            made.base_color = {0.9F, 0.5F, 0.1F};
            made.metallic = metallic;
            made.roughness = roughness;
            if (is_ordinary(made)) cases.push_back(made);
          }
  return cases;
}

Reflection exact(const shared::ReflectCase& c) {
  return {.normal = glm::normalize(glm::dvec3(c.normal)),
          .to_eye = glm::normalize(glm::dvec3(c.to_eye)),
          .to_light = glm::normalize(glm::dvec3(c.to_light)),
          .base_color = glm::dvec3(c.base_color),
          .metallic = c.metallic,
          .roughness = c.roughness};
}

std::string describe(const shared::ReflectCase& c) {
  const Reflection r = exact(c);
  return fmt::format("roughness {}, metallic {}, n.v {}, n.l {}, angle of the half vector {}", c.roughness, c.metallic,
                     glm::dot(r.normal, r.to_eye), glm::dot(r.normal, r.to_light),
                     glm::length(glm::cross(r.normal, glm::normalize(r.to_eye + r.to_light))));
}

// Far outside of a highlight, Blinn-Phong is less than 32 bits can say.
constexpr double TOO_SMALL = 1e-30;

/// `most`: the largest relative error of a channel.
template <class Exact>
void expect_close(const std::vector<shared::ReflectCase>& cases, const std::vector<shared::ReflectAnswer>& answers,
                  double most, const Exact& exact_of) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const glm::dvec3 expected = exact_of(cases[i]);
    const glm::dvec3 of_light(answers[i].of_light);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(of_light[c], expected[c], most * expected[c] + TOO_SMALL) << describe(cases[i]);
  }
}

// Rounded unit vectors alone make the smallest highlight uncertain by 1e-7 / alpha, twice (5e-5, squared in D).
TEST_F(Reflections, GgxIsRightForEveryRoughnessAndAngle) {
  const std::vector<shared::ReflectCase> cases = all_cases();
  EXPECT_GT(cases.size(), 5000U);
  expect_close(cases, ask(cases, Brdf::ggx), 1e-3, [](const auto& c) { return reflected(exact(c)); });
}

TEST_F(Reflections, BlinnPhongIsRightForEveryRoughnessAndAngle) {
  const std::vector<shared::ReflectCase> cases = all_cases();
  expect_close(cases, ask(cases, Brdf::blinn_phong), 1e-3, [](const auto& c) {
    const Reflection r = exact(c);
    const double shininess = std::max(2.0 / std::pow(r.roughness, 4.0) - 2.0, 1.0);
    const glm::dvec3 sum = r.to_eye + r.to_light;
    const double sine2 = std::pow(glm::length(glm::cross(r.normal, glm::normalize(sum))), 2.0);
    const double lobe = (shininess + 8.0) / (8.0 * std::numbers::pi) * std::exp(0.5 * shininess * std::log1p(-sine2));
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), r.base_color, r.metallic);
    const double g = std::pow(1.0 - 0.5 * glm::length(sum), 5.0);
    const glm::dvec3 diffuse = (1.0 - f0) * (1.0 - r.metallic) * r.base_color / std::numbers::pi;
    return ((1.0 - g) * (diffuse + lobe * f0) + g * lobe) * glm::dot(r.normal, r.to_light);
  });
}

/// What a surface reflects of a radiance of 1 / pi from everywhere, so that the irradiance is 1: directions are drawn
/// as GGX has them, on a grid, and diffuse light by the cosine.
glm::dvec3 integrated(const shared::ReflectCase& c) {
  constexpr int STEPS = 192;
  const double alpha2 = std::pow(c.roughness, 4.0);
  Reflection r = exact(c);
  const double n_v = std::min(glm::dot(r.normal, r.to_eye), 1.0);
  r.normal = {0.0, 0.0, 1.0};
  r.to_eye = {std::sqrt(1.0 - n_v * n_v), 0.0, n_v};
  Reflection black = r;  // its diffuse part is the difference
  glm::dvec3 sum(0.0);
  for (int i = 0; i < STEPS; ++i)
    for (int k = 0; k < STEPS; ++k) {
      const double u = (i + 0.5) / STEPS;
      const double turn = 2.0 * std::numbers::pi * (k + 0.5) / STEPS;
      const auto direction = [&](double cosine) {
        const double sine = std::sqrt(1.0 - cosine * cosine);
        return glm::dvec3(sine * std::cos(turn), sine * std::sin(turn), cosine);
      };
      const glm::dvec3 half = direction(std::sqrt((1.0 - u) / (1.0 + (alpha2 - 1.0) * u)));
      black.to_light = 2.0 * glm::dot(r.to_eye, half) * half - r.to_eye;
      black.metallic = 1.0;  // no diffuse light
      black.base_color = glm::mix(glm::dvec3(0.04), r.base_color, r.metallic);
      if (black.to_light.z > 0.0 && glm::dot(r.to_eye, half) > 0.0) {
        const double d = alpha2 / (std::numbers::pi * std::pow(half.z * half.z * (alpha2 - 1.0) + 1.0, 2.0));
        sum += reflected(black) * 4.0 * glm::dot(r.to_eye, half) / (d * half.z) / std::numbers::pi;
      }
      const glm::dvec3 light = direction(std::sqrt(1.0 - u));
      const double g = std::pow(1.0 - 0.5 * glm::length(r.to_eye + light), 5.0);
      const glm::dvec3 f0 = black.base_color;
      sum += (1.0 - f0) * (1.0 - g) * (1.0 - r.metallic) * r.base_color / std::numbers::pi;
    }
  return sum / static_cast<double>(STEPS * STEPS);
}

// The fit is off most for rough metal at grazing angles.
TEST_F(Reflections, SurroundingsAreLightsFromEverywhere) {
  std::mt19937 random(2);
  std::vector<shared::ReflectCase> cases;
  for (const float roughness : ROUGHNESSES)
    for (const float metallic : {0.0F, 0.5F, 1.0F})
      for (const double n_v : {0.2, 0.35, 0.5, 0.75, 1.0}) {
        shared::ReflectCase made = turned_case(random, std::acos(n_v), 0.0);
        made.base_color = {1.0F, 0.5F, 0.1F};
        made.metallic = metallic;
        made.roughness = roughness;
        cases.push_back(made);
      }
  const std::vector<shared::ReflectAnswer> answers = ask(cases, Brdf::ggx);
  double worst = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const glm::dvec3 albedo = std::numbers::pi * integrated(cases[i]);
    const glm::dvec3 found = std::numbers::pi * glm::dvec3(answers[i].of_surroundings);
    const double allowed = cases[i].roughness > 0.8F ? 0.14 : 0.06;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(found[c], albedo[c], allowed) << describe(cases[i]);
      worst = std::max(worst, std::abs(found[c] - albedo[c]));
      EXPECT_GE(found[c], 0.0F);
    }
    if (cases[i].metallic == 1.0F) {
      EXPECT_LT(found.b, 0.6 * found.r) << "metal is coloured by its base colour alone: " << describe(cases[i]);
    }
  }
  EXPECT_GT(worst, 0.0);
}

}  // namespace
}  // namespace lamp::app
