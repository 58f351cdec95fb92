// A spot's cone is held against the sphere around a cube of the world: the test says what the cone's point next to the
// sphere's centre says in double precision.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "gpu/dispatch.h"
#include "gpu/shaders/cone_case.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t CASES = 1U << 16;

class RandomCones {
 public:
  double in(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  glm::dvec3 vector(double half) {
    const double x = in(-half, half);
    const double y = in(-half, half);
    return {x, y, in(-half, half)};
  }

  /// Narrow ones, wide ones and half spaces; some along the cube's edges, some with the tip in the cube.
  shared::ConeCase cone() {
    glm::dvec3 axis = glm::normalize(vector(1.0) + glm::dvec3(1e-3));
    if (in(0.0, 1.0) < 0.2)
      axis = std::array{glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}[engine_() % 3];
    if (in(0.0, 1.0) < 0.1) axis = glm::normalize(glm::dvec3(axis.x, axis.y, 0.0) + glm::dvec3(1e-9, 0.0, 0.0));
    const double side = std::exp2(std::floor(in(-5.0, 6.0)));
    double angle = in(0.0, 0.5 * std::numbers::pi);
    if (in(0.0, 1.0) < 0.3) angle *= 0.05;
    if (in(0.0, 1.0) < 0.05) angle = 0.5 * std::numbers::pi;
    const glm::dvec3 low = glm::floor(vector(4.0)) * side;
    return {.tip = glm::vec3(vector(4.0 * side)),
            .axis = glm::vec3(axis),
            .sine = static_cast<float>(std::sin(angle)),
            .cosine = static_cast<float>(std::cos(angle)),
            .low = glm::vec3(low),
            .side = static_cast<float>(side)};
  }

 private:
  std::mt19937 engine_{1};
};

/// The cone's point next to one that is given from its tip.
glm::dvec3 onto_cone(const shared::ConeCase& c, const glm::dvec3& point) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(glm::vec3(c.axis)));
  const double along = glm::dot(point, axis);
  const glm::dvec3 aside = point - along * axis;
  const double off = glm::length(aside);
  if (double{c.cosine} * off <= double{c.sine} * along) return point;
  const double on_edge = double{c.cosine} * along + double{c.sine} * off;
  if (on_edge <= 0.0) return glm::dvec3(0.0);
  return on_edge * (double{c.cosine} * axis + double{c.sine} * aside / off);
}

/// How far the cone is from the sphere around the cube, in sides of the cube; negative: they share points.
double apart(const shared::ConeCase& c) {
  const glm::dvec3 middle = glm::dvec3(glm::vec3(c.low)) + 0.5 * double{c.side} - glm::dvec3(glm::vec3(c.tip));
  return glm::distance(onto_cone(c, middle), middle) / double{c.side} - 0.5 * std::numbers::sqrt3;
}

class ConeCubes : public GpuTest {};

TEST_F(ConeCubes, ConesMeetTheSpheresAroundCubesThatTheyReachAndNoOthers) {
  RandomCones random;
  std::vector<shared::ConeCase> cases;
  for (std::uint32_t i = 0; i < CASES; ++i) cases.push_back(random.cone());
  const vulkan::Buffer buffers[] = {host_buffer_of("cases", cases), host_buffer("answers", CASES * 4)};
  Dispatch what{.shader = "cone_cubes", .groups = {CASES / 64, 1, 1}};
  for (const vulkan::Buffer& buffer : buffers) what.resources.push_back(vulkan::Resource::storage(buffer.handle()));
  dispatch(what);
  const std::vector<std::uint32_t> answers = contents<std::uint32_t>(buffers[1]);
  std::uint32_t met = 0;
  std::uint32_t passed = 0;
  for (std::uint32_t i = 0; i < CASES; ++i) {
    const double distance = apart(cases[i]);
    const bool nearly_half_a_space = cases[i].cosine < 0.003F;  // the test takes all of it
    const double margin = nearly_half_a_space ? 0.1 : 1e-3;
    if (distance > 0.0 && distance < margin) continue;
    const bool meets = distance <= 0.0;
    ASSERT_EQ(answers[i] != 0, meets) << "case " << i << ", " << distance << " sides apart, sine " << cases[i].sine;
    (meets ? met : passed) += 1;
  }
  EXPECT_GT(met, CASES / 6);
  EXPECT_GT(passed, CASES / 6);
  EXPECT_GT(met + passed, CASES / 100 * 95);
}

}  // namespace
}  // namespace lamp::app
