// Makes the tests' lights.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/test_lights.h"

#include <limits>
#include <numbers>

#include "error.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr float DEGREE = std::numbers::pi_v<float> / 180.0F;
constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;
constexpr float INFINITE = std::numeric_limits<float>::infinity();

/// The view's axes in the world.
struct Axes {
  glm::vec3 eye, right, up, ahead;
  explicit Axes(const View& view)
      : eye(glm::dmat4(view.world_from_view())[3]),
        right(glm::dmat4(view.world_from_view())[0]),
        up(glm::dmat4(view.world_from_view())[1]),
        ahead(-glm::dmat4(view.world_from_view())[2]) {}
};

Light point(const glm::vec3& position, float range, float intensity = 20.0F) {
  Light light;
  light.position = position;
  light.range = range;
  light.intensity = intensity;
  return light;
}

Light spot(const Light& from, const glm::vec3& direction, float outer_angle) {
  Light light = from;
  light.type = LightType::spot;
  light.direction = direction;
  light.outer_angle = outer_angle;
  light.inner_angle = 0.7F * outer_angle;
  return light;
}

void make_all(std::vector<Light>& lights, Mix mix, const glm::vec3& ahead) {
  for (Light& light : lights) {
    if (mix == Mix::points) light.type = LightType::point;
    if (mix == Mix::spots && light.type == LightType::point) light = spot(light, ahead, RIGHT_ANGLE);
  }
}

}  // namespace

std::vector<Light> hard_lights(const View& view) {
  const Axes axes(view);
  const auto near_m = static_cast<float>(view.z_view(1.0));
  const glm::vec3 slanted = axes.ahead + 0.3F * axes.right - 0.2F * axes.up;
  return {
      point(axes.eye, 6.0F),
      point(axes.eye - axes.ahead, 4.0F),
      point(axes.eye + axes.ahead * near_m, 0.5F * near_m),
      point(axes.eye + axes.ahead * (0.5F * near_m), 3.0F),
      point(axes.eye + 2.0F * axes.ahead, 0.0F),
      point(axes.eye + axes.up, INFINITE, 5.0F),
      spot(point(axes.eye, 10.0F), axes.ahead, 0.0F),
      spot(point(axes.eye + 0.1F * axes.right, INFINITE, 200.0F), slanted, 0.5F * DEGREE),
      spot(point(axes.eye + 0.5F * axes.up, 20.0F), slanted, 45.0F * DEGREE),
      spot(point(axes.eye - axes.ahead, INFINITE, 5.0F), axes.right, RIGHT_ANGLE),
      spot(point(axes.eye + axes.ahead, 50.0F), -axes.ahead, 30.0F * DEGREE),
      point(axes.eye + 5e4F * axes.up, 1e5F, 1e10F),
      spot(point(axes.eye - 3e4F * axes.ahead, 1e5F, 1e10F), axes.ahead, 5.0F * DEGREE),
      point(axes.eye + 2.0F * axes.ahead, 1e-3F),
      point(axes.eye + 1e4F * axes.right, 1.0F),
  };
}

std::vector<shared::Light> test_lights(const OpenAir& air, const View& view, const LightMix& mix) {
  constexpr float SPOTS[] = {0.0F, 1.0F, 0.5F};
  std::vector<Light> lights =
      place_lights(air, {.count = mix.count, .spots = SPOTS[static_cast<int>(mix.mix)], .seed = mix.seed});
  const std::vector<Light> hard = hard_lights(view);
  if (mix.count > 0 && mix.count < hard.size()) lights[0] = hard[mix.seed % hard.size()];
  if (mix.count >= hard.size())
    for (std::size_t i = 0; i < hard.size(); ++i) lights[i * (mix.count - 1) / (hard.size() - 1)] = hard[i];
  make_all(lights, mix.mix, Axes(view).ahead);
  if (const auto error = check_lights(lights)) throw Error(*error);
  return pack(lights);
}

}  // namespace lamp::app
