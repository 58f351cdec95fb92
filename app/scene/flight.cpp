// Flights and projections: a smooth closed loop through the keys, and a view of any camera under any projection.
// Based on: Catmull and Rom, A Class of Local Interpolating Splines (1974), uniform knots.
// Promise: frame f and frame f + frames give the same camera; a camera keeps +Y up and is never degenerate.
// SPDX-License-Identifier: Apache-2.0
#include "scene/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "error.h"
#include "lamplight/method.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 5> PROJECTIONS{"camera", "perspective", "infinite", "orthographic",
                                                      "off-centre"};

constexpr double DEFAULT_NEAR_M = 0.05;
constexpr double DEFAULT_FAR_M = 1000.0;
// An orthographic window shows what a perspective camera shows at this distance: the middle of a room or of a street.
constexpr double ORTHOGRAPHIC_AT_M = 10.0;
constexpr double ORTHOGRAPHIC_FAR_M = 2000.0;
// How far `off-centre` moves the window, as parts of its width and height. The axis stays inside.
constexpr double SHIFT_X = 0.3;
constexpr double SHIFT_Y = 0.2;

glm::vec3 catmull_rom(const std::array<glm::vec3, 4>& p, float t) {
  const glm::vec3 a = -p[0] + 3.0F * p[1] - 3.0F * p[2] + p[3];
  const glm::vec3 b = 2.0F * p[0] - 5.0F * p[1] + 4.0F * p[2] - p[3];
  const glm::vec3 c = p[2] - p[0];
  return p[1] + 0.5F * t * (c + t * (b + t * a));
}

// The rigid pose at `eye` that looks at `target`, +Y up; for a look straight up or down, -Z is up in the picture.
glm::mat4 look_at(const glm::vec3& eye, const glm::vec3& target) {
  glm::dvec3 forward = glm::dvec3(target) - glm::dvec3(eye);
  const double distance = glm::length(forward);
  forward = distance > 0.0 ? forward / distance : glm::dvec3(0.0, 0.0, -1.0);
  glm::dvec3 side = glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0));
  if (glm::length(side) < 1e-4) side = glm::cross(forward, glm::dvec3(0.0, 0.0, -1.0));
  const glm::dvec3 right = glm::normalize(side);
  const glm::dvec3 up = glm::cross(right, forward);
  return {glm::vec4(right, 0.0F), glm::vec4(up, 0.0F), glm::vec4(-forward, 0.0F), glm::vec4(eye, 1.0F)};
}

// The window of a camera at 1 m ahead.
Window window_of(const Camera& camera, double aspect) {
  constexpr float WIDEST = 3.14F;  // radians; towards pi, the window grows beyond all numbers
  const bool sensible = camera.fov_y > 0.0F && camera.fov_y < WIDEST;  // false for a NaN
  if (!sensible) {
    throw Error(fmt::format("camera '{}': the vertical field of view must lie between 0 and {} radians, got {}",
                            camera.name, WIDEST, camera.fov_y));
  }
  return symmetric_window(camera.fov_y, aspect);
}

Window shifted(const Window& window, std::string_view projection) {
  if (projection != "off-centre") return window;
  const double x = SHIFT_X * (window.right - window.left);
  const double y = SHIFT_Y * (window.top - window.bottom);
  return {.left = window.left + x, .right = window.right + x, .bottom = window.bottom + y, .top = window.top + y};
}

glm::dmat4 perspective_of(const Camera& camera, double aspect, std::string_view projection) {
  const Window window = window_of(camera, aspect);
  const double near_m = camera.near_m > 0.0F ? camera.near_m : DEFAULT_NEAR_M;
  double far_m = camera.far_m > 0.0F ? camera.far_m : INFINITE_FAR;
  if (projection == "infinite") far_m = INFINITE_FAR;
  if (projection == "perspective" && far_m >= INFINITE_FAR) far_m = std::max(DEFAULT_FAR_M, 2.0 * near_m);
  if (!(near_m < far_m)) {
    throw Error(fmt::format("camera '{}': the far plane must lie beyond the near plane ({} m), got {} m", camera.name,
                            near_m, far_m));
  }
  return perspective(shifted(window, projection), near_m, far_m);
}

glm::dmat4 orthographic_of(const Camera& camera, double aspect, std::string_view projection) {
  double half_height = camera.half_height;
  double near_m = camera.near_m;
  double far_m = camera.far_m;
  if (!camera.orthographic) {
    half_height = window_of(camera, aspect).top * ORTHOGRAPHIC_AT_M;
    near_m = DEFAULT_NEAR_M;
    far_m = ORTHOGRAPHIC_FAR_M;
  }
  if (!std::isfinite(half_height) || half_height <= 0.0) {
    throw Error(fmt::format("camera '{}': the half height must be finite and > 0 m, got {}", camera.name, half_height));
  }
  if (!(near_m < far_m) || !std::isfinite(near_m) || !std::isfinite(far_m)) {
    throw Error(
        fmt::format("camera '{}': an orthographic far plane must be finite and beyond the near plane ({} m), "
                    "got {} m",
                    camera.name, near_m, far_m));
  }
  const Window window{
      .left = -half_height * aspect, .right = half_height * aspect, .bottom = -half_height, .top = half_height};
  return orthographic(shifted(window, projection), near_m, far_m);
}

void check_projection_name(std::string_view projection) {
  if (std::ranges::find(PROJECTIONS, projection) != PROJECTIONS.end()) return;
  throw Error(fmt::format("projection '{}': there is no such projection; the nearest are {}", projection,
                          fmt::join(nearest_names(projection, PROJECTIONS), ", ")));
}

/// The same view from elsewhere: `moved` of its view space.
View placed(const View& view, const glm::dmat4& moved) {
  return View::create(view.width(), view.height(), view.clip_from_view(), moved * glm::dmat4(view.view_from_world()))
      .value();
}

}  // namespace

Camera flight_camera(const Flight& flight, std::uint32_t frame) {
  if (flight.keys.empty() || flight.frames == 0) {
    throw Error(fmt::format("flight: expected at least 1 key and 1 frame, got {} keys and {} frames",
                            flight.keys.size(), flight.frames));
  }
  const std::size_t count = flight.keys.size();
  const double place = static_cast<double>(frame % flight.frames) / flight.frames * static_cast<double>(count);
  const auto segment = std::min(static_cast<std::size_t>(place), count - 1);
  const auto t = static_cast<float>(place - static_cast<double>(segment));
  std::array<glm::vec3, 4> eyes{};
  std::array<glm::vec3, 4> targets{};
  for (std::size_t i = 0; i < 4; ++i) {
    const FlightKey& key = flight.keys[(segment + count - 1 + i) % count];
    eyes[i] = key.eye;
    targets[i] = key.target;
  }
  return {.name = "flight",
          .world_from_camera = look_at(catmull_rom(eyes, t), catmull_rom(targets, t)),
          .fov_y = flight.fov_y,
          .near_m = flight.near_m};
}

Camera frame_camera(const Scene& scene, int frame) {
  if (!scene.flight) throw Error(fmt::format("frame {}: the scene {} has no camera flight", frame, scene.name));
  const std::uint32_t frames = scene.flight->frames;
  // The path is closed, so that later frames would only be the same ones again.
  if (frame < 0 || static_cast<std::uint32_t>(frame) >= frames)
    throw Error(
        fmt::format("frame {}: the flight of the scene {} has the frames 0 to {}", frame, scene.name, frames - 1));
  return flight_camera(*scene.flight, static_cast<std::uint32_t>(frame));
}

std::span<const std::string_view> projection_names() { return PROJECTIONS; }

View view_of(const Camera& camera, std::uint32_t width, std::uint32_t height, std::string_view projection) {
  check_projection_name(projection);
  if (width == 0 || height == 0) throw Error(fmt::format("size {}x{}: expected at least 1x1", width, height));
  const double aspect = static_cast<double>(width) / height;
  const bool keeps_kind = projection == "camera" || projection == "off-centre";
  const bool flat = projection == "orthographic" || (keeps_kind && camera.orthographic);
  const glm::dmat4 clip_from_view =
      flat ? orthographic_of(camera, aspect, projection) : perspective_of(camera, aspect, projection);
  auto view = View::create(width, height, clip_from_view, glm::inverse(glm::dmat4(camera.world_from_camera)));
  if (!view.ok()) throw Error(fmt::format("camera '{}': {}", camera.name, view.error().message));
  return view.value();
}

const Camera& find_camera(const Scene& scene, std::string_view name) {
  if (scene.cameras.empty()) throw Error(fmt::format("{}: expected at least one camera, got none", scene.name));
  if (name.empty()) return scene.cameras.front();
  const auto found = std::ranges::find(scene.cameras, name, &Camera::name);
  if (found != scene.cameras.end()) return *found;
  std::vector<std::string_view> names;
  names.reserve(scene.cameras.size());
  for (const Camera& camera : scene.cameras) names.push_back(camera.name);
  constexpr std::size_t MOST_NAMED = 8;
  throw Error(fmt::format("{}: camera '{}': there is no such camera; {} {}", scene.name, name,
                          names.size() > MOST_NAMED ? "the nearest are" : "there are",
                          fmt::join(nearest_names(name, names, MOST_NAMED), ", ")));
}

std::vector<View> both_eyes(const View& view, double apart_m) {
  std::vector<View> eyes;
  for (const double to_the_right : {-0.5 * apart_m, 0.5 * apart_m})
    eyes.push_back(placed(view, glm::translate(glm::dmat4(1.0), glm::dvec3(-to_the_right, 0.0, 0.0))));
  return eyes;
}

std::vector<View> all_around(const View& view, std::uint32_t count) {
  std::vector<View> views{view};
  for (std::uint32_t i = 1; i < count; ++i)
    views.push_back(placed(view, glm::rotate(glm::dmat4(1.0), glm::two_pi<double>() * i / count, {0.0, 1.0, 0.0})));
  return views;
}

}  // namespace lamp::app
