// Views: every projection there and back, the meaning of device depth, and each refusal of View::create.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/view.h"

#include <gtest/gtest.h>
#include <bit>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using lamp::View;
using lamp::Window;

constexpr std::uint32_t WIDTH = 321;
constexpr std::uint32_t HEIGHT = 123;
constexpr double NEAR = 0.25;
constexpr double FAR = 300.0;
constexpr Window OFF_CENTRE{.left = -0.3, .right = 1.1, .bottom = -0.9, .top = 0.2};

glm::dmat4 pose() {
  const glm::dmat4 m = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
  return glm::translate(m, glm::dvec3(3.0, -20.0, 7.5));
}

struct Projection {
  std::string name;
  glm::dmat4 clip_from_view;
  double far_m;
};

std::vector<Projection> projections() {
  const Window centred = lamp::symmetric_window(0.9, 16.0 / 9.0);
  const Window metres{.left = -20.0, .right = 12.0, .bottom = -3.0, .top = 9.0};
  return {{"perspective", lamp::perspective(centred, NEAR, FAR), FAR},
          {"infinite", lamp::perspective(centred, NEAR, lamp::INFINITE_FAR), lamp::INFINITE_FAR},
          {"off-centre", lamp::perspective(OFF_CENTRE, NEAR, FAR), FAR},
          {"off-centre infinite", lamp::perspective(OFF_CENTRE, NEAR, lamp::INFINITE_FAR), lamp::INFINITE_FAR},
          {"orthographic", lamp::orthographic(metres, NEAR, FAR), FAR},
          {"orthographic behind the eye", lamp::orthographic(metres, -50.0, FAR), FAR}};
}

View make_view(const glm::dmat4& clip_from_view, const glm::dmat4& view_from_world = glm::dmat4(1.0)) {
  auto view = View::create(WIDTH, HEIGHT, clip_from_view, view_from_world);
  EXPECT_TRUE(view.ok()) << view.error().text();
  return view.value();
}

// Pixel and device depth of a view-space position, straight from the matrix.
glm::dvec3 project(const View& view, const glm::dvec3& position) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(position, 1.0);
  const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
  return {(ndc.x + 1.0) * 0.5 * view.width(), (ndc.y + 1.0) * 0.5 * view.height(), ndc.z};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance) << "got (" << a.x << ", " << a.y << ", " << a.z << ")";
}

TEST(View, PositionsSurviveTheRoundTrip) {
  for (const Projection& projection : projections()) {
    SCOPED_TRACE(projection.name);
    const View view = make_view(projection.clip_from_view, pose());
    for (const double z : {0.3, 1.0, 17.0, 250.0}) {
      for (const glm::dvec2 xy : {glm::dvec2(0.0), glm::dvec2(-0.2, 0.1), glm::dvec2(0.6, -0.5)}) {
        const glm::dvec3 position(xy * z, -z);
        const glm::dvec3 pixel = project(view, position);
        EXPECT_NEAR(view.z_view(pixel.z), z, 1e-9 * z * z);
        expect_near(view.view_position(glm::dvec2(pixel), z), position, 1e-9 * z);
      }
    }
  }
}

TEST(View, WorldPositionOfAPixelProjectsBackToItsCentre) {
  for (const Projection& projection : projections()) {
    SCOPED_TRACE(projection.name);
    const View view = make_view(projection.clip_from_view, pose());
    for (const double depth : {1.0, 0.5, 0.01}) {
      const glm::dvec4 world(glm::dvec3(view.world_position(300, 2, depth)), 1.0);
      expect_near(project(view, glm::dvec3(glm::dmat4(view.view_from_world()) * world)), {300.5, 2.5, depth}, 1e-6);
    }
  }
}

TEST(View, DepthIsOneAtTheNearPlaneAndZeroAtTheFarPlane) {
  for (const Projection& projection : projections()) {
    SCOPED_TRACE(projection.name);
    const View view = make_view(projection.clip_from_view);
    const double near_m = projection.name == "orthographic behind the eye" ? -50.0 : NEAR;
    EXPECT_NEAR(project(view, {0.0, 0.0, -near_m}).z, 1.0, 1e-6);
    EXPECT_NEAR(view.z_view(1.0), near_m, 1e-4);
    if (projection.far_m >= lamp::INFINITE_FAR) {
      EXPECT_EQ(project(view, {0.0, 0.0, -1e12}).z, NEAR / 1e12);
    } else {
      EXPECT_NEAR(project(view, {0.0, 0.0, -FAR}).z, 0.0, 1e-6);
    }
    EXPECT_GT(project(view, {0.0, 0.0, -1.0}).z, project(view, {0.0, 0.0, -2.0}).z);
  }
}

TEST(View, TheWindowsCornersAreThePicturesCorners) {
  const View view = make_view(lamp::perspective(OFF_CENTRE, NEAR, FAR));
  expect_near(view.view_position({0.0, 0.0}, 2.0), {2.0 * OFF_CENTRE.left, 2.0 * OFF_CENTRE.top, -2.0}, 1e-5);
  expect_near(view.view_position({WIDTH, HEIGHT}, 2.0), {2.0 * OFF_CENTRE.right, 2.0 * OFF_CENTRE.bottom, -2.0}, 1e-5);
  const View flat = make_view(lamp::orthographic(OFF_CENTRE, NEAR, FAR));
  expect_near(flat.view_position({0.0, 0.0}, 9.0), {OFF_CENTRE.left, OFF_CENTRE.top, -9.0}, 1e-5);
  expect_near(flat.view_position({WIDTH, HEIGHT}, 9.0), {OFF_CENTRE.right, OFF_CENTRE.bottom, -9.0}, 1e-5);
  EXPECT_TRUE(flat.orthographic());
  EXPECT_FALSE(view.orthographic());
}

TEST(View, SymmetricWindow) {
  const Window window = lamp::symmetric_window(1.5707963267948966, 2.0);
  EXPECT_NEAR(window.top, 1.0, 1e-12);
  EXPECT_NEAR(window.bottom, -1.0, 1e-12);
  EXPECT_NEAR(window.left, -2.0, 1e-12);
  EXPECT_NEAR(window.right, 2.0, 1e-12);
}

TEST(View, NumbersAreThirtyTwoBitValues) {
  const View view = make_view(lamp::perspective(lamp::symmetric_window(0.9, 1.7), 0.1, FAR), pose());
  for (const glm::dmat4 matrix : {view.clip_from_view(), view.view_from_world()}) {
    for (int i = 0; i < 16; ++i) {
      EXPECT_EQ(matrix[i / 4][i % 4], static_cast<double>(static_cast<float>(matrix[i / 4][i % 4])));
    }
  }
  const glm::dmat4 product = glm::dmat4(view.world_from_view()) * glm::dmat4(view.view_from_world());
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(product[i / 4][i % 4], i % 5 == 0 ? 1.0 : 0.0, 1e-12);
}

TEST(View, FrameHoldsTheView) {
  const View view = make_view(lamp::perspective(OFF_CENTRE, NEAR, FAR), pose());
  const lamp::shared::Frame frame = view.frame(77, 99);
  EXPECT_EQ(frame.light_count, 77U);
  EXPECT_EQ(frame.light_capacity, 99U);
  EXPECT_EQ(frame.size_px, glm::uvec2(WIDTH, HEIGHT));
  EXPECT_EQ(glm::dmat4(frame.clip_from_view), view.clip_from_view());
  EXPECT_EQ(glm::dmat4(frame.view_from_world), view.view_from_world());
  EXPECT_EQ(frame.world_from_view, glm::mat4(view.world_from_view()));
  expect_near(glm::dvec3(glm::dmat4(view.view_from_world()) * glm::dvec4(glm::vec3(frame.eye_world), 1.0)),
              glm::dvec3(0.0), 1e-5);
}

std::string refusal(const glm::dmat4& clip_from_view, const glm::dmat4& view_from_world) {
  const auto view = View::create(WIDTH, HEIGHT, clip_from_view, view_from_world);
  return view.ok() ? "accepted" : view.error().text();
}

TEST(View, StretchIsHowFarAMatrixIsFromRigid) {
  const auto stretch = [](const glm::dmat4& view_from_world) {
    const View view = make_view(lamp::perspective(OFF_CENTRE, NEAR, FAR), view_from_world);
    EXPECT_EQ(view.frame(0, 0).stretch, static_cast<float>(view.stretch()));
    return view.stretch();
  };
  const glm::dmat4 quarter_turn(glm::dvec4(0, 0, 1, 0), glm::dvec4(1, 0, 0, 0), glm::dvec4(0, -1, 0, 0),
                                glm::dvec4(5, 6, 7, 1));
  EXPECT_EQ(stretch(glm::dmat4(1.0)), 0.0);
  EXPECT_EQ(stretch(quarter_turn), 0.0);
  EXPECT_EQ(stretch(glm::scale(quarter_turn, glm::dvec3(-1.0, 1.0, 1.0))), 0.0) << "a mirror";
  EXPECT_LT(stretch(pose()), 3e-7) << "rounding of its numbers";
  for (const double scale : {1.000049, 0.99996}) {
    EXPECT_NEAR(stretch(glm::scale(quarter_turn, glm::dvec3(scale))), std::abs(scale - 1.0), 1e-7);
    EXPECT_NEAR(stretch(glm::scale(pose(), glm::dvec3(scale))), std::abs(scale - 1.0), 4e-7);
    EXPECT_NEAR(stretch(glm::scale(pose(), glm::dvec3(1.0, scale, 1.0))), std::abs(scale - 1.0), 4e-5);
  }
}

// What a bound is widened by must be as much as any length changes, and is never much more.
TEST(View, NoLengthChangesByMoreThanTheStretch) {
  std::mt19937 random(3);
  std::uniform_real_distribution unit(-1.0, 1.0);
  double largest = 0.0;
  for (int i = 0; i < 200; ++i) {
    glm::dmat4 near_one(1.0);
    for (int j = 0; j < 9; ++j) near_one[j / 3][j % 3] += 2.4e-5 * unit(random);
    const View view = make_view(lamp::perspective(OFF_CENTRE, NEAR, FAR), near_one * pose());
    for (int j = 0; j < 100; ++j) {
      const glm::dvec3 direction = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
      const double length = glm::length(glm::dmat3(view.view_from_world()) * direction);
      EXPECT_LE(std::abs(length - 1.0), view.stretch());
      largest = std::max(largest, std::abs(length - 1.0) / view.stretch());
    }
  }
  EXPECT_GT(largest, 0.6);
}

TEST(View, RefusesBadSizes) {
  const glm::dmat4 good = lamp::perspective(OFF_CENTRE, NEAR, FAR);
  EXPECT_FALSE(View::create(0, 5, good, pose()).ok());
  EXPECT_FALSE(View::create(5, 0, good, pose()).ok());
  EXPECT_TRUE(View::create(1, 1, good, pose()).ok());
}

TEST(View, RefusesNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), -1e39}) {
    for (int i = 0; i < 16; ++i) {
      glm::dmat4 projection = lamp::perspective(OFF_CENTRE, NEAR, FAR);
      projection[i / 4][i % 4] = bad;
      EXPECT_NE(refusal(projection, pose()).find("finite"), std::string::npos);
      glm::dmat4 moved = pose();
      moved[i / 4][i % 4] = bad;
      EXPECT_NE(refusal(lamp::perspective(OFF_CENTRE, NEAR, FAR), moved).find("finite"), std::string::npos);
    }
  }
}

TEST(View, AnInfiniteFarPlaneMayBeWrittenInTwoWays) {
  EXPECT_EQ(lamp::perspective(OFF_CENTRE, NEAR, std::numeric_limits<double>::infinity()),
            lamp::perspective(OFF_CENTRE, NEAR, lamp::INFINITE_FAR));
  EXPECT_EQ(lamp::perspective(OFF_CENTRE, NEAR, lamp::INFINITE_FAR)[2][2], 0.0);
}

// A minimised window's aspect is 0.
TEST(View, RefusesProjectionsOfWhatIsNoWindow) {
  const lamp::Window empty = lamp::symmetric_window(1.0, 0.0);
  for (const lamp::DMat4& projection : {lamp::perspective(empty, NEAR, FAR), lamp::perspective(OFF_CENTRE, 0.0, FAR),
                                        lamp::perspective(OFF_CENTRE, FAR, NEAR), lamp::orthographic(empty, NEAR, FAR),
                                        lamp::orthographic(OFF_CENTRE, NEAR, lamp::INFINITE_FAR)})
    EXPECT_NE(refusal(projection, pose()).find("finite"), std::string::npos);
}

TEST(View, RefusesShear) {
  for (const int i : {1, 2, 3, 4, 6, 7}) {
    glm::dmat4 projection = lamp::perspective(OFF_CENTRE, NEAR, FAR);
    projection[i / 4][i % 4] = 1e-3;
    EXPECT_NE(refusal(projection, pose()).find("shear"), std::string::npos) << i;
  }
}

TEST(View, RefusesSingularMatrices) {
  for (const int i : {0, 1}) {
    glm::dmat4 projection = lamp::perspective(OFF_CENTRE, NEAR, FAR);
    projection[i][i] = 0.0;
    EXPECT_NE(refusal(projection, pose()).find("singular"), std::string::npos);
  }
  glm::dmat4 projection = lamp::perspective(OFF_CENTRE, NEAR, lamp::INFINITE_FAR);
  projection[3][2] = 0.0;
  EXPECT_NE(refusal(projection, pose()).find("singular"), std::string::npos);
}

TEST(View, DepthMayRunEitherWay) {
  for (const glm::dmat4 reversed :
       {lamp::perspective(OFF_CENTRE, NEAR, FAR), lamp::perspective(OFF_CENTRE, NEAR, lamp::INFINITE_FAR),
        lamp::orthographic(OFF_CENTRE, NEAR, FAR)}) {
    const lamp::View one = lamp::View::create(64, 36, reversed, pose()).value();
    const lamp::View other = lamp::View::create(64, 36, lamp::flip_depth(reversed), pose()).value();
    EXPECT_TRUE(one.reversed_depth());
    EXPECT_EQ(one.sky_depth(), 0.0F);
    EXPECT_FALSE(other.reversed_depth());
    EXPECT_EQ(other.sky_depth(), 1.0F);
    EXPECT_EQ(std::bit_cast<float>(other.frame(0, 1).sky_bits), 1.0F);
    for (const double depth : {0.99, 0.5, 0.1}) EXPECT_NEAR(other.z_view(1.0 - depth) / one.z_view(depth), 1.0, 1e-5);
  }
  glm::dmat4 forward = lamp::perspective(OFF_CENTRE, NEAR, FAR);
  forward[2][2] = -FAR / (FAR - NEAR);
  forward[3][2] = -NEAR * FAR / (FAR - NEAR);
  EXPECT_NEAR(lamp::View::create(64, 36, forward, pose()).value().z_view(0.0), NEAR, 1e-6);
}

TEST(View, RefusesLookingAlongPlusZ) {
  EXPECT_NE(refusal(-glm::dmat4(lamp::perspective(OFF_CENTRE, NEAR, FAR)), pose()).find("-Z"), std::string::npos);
  EXPECT_NE(refusal(-glm::dmat4(lamp::orthographic(OFF_CENTRE, NEAR, FAR)), pose()).find("-Z"), std::string::npos);
}

TEST(View, RefusesWhatIsNotRigid) {
  const glm::dmat4 projection = lamp::perspective(OFF_CENTRE, NEAR, FAR);
  EXPECT_NE(refusal(projection, glm::scale(pose(), glm::dvec3(1.001, 1.0, 1.0))).find("rigid"), std::string::npos);
  glm::dmat4 sheared = pose();
  sheared[0] += 0.001 * sheared[1];
  EXPECT_NE(refusal(projection, sheared).find("rigid"), std::string::npos);
  glm::dmat4 projective = pose();
  projective[1][3] = 0.01;
  EXPECT_NE(refusal(projection, projective).find("[1][3]"), std::string::npos);
  EXPECT_EQ(refusal(projection, glm::scale(pose(), glm::dvec3(1.00001, 1.0, 1.0))), "accepted");
  EXPECT_EQ(refusal(projection, glm::scale(pose(), glm::dvec3(-1.0, 1.0, 1.0))), "accepted");
}

}  // namespace
