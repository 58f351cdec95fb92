// Draws random views, tiles and lights.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/random_volumes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "gpu/check.h"

namespace lamp::app {
namespace {

constexpr double DEGREE = std::numbers::pi / 180.0;
constexpr double WORLD_M = 5000.0;
constexpr std::uint32_t BATCH_VIEWS = 256;

double device_depth(const View& view, double z_view) {
  const glm::dmat4& p = view.clip_from_view();
  return (p[3][2] - p[2][2] * z_view) / (p[3][3] - p[2][3] * z_view);
}

}  // namespace

double RandomVolumes::share_near_one() {
  return chance(0.5) ? uniform(0.0, 1.0) : 1.0 - std::pow(10.0, uniform(-4.8, -1.0));
}

glm::dvec3 RandomVolumes::unit_vector() {
  std::normal_distribution normal;
  return glm::normalize(glm::dvec3(normal(random_), normal(random_), normal(random_)));
}

glm::dmat4 RandomVolumes::projection(double aspect) {
  const double near_m = log_uniform(0.01, 1.0);
  if (chance(0.25)) {
    const double half = log_uniform(0.1, 1000.0);
    const double shift = chance(0.5) ? 0.0 : uniform(-half, half);
    const double nearest = chance(0.5) ? near_m : -log_uniform(1.0, WORLD_M);
    glm::dmat4 clip_from_view =
        orthographic({-half * aspect + shift, half * aspect + shift, -half + shift, half + shift}, nearest,
                     log_uniform(100.0, 10000.0));
    const double lean = chance(0.5) ? 0.0 : uniform(-1.0, 1.0);  // metres beside for each metre ahead
    clip_from_view[2][0] = lean * clip_from_view[0][0];
    clip_from_view[2][1] = lean * clip_from_view[1][1];
    return clip_from_view;
  }
  Window window = symmetric_window(uniform(0.2, 2.4), aspect);
  if (chance(0.5)) {
    const double shift = uniform(-0.5, 0.5) * (window.right - window.left);
    window.left += shift;
    window.right += shift;
    window.top += shift;
    window.bottom += shift;
  }
  return perspective(window, near_m, chance(0.5) ? INFINITE_FAR : log_uniform(100.0, 20000.0));
}

View RandomVolumes::view() {
  const auto width = static_cast<std::uint32_t>(log_uniform(1.0, 4096.0));
  const auto height = static_cast<std::uint32_t>(log_uniform(1.0, 4096.0));
  const glm::dvec3 eye = unit_vector() * (chance(0.2) ? 0.0 : log_uniform(1.0, WORLD_M));
  const glm::dquat turn = glm::angleAxis(uniform(0.0, 2.0 * std::numbers::pi), unit_vector());
  glm::dmat4 view_from_world = glm::mat4_cast(turn);
  if (chance(0.25)) {  // as far from rigid as views are accepted
    glm::dmat4 near_one(1.0);
    for (int i = 0; i < 9; ++i) near_one[i / 3][i % 3] += uniform(-4.9e-5, 4.9e-5);
    view_from_world *= near_one;
  }
  view_from_world[3] = glm::dvec4(-glm::dvec3(view_from_world * glm::dvec4(eye, 0.0)), 1.0);
  return take(View::create(width, height, projection(static_cast<double>(width) / height), view_from_world));
}

RandomTile RandomVolumes::tile(const View& view) {
  const std::uint32_t tile_px = 8U << below(4);
  const glm::uvec2 pixel(below(view.width()), below(view.height()));
  const glm::uvec2 corner = pixel / tile_px * tile_px;
  const double z_nearest = view.z_view(1.0);
  const double z_farthest = std::min(WORLD_M, view.orthographic() ? view.z_view(1e-6) : view.z_view(1e-30));
  const double z =
      z_nearest > 0.0 ? log_uniform(z_nearest, std::max(z_farthest, 1.01 * z_nearest)) : uniform(z_nearest, z_farthest);
  const float depth = std::clamp(static_cast<float>(device_depth(view, z)), 1e-20F, 1.0F);
  const auto thickness = static_cast<float>(chance(0.5) ? 0.0 : uniform(0.0, 0.5));
  return {.volume = {.min_px = Vec2(corner),
                     .max_px = Vec2(corner + tile_px),
                     .nearest = std::min(1.0F, depth * (1.0F + thickness)),
                     .farthest = depth * (1.0F - thickness)},
          .position_world = glm::dvec3(view.world_position(pixel.x, pixel.y, depth)),
          .depth = depth};
}

Light RandomVolumes::light_at(const glm::dvec3& position, const glm::dvec3& towards) {
  Light light;
  light.position = glm::vec3(position);
  if (chance(0.4)) return light;
  light.type = LightType::spot;
  light.outer_angle = static_cast<float>((chance(0.1) ? 90.0 : log_uniform(0.1, 90.0)) * DEGREE);
  light.inner_angle = 0.5F * light.outer_angle;
  const double angle = light.outer_angle * share_near_one();
  const glm::dvec3 side = glm::normalize(glm::cross(towards, unit_vector()));
  light.direction = glm::vec3(glm::normalize(towards * std::cos(angle) + side * std::sin(angle)));
  return light;
}

Light RandomVolumes::light_reaching(const View& view, const glm::dvec3& position_world) {
  const double range = log_uniform(0.05, 500.0);
  // Where bounds are tightest: straight along the view's axes.
  glm::dvec3 away =
      chance(0.5) ? unit_vector() : glm::dvec3(glm::dmat4(view.world_from_view())[static_cast<int>(below(3))]);
  if (chance(0.5)) away = -away;
  Light light = light_at(position_world + away * (range * share_near_one()), -glm::normalize(away));
  light.range = static_cast<float>(range);
  return light;
}

Light RandomVolumes::light_around(const glm::dvec3& position_world) {
  const double range = log_uniform(0.05, 500.0);
  Light light = light_at(position_world + unit_vector() * (range * uniform(0.0, 10.0)), unit_vector());
  light.range = static_cast<float>(range);
  return light;
}

RandomBatch draw_batch(std::uint32_t seed, std::uint32_t tiles, Lights kind) {
  RandomVolumes random(seed);
  std::vector<View> views;
  RandomBatch batch;
  for (std::uint32_t i = 0; i < BATCH_VIEWS; ++i) {
    views.push_back(random.view());
    batch.frames.push_back(views.back().frame(0, 0));
  }
  for (std::uint32_t i = 0; i < tiles; ++i) {
    const View& view = views[i % BATCH_VIEWS];
    RandomTile tile = random.tile(view);
    tile.volume.frame = i % BATCH_VIEWS;
    batch.tiles.push_back(tile);
    batch.lights.push_back(pack(kind == Lights::reaching ? random.light_reaching(view, tile.position_world)
                                                         : random.light_around(tile.position_world)));
  }
  return batch;
}

}  // namespace lamp::app
