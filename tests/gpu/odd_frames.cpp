// Makes odd frames.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/odd_frames.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "gpu/check.h"
#include "gpu/random_volumes.h"
#include "just_reaching.h"
#include "random.h"

namespace lamp::app {
namespace {

constexpr double ASPECT = static_cast<double>(ODD_SIZE.x) / ODD_SIZE.y;
constexpr double NEAREST_M = -40.0;  // surfaces of views that look behind the eye
constexpr double FARTHEST_M = 60.0;
constexpr std::uint32_t FLAT_PX = 32;  // the largest tile
constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;

glm::dmat4 looks_behind_the_eye() { return orthographic(symmetric_window(1.4, ASPECT), NEAREST_M - 2.0, 90.0); }

/// Lines of sight that lean: x and y move with the depth.
glm::dmat4 leaning(glm::dmat4 clip_from_view) {
  clip_from_view[2][0] += 0.05;
  clip_from_view[2][1] -= 0.03;
  return clip_from_view;
}

/// A host whose viewport is turned over.
glm::dmat4 turned_over(const glm::dmat4& clip_from_view) {
  return glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, 1.0)) * clip_from_view;
}

glm::dmat4 pose() {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
  return glm::translate(turn, glm::dvec3(3.0, -20.0, 7.5));
}

/// What an engine gets that turns its camera by one float matrix after another.
glm::dmat4 after_many_turns() {
  glm::mat4 view_from_world(pose());
  for (int i = 0; i < 3000; ++i)
    view_from_world = glm::rotate(glm::mat4(1.0F), 0.01F, glm::vec3(0.6F, 0.8F, 0.0F)) * view_from_world;
  return {view_from_world};
}

/// Longer one way, shorter another, and sheared, as far as views are accepted.
glm::dmat4 stretched_and_sheared() {
  glm::dmat4 stretch(1.0);
  stretch[0] = {1.000045, 2e-5, 0.0, 0.0};
  stretch[1] = {2e-5, 0.99996, -2e-5, 0.0};
  stretch[2] = {0.0, -2e-5, 1.00004, 0.0};
  return stretch * pose();
}

float device_depth(const View& view, double z_view) {
  const glm::dmat4& p = view.clip_from_view();
  return static_cast<float>((p[3][2] - p[2][2] * z_view) / (p[3][3] - p[2][3] * z_view));
}

/// Squares of 32 pixels at one depth each, a slope across one of them, sky beside.
std::vector<float> steps(const View& view, double nearest, double farthest) {
  constexpr double SHARES[] = {0.0, 0.35, 1.0, 0.4, 0.7, 0.1};
  std::vector<float> depth;
  for (std::uint32_t y = 0; y < ODD_SIZE.y; ++y)
    for (std::uint32_t x = 0; x < ODD_SIZE.x; ++x) {
      const std::uint32_t square = x / FLAT_PX + 3 * (y / FLAT_PX);
      const double share = square == 4 ? static_cast<double>(x - FLAT_PX) / FLAT_PX : SHARES[square];
      const bool sky = square == 2 && x % 3 == 0;
      depth.push_back(sky ? 0.0F : device_depth(view, nearest + (farthest - nearest) * share));
    }
  return depth;
}

/// Half of them straight ahead or behind of a surface and only just within reach of it, the others around surfaces.
std::vector<Light> reaching_lights(const View& view, const std::vector<float>& depth) {
  RandomVolumes random(5);
  const glm::dvec3 ahead = -glm::normalize(glm::dvec3(glm::dmat4(view.world_from_view())[2]));
  std::vector<Light> lights;
  for (std::uint32_t i = 0; lights.size() < ODD_LIGHTS; ++i) {
    const glm::uvec2 pixel(i * 7 % ODD_SIZE.x, i * 5 % ODD_SIZE.y);
    const float d = depth[std::size_t{pixel.y} * ODD_SIZE.x + pixel.x];
    if (d == 0.0F) continue;
    const glm::dvec3 surface = view.world_position(pixel.x, pixel.y, d);
    if (i % 2 == 0) {
      lights.push_back(random.light_reaching(view, surface));
      continue;
    }
    Light light;
    light.range = static_cast<float>(1.5 * std::pow(1.04, i));
    const glm::dvec3 away = i % 4 == 1 ? ahead : -ahead;
    light.position = glm::vec3(surface + away * (light.range * (1.0 - 2e-5)));
    if (i % 8 > 4) {
      light.type = LightType::spot;
      light.direction = glm::vec3(-away);
      light.outer_angle = i % 16 > 8 ? 0.1F : 1.2F;
    }
    lights.push_back(light);
  }
  return lights;
}

/// Around surfaces at the rims of tiles: the end of a range, or the side of a cone, only just includes them. Of half of
/// the cones, sides lie along the tile's.
std::vector<Light> rim_lights(const View& view, const std::vector<float>& depth) {
  constexpr double ANGLES[] = {0.03, 0.3, 0.8, 1.3, 1.57};
  constexpr std::uint32_t TILE_PX[] = {8, 16, 32};
  test::RandomDoubles random(11);
  std::vector<Light> lights;
  while (lights.size() < ODD_LIGHTS) {
    const std::uint32_t tile = TILE_PX[random.below(std::size(TILE_PX))];
    const bool column = random.below(2) == 0;  // a tile's column, or its row
    const bool first = random.below(2) == 0;   // or the last of the tile
    glm::uvec2 pixel(random.below(ODD_SIZE.x), random.below(ODD_SIZE.y));
    std::uint32_t& at = column ? pixel.x : pixel.y;
    at = at / tile * tile + (first ? 0 : tile - 1);
    if (pixel.x >= ODD_SIZE.x || pixel.y >= ODD_SIZE.y) continue;
    const float d = depth[std::size_t{pixel.y} * ODD_SIZE.x + pixel.x];
    if (d == 0.0F) continue;
    const glm::dvec3 surface = view.world_position(pixel.x, pixel.y, d);
    const double distance = std::exp(random.in(std::log(0.5), std::log(40.0)));
    const glm::dvec3 towards = random.direction();
    const double angle = ANGLES[lights.size() % std::size(ANGLES)];
    if (lights.size() % 4 == 0) {
      lights.push_back(test::point_just_reaching(surface, towards, distance));
    } else if (lights.size() % 4 == 1) {
      const glm::dvec3 outside = glm::normalize(glm::cross(towards, random.direction()));
      lights.push_back(test::spot_just_reaching(surface, towards, distance, outside, angle));
    } else {
      const glm::uvec2 next = column ? glm::uvec2(pixel.x, pixel.y ^ 1U) : glm::uvec2(pixel.x ^ 1U, pixel.y);
      const glm::dvec3 ahead = glm::dvec3(view.world_position(pixel.x, pixel.y, 0.5F * d)) - surface;
      const glm::dvec3 rim = glm::dvec3(view.world_position(next.x, next.y, d)) - surface;
      const glm::dvec3 beside = glm::normalize(glm::cross(ahead, rim));
      const glm::dvec3 along = glm::normalize(towards - glm::dot(towards, beside) * beside);
      const glm::dvec3 outside = random.below(2) == 0 ? beside : -beside;
      lights.push_back(test::spot_just_reaching(surface, along, distance, outside, angle));
    }
  }
  return lights;
}

/// Points and spots that reach everything ahead of them, from near and from beyond every scene.
std::vector<Light> endless_lights(const View& view) {
  constexpr float RANGES[] = {1e18F, 2e18F, 1e30F, std::numeric_limits<float>::max(),
                              std::numeric_limits<float>::infinity()};
  constexpr float AWAY_M[] = {3.0F, 7e6F, 6e17F, 3e18F, 1e22F, 1e30F, 3e38F};
  constexpr float ANGLES[] = {0.01F, 0.4F, 1.2F, RIGHT_ANGLE};
  const glm::vec3 ahead = -glm::normalize(glm::vec3(glm::dmat4(view.world_from_view())[2]));
  const glm::vec3 eye(glm::dmat4(view.world_from_view())[3]);
  std::vector<Light> lights(ODD_LIGHTS);
  for (std::uint32_t i = 0; i < ODD_LIGHTS; ++i) {
    Light& light = lights[i];
    light.range = RANGES[i % std::size(RANGES)];
    const glm::vec3 away = glm::normalize(glm::vec3(static_cast<float>(i % 3) - 1.0F) + (i % 2 == 0 ? ahead : -ahead));
    light.position = eye + AWAY_M[i % std::size(AWAY_M)] * away;
    if (i % 4 == 0) continue;
    light.type = LightType::spot;
    light.direction = i % 11 == 0 ? away : -away;
    light.outer_angle = ANGLES[i / 4 % std::size(ANGLES)];
  }
  return lights;
}

OddFrame frame_of(std::string name, const glm::dmat4& clip_from_view, const glm::dmat4& view_from_world) {
  const View view = take(View::create(ODD_SIZE.x, ODD_SIZE.y, clip_from_view, view_from_world));
  const double nearest = view.orthographic() ? NEAREST_M : 0.5 + clip_from_view[3][3] / clip_from_view[2][3];
  std::vector<float> depth = steps(view, nearest, FARTHEST_M);
  std::vector<Light> lights = reaching_lights(view, depth);
  return {std::move(name), view, std::move(depth), std::move(lights)};
}

OddFrame endless(OddFrame frame) {
  frame.name += ", endless lights";
  frame.lights = endless_lights(frame.view);
  return frame;
}

OddFrame at_rims(OddFrame frame) {
  frame.name += ", lights at rims of tiles";
  frame.lights = rim_lights(frame.view, frame.depth);
  return frame;
}

}  // namespace

std::vector<OddFrame> odd_frames() {
  const glm::dmat4 usual = perspective(symmetric_window(0.9, ASPECT), 0.1, INFINITE_FAR);
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), glm::dvec3(-0.99996, 0.99996, 0.99996));
  return {frame_of("behind the eye", looks_behind_the_eye(), pose()),
          frame_of("leaning, behind the eye", leaning(looks_behind_the_eye()), pose()),
          frame_of("larger", usual, glm::scale(pose(), glm::dvec3(1.000049))),
          frame_of("smaller, mirrored", usual, mirror * pose()),
          frame_of("turned over", turned_over(usual), pose()),
          frame_of("after many turns", usual, after_many_turns()),
          frame_of("stretched and sheared", usual, stretched_and_sheared()),
          frame_of("eye behind view space's origin", glm::translate(usual, glm::dvec3(0.0, 0.0, -3.0)), pose()),
          frame_of("eye ahead of it", glm::translate(usual, glm::dvec3(0.0, 0.0, 3.0)), pose()),
          frame_of("larger, orthographic", looks_behind_the_eye(), glm::scale(pose(), glm::dvec3(1.000049))),
          endless(frame_of("perspective", usual, pose())),
          endless(frame_of("orthographic", leaning(looks_behind_the_eye()), pose())),
          at_rims(frame_of("perspective", usual, pose())),
          at_rims(frame_of("orthographic", leaning(looks_behind_the_eye()), pose()))};
}

}  // namespace lamp::app
