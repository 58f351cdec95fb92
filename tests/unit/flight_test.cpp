// Flights and projections: the loop closes and is smooth, cameras keep +Y up, each projection shows what it says.
// SPDX-License-Identifier: Apache-2.0
#include "scene/flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "error.h"

namespace {

using lamp::View;
using lamp::app::Camera;
using lamp::app::Flight;
using lamp::app::flight_camera;
using lamp::app::view_of;

Flight square_flight() {
  return {.keys = {{.eye = {10, 2, 0}, .target = {0, 1, 0}},
                   {.eye = {0, 3, 10}, .target = {1, 0, 1}},
                   {.eye = {-10, 2, 0}, .target = {0, 0, 0}},
                   {.eye = {0, 5, -10}, .target = {0, 1, 2}}},
          .frames = 200,
          .fov_y = 0.8F};
}

glm::vec3 eye(const Camera& camera) { return {camera.world_from_camera[3]}; }
glm::vec3 forward(const Camera& camera) { return -glm::vec3(camera.world_from_camera[2]); }

void expect_rigid(const Camera& camera) {
  const glm::mat3 rotation(camera.world_from_camera);
  const glm::mat3 product = glm::transpose(rotation) * rotation;
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(product[i / 3][i % 3], i % 4 == 0 ? 1.0F : 0.0F, 1e-5F);
  EXPECT_NEAR(glm::determinant(rotation), 1.0F, 1e-5F);
}

TEST(Flight, PassesThroughItsKeysAndLooksAtTheirTargets) {
  const Flight flight = square_flight();
  for (std::uint32_t key = 0; key < 4; ++key) {
    const Camera camera = flight_camera(flight, key * 50);
    const glm::vec3 wanted = glm::normalize(flight.keys[key].target - flight.keys[key].eye);
    EXPECT_LT(glm::length(eye(camera) - flight.keys[key].eye), 1e-5F);
    EXPECT_LT(glm::length(forward(camera) - wanted), 1e-5F);
    EXPECT_EQ(camera.fov_y, 0.8F);
  }
}

TEST(Flight, ClosesSmoothlyAndWraps) {
  const Flight flight = square_flight();
  glm::vec3 previous_step = eye(flight_camera(flight, 0)) - eye(flight_camera(flight, 199));
  float path = 0.0F;
  for (std::uint32_t frame = 0; frame < 200; ++frame) {
    const Camera camera = flight_camera(flight, frame);
    expect_rigid(camera);
    EXPECT_GT(camera.world_from_camera[1].y, 0.0F) << "the picture's up must point up";
    EXPECT_EQ(camera.world_from_camera, flight_camera(flight, frame + 200).world_from_camera);
    const glm::vec3 step = eye(flight_camera(flight, frame + 1)) - eye(camera);
    EXPECT_LT(glm::length(step - previous_step), 0.05F) << "frame " << frame;
    previous_step = step;
    path += glm::length(step);
  }
  EXPECT_GT(path, 56.0F);  // the square through the keys is 56.6 m round, the loop is rounder
  EXPECT_LT(path, 75.0F);
}

TEST(Flight, LooksStraightDownAndUpAndAtItself) {
  for (const glm::vec3 target : {glm::vec3(0, -5, 0), glm::vec3(0, 5, 0), glm::vec3(0, 0, 0)}) {
    const Camera camera = flight_camera({.keys = {{.eye = glm::vec3(0.0F), .target = target}}}, 7);
    expect_rigid(camera);
    const glm::vec3 wanted = target.y == 0.0F ? glm::vec3(0, 0, -1) : glm::normalize(target);
    EXPECT_LT(glm::length(forward(camera) - wanted), 1e-6F);
  }
}

TEST(Flight, RefusesNoKeysAndNoFrames) {
  Flight flight = square_flight();
  flight.frames = 0;
  EXPECT_THROW(static_cast<void>(flight_camera(flight, 0)), lamp::app::Error);
  EXPECT_THROW(static_cast<void>(flight_camera(Flight{}, 0)), lamp::app::Error);
}

// Where a point straight ahead of the camera lands in the picture, in pixels.
glm::dvec2 pixel_of_axis(const View& view, double z_view) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(0.0, 0.0, -z_view, 1.0);
  return (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * glm::dvec2(view.width(), view.height());
}

TEST(ViewOf, PerspectiveProjections) {
  const Camera camera{.fov_y = 1.2F, .near_m = 0.1F, .far_m = 50.0F};
  const Camera endless{.fov_y = 1.2F, .near_m = 0.1F};
  const auto farthest = [](const Camera& c, std::string_view projection) {
    return view_of(c, 200, 100, projection).z_view(1e-30);
  };
  EXPECT_NEAR(farthest(camera, "camera"), 50.0, 1e-3);
  EXPECT_NEAR(farthest(camera, "perspective"), 50.0, 1e-3);
  EXPECT_NEAR(farthest(endless, "perspective"), 1000.0, 0.1);
  EXPECT_GT(farthest(endless, "camera"), 1e20);
  EXPECT_GT(farthest(camera, "infinite"), 1e20);
  for (const std::string_view projection : {"camera", "perspective", "infinite"}) {
    const View view = view_of(camera, 200, 100, projection);
    EXPECT_FALSE(view.orthographic());
    EXPECT_NEAR(view.view_position({0.0, 0.0}, 1.0).y, std::tan(0.6), 1e-6);
    EXPECT_NEAR(view.view_position({0.0, 0.0}, 1.0).x, -2.0 * std::tan(0.6), 1e-6);
    EXPECT_LT(glm::length(pixel_of_axis(view, 3.0) - glm::dvec2(100.0, 50.0)), 1e-6);
  }
}

TEST(ViewOf, OffCentreMovesTheAxisButNotTheScale) {
  const Camera camera{.fov_y = 1.2F, .near_m = 0.1F};
  const View view = view_of(camera, 200, 100, "off-centre");
  EXPECT_LT(glm::length(pixel_of_axis(view, 3.0) - glm::dvec2(40.0, 70.0)), 1e-4);
  const double height = view.view_position({0.0, 0.0}, 1.0).y - view.view_position({0.0, 100.0}, 1.0).y;
  EXPECT_NEAR(height, 2.0 * std::tan(0.6), 1e-6);
}

TEST(ViewOf, OrthographicOfAPerspectiveCameraShowsTheSameAtTenMetres) {
  const Camera camera{.fov_y = 1.2F, .near_m = 0.1F};
  const View flat = view_of(camera, 200, 100, "orthographic");
  const View deep = view_of(camera, 200, 100, "camera");
  EXPECT_TRUE(flat.orthographic());
  EXPECT_LT(glm::distance(glm::dvec3(flat.view_position({13.0, 77.0}, 10.0)),
                          glm::dvec3(deep.view_position({13.0, 77.0}, 10.0))),
            1e-5);
}

TEST(ViewOf, OrthographicCamera) {
  const Camera camera{.orthographic = true, .half_height = 3.0F, .near_m = 0.0F, .far_m = 20.0F};
  for (const std::string_view projection : {"camera", "orthographic", "off-centre"}) {
    const View view = view_of(camera, 200, 100, projection);
    EXPECT_TRUE(view.orthographic()) << projection;
    EXPECT_NEAR(view.view_position({0.0, 0.0}, 1.0).y - view.view_position({0.0, 100.0}, 1.0).y, 6.0, 1e-5);
    EXPECT_NEAR(view.z_view(1.0), 0.0, 1e-5);
    EXPECT_NEAR(view.z_view(1e-30), 20.0, 1e-4);
  }
  EXPECT_LT(glm::length(pixel_of_axis(view_of(camera, 200, 100, "off-centre"), 3.0) - glm::dvec2(40.0, 70.0)), 1e-4);
  EXPECT_FALSE(view_of(camera, 200, 100, "perspective").orthographic());
  EXPECT_FALSE(view_of(camera, 200, 100, "infinite").orthographic());
}

TEST(ViewOf, EveryNamedProjectionWorksAtAnySize) {
  const Camera camera;
  EXPECT_EQ(lamp::app::projection_names().size(), 5U);
  for (const std::string_view projection : lamp::app::projection_names()) {
    EXPECT_EQ(view_of(camera, 1, 1, projection).width(), 1U);
    EXPECT_EQ(view_of(camera, 1, 4096, projection).height(), 4096U);
  }
}

std::string refusal(const Camera& camera, std::uint32_t width, std::string_view projection) {
  try {
    static_cast<void>(view_of(camera, width, 10, projection));
  } catch (const lamp::app::Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ViewOf, RefusesWithOneLineThatNamesTheFault) {
  EXPECT_NE(refusal({}, 10, "infinit").find("infinite"), std::string::npos);
  EXPECT_NE(refusal({}, 0, "camera").find("0x10"), std::string::npos);
  EXPECT_NE(refusal({.name = "a", .fov_y = 0.0F}, 10, "camera").find("'a': the vertical"), std::string::npos);
  EXPECT_NE(refusal({.near_m = 5.0F, .far_m = 4.0F}, 10, "camera").find("far plane"), std::string::npos);
  EXPECT_NE(refusal({.orthographic = true}, 10, "camera").find("far plane"), std::string::npos);
  EXPECT_NE(refusal({.orthographic = true, .half_height = 0.0F, .far_m = 9.0F}, 10, "camera").find("half height"),
            std::string::npos);
  EXPECT_NE(refusal({.world_from_camera = glm::mat4(2.0F)}, 10, "camera").find("view_from_world"), std::string::npos);
}

TEST(FindCamera, ByNameOrTheFirst) {
  lamp::app::Scene scene{.name = "hall"};
  EXPECT_THROW(static_cast<void>(lamp::app::find_camera(scene, "")), lamp::app::Error);
  scene.cameras = {{.name = "door"}, {.name = "roof"}};
  EXPECT_EQ(lamp::app::find_camera(scene, "").name, "door");
  EXPECT_EQ(lamp::app::find_camera(scene, "roof").name, "roof");
  try {
    static_cast<void>(lamp::app::find_camera(scene, "cellar"));
    FAIL() << "an unknown camera must be refused";
  } catch (const lamp::app::Error& error) {
    EXPECT_STREQ(error.what(), "hall: camera 'cellar': there is no such camera; there are door, roof");
  }
}

}  // namespace
