// The test of a spot's cone against a cube of the world is exact: it says what alternating projections in double
// precision find, which come ever nearer to both where cone and cube share a point (von Neumann; Cheney, Goldstein,
// 1959). SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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

/// How far cone and cube are apart, in sides of the cube; not less, and close to it.
double apart(const shared::ConeCase& c) {
  const glm::dvec3 low = glm::dvec3(glm::vec3(c.low)) - glm::dvec3(glm::vec3(c.tip));
  const glm::dvec3 high = low + double{c.side};
  glm::dvec3 in_cube = 0.5 * (low + high);
  double least = glm::length(in_cube);
  for (int step = 0; step < 20'000 && least > 0.0; ++step) {
    const glm::dvec3 in_cone = onto_cone(c, in_cube);
    in_cube = glm::clamp(in_cone, low, high);
    const double before = least;
    least = glm::distance(in_cone, in_cube);
    if (before - least < 1e-9 * least) break;
  }
  return least / double{c.side};
}

class ConeCubes : public GpuTest {};

TEST_F(ConeCubes, ConesMeetTheCubesThatTheyReachAndNoOthers) {
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
    if (distance > 1e-5 && distance < 1e-3) continue;  // projections hardly end where they nearly touch
    const bool meets = distance <= 1e-5;
    ASSERT_EQ(answers[i] != 0, meets) << "case " << i << ", " << distance << " sides apart, sine " << cases[i].sine;
    (meets ? met : passed) += 1;
  }
  EXPECT_GT(met, CASES / 6);
  EXPECT_GT(passed, CASES / 5);
  EXPECT_GT(met + passed, CASES / 100 * 95);
}

}  // namespace
}  // namespace lamp::app
