// Boxes among the lights: ids, checks, spheres that enclose them, and the oracle's answers for them.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/entity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "oracle/reference.h"
#include "random.h"

namespace {

using lamp::Reach;
using lamp::shared::OrientedBox;

/// Sizes of all orders of magnitude.
float size(lamp::test::Random& random, float low, float high) {
  return std::exp(random.in(std::log(low), std::log(high)));
}

OrientedBox oriented(const glm::vec3& center, const glm::quat& turn, const glm::vec3& half) {
  const glm::mat3 axes = glm::mat3_cast(glm::normalize(turn));
  return {.center = center, .axis_x = axes[0], .axis_y = axes[1], .axis_z = axes[2], .half_extents = half};
}

OrientedBox random_box(lamp::test::Random& random) {
  const glm::quat turn(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
  return oriented(random.vector(50.0F), turn,
                  {size(random, 0.01F, 20.0F), size(random, 0.01F, 20.0F), size(random, 0.01F, 20.0F)});
}

TEST(Entities, LightsFirstThenBoxes) {
  const lamp::EntityRanges ids = lamp::entity_ranges(7, 3);
  EXPECT_EQ(ids.lights.first, 0U);
  EXPECT_EQ(ids.lights.end, 7U);
  EXPECT_EQ(ids.boxes.first, 7U);
  EXPECT_EQ(ids.boxes.end, 10U);
  EXPECT_EQ(ids.boxes.count(), 3U);

  lamp::test::Random random(1);
  const std::vector<lamp::shared::Light> lights(2, lamp::shared::Light{.range = 5.0F});
  const std::vector<OrientedBox> boxes{random_box(random)};
  const std::vector<lamp::shared::Light> records = lamp::entity_records(lights, boxes);
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].range, 5.0F);
  EXPECT_EQ(records[2].position, boxes[0].center);
  EXPECT_EQ(records[2].type, lamp::shared::LIGHT_POINT);
  EXPECT_EQ(records[2].intensity, glm::vec3(0.0F)) << "a box gives no light";
}

// 200 000 random boxes: no corner, and no position inside, lies outside the sphere that stands for the box; and the
// sphere is no larger than it must be.
TEST(Entities, TheSphereEnclosesTheBox) {
  lamp::test::Random random(20240611);
  for (int round = 0; round < 200000; ++round) {
    const OrientedBox box = random_box(random);
    const lamp::shared::Light record = lamp::bounding_light(box);
    const glm::dvec3 half(box.half_extents);
    ASSERT_LE(record.range, glm::length(half) * 1.001);
    for (int corner = 0; corner < 9; ++corner) {
      const glm::dvec3 sign = corner == 8 ? glm::dvec3(random.vector(0.99F))
                                          : glm::dvec3(corner % 2 * 2 - 1, corner / 2 % 2 * 2 - 1, corner / 4 * 2 - 1);
      const glm::dvec3 position = glm::dvec3(box.center) + sign.x * half.x * glm::dvec3(box.axis_x) +
                                  sign.y * half.y * glm::dvec3(box.axis_y) + sign.z * half.z * glm::dvec3(box.axis_z);
      ASSERT_EQ(lamp::reach(record, position), Reach::inside) << "round " << round;
      // Corners are where the axes' 32-bit rounding puts them, for plates a little outside.
      if (corner == 8) {
        ASSERT_EQ(lamp::reach(box, position), Reach::inside) << "round " << round;
      }
    }
  }
}

// What the record tells of the shape encloses the box or the ellipsoid, also of axes that are mirrored or as far from
// right angles as is taken, and hardly more.
TEST(Entities, TheRecordTellsTheShape) {
  lamp::test::Random random(20261126);
  for (int round = 0; round < 100000; ++round) {
    OrientedBox box = random_box(random);
    if (round % 3 == 0) box.axis_z = -glm::vec3(box.axis_z);
    if (round % 4 == 0) box.axis_x = glm::vec3(box.axis_x) + random.vector(3e-5F);
    const bool ball = round % 2 == 0;
    const lamp::shared::Light record =
        lamp::bounding_light(box, ball ? lamp::EntityShape::ellipsoid : lamp::EntityShape::box);
    ASSERT_EQ(record.sin_outer, ball ? lamp::shared::SHAPE_ELLIPSOID : lamp::shared::SHAPE_BOX);
    const glm::vec3 turn = record.direction;
    const glm::dmat3 axes = glm::mat3_cast(glm::dquat(record.outer_angle, turn.x, turn.y, turn.z));
    const glm::dvec3 half(record.inner_angle, record.cos_outer, record.spot_scale);
    const glm::dvec3 given(glm::vec3(box.half_extents));
    const double largest = std::max({given.x, given.y, given.z});
    const double thinnest = std::min({given.x, given.y, given.z});
    for (int i = 0; i < 3; ++i)
      ASSERT_LE(half[i], given[i] + 2e-4 * largest * (ball ? given[i] / thinnest : 1.0)) << round;
    const glm::dvec3 unit = ball ? glm::normalize(glm::dvec3(random.vector(1.0F)) + 1e-3)
                                 : glm::dvec3(round & 8 ? 1 : -1, round & 16 ? 1 : -1, round & 32 ? 1 : -1);
    // On the surface: where each |axis . p| is the half extent's.
    const glm::dmat3 rows = glm::transpose(glm::dmat3(
        glm::dvec3(glm::vec3(box.axis_x)), glm::dvec3(glm::vec3(box.axis_y)), glm::dvec3(glm::vec3(box.axis_z))));
    const glm::dvec3 local = (glm::inverse(rows) * (unit * given)) * axes / half;
    const glm::dvec3 away = glm::abs(local);
    ASSERT_LE(ball ? glm::length(local) : std::max({away.x, away.y, away.z}), 1.0) << round;
  }
}

TEST(Entities, BoxesAreChecked) {
  lamp::test::Random random(3);
  const OrientedBox good = random_box(random);
  const auto message = [&](const OrientedBox& bad) {
    const auto error = lamp::check_boxes(std::vector{good, bad});
    return error ? error->text() : std::string();
  };
  EXPECT_EQ(message(good), "");
  OrientedBox flat = good;
  flat.half_extents.z = 0.0F;
  EXPECT_NE(message(flat).find("box 1"), std::string::npos);
  EXPECT_NE(message(flat).find("half extents"), std::string::npos);
  OrientedBox nowhere = good;
  nowhere.center.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(message(nowhere).find("center"), std::string::npos);
  OrientedBox sheared = good;
  sheared.axis_x = glm::normalize(glm::vec3(good.axis_x) + 0.1F * glm::vec3(good.axis_y));
  EXPECT_NE(message(sheared).find("axes"), std::string::npos);
  OrientedBox stretched = good;
  stretched.axis_z = 1.01F * glm::vec3(good.axis_z);
  EXPECT_NE(message(stretched).find("axes"), std::string::npos);
}

TEST(Reach, BoxAlongEachOfItsAxes) {
  const OrientedBox box = oriented({1.0F, 2.0F, 3.0F}, {0.9F, 0.1F, -0.3F, 0.2F}, {4.0F, 0.5F, 0.02F});
  const glm::vec3 axes[] = {box.axis_x, box.axis_y, box.axis_z};
  const glm::dvec3 half_extents = box.half_extents;
  for (int i = 0; i < 3; ++i) {
    for (const double side : {-1.0, 1.0}) {
      const auto ask = [&](double share) {
        return lamp::reach(box, glm::dvec3(box.center) + side * share * half_extents[i] * glm::dvec3(axes[i]));
      };
      EXPECT_EQ(ask(0.0), Reach::inside);
      EXPECT_EQ(ask(0.9999), Reach::inside);
      EXPECT_EQ(ask(1.0 - 2e-6), Reach::boundary);
      EXPECT_EQ(ask(1.0 + 2e-6), Reach::boundary);
      EXPECT_EQ(ask(1.0001), Reach::outside);
    }
  }
}

// Lights and boxes in one question, and boxes alone with ids of their own, by both oracles.
TEST(Truth, BoxesFollowTheLights) {
  lamp::test::Random random(11);
  const glm::dmat4 pose = glm::lookAt(glm::dvec3(2.0, 3.0, 9.0), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
  const lamp::View view =
      lamp::View::create(90, 70, lamp::perspective(lamp::symmetric_window(1.1, 1.5), 0.05, lamp::INFINITE_FAR), pose)
          .value();
  std::vector<float> depth(std::size_t{90} * 70);
  for (float& d : depth) d = random.in(0.0F, 1.0F) < 0.1F ? 0.0F : 0.05F / random.in(4.0F, 12.0F);
  std::vector<lamp::Light> lights(40);
  for (lamp::Light& light : lights) light = {.position = random.vector(6.0F), .range = random.in(0.5F, 4.0F)};
  const std::vector<lamp::shared::Light> packed = lamp::pack(lights);
  std::vector<OrientedBox> boxes(60);
  for (OrientedBox& box : boxes) {
    box = random_box(random);
    box.center = random.vector(5.0F);
    box.half_extents = glm::min(glm::vec3(box.half_extents) + 0.3F, 4.0F);
  }
  const lamp::TruthQuery both{.view = view, .depth = depth, .lights = packed, .rows = 70, .boxes = boxes};
  const lamp::Truth slow = lamp::brute_force_truth(both);
  const lamp::Truth fast = lamp::truth(both);
  EXPECT_EQ(fast.offsets, slow.offsets);
  EXPECT_EQ(fast.lights, slow.lights);
  EXPECT_EQ(fast.boundary_pairs, slow.boundary_pairs);

  lamp::TruthQuery alone = both;
  alone.lights = {};
  alone.first_id = 40;
  const lamp::Truth of_boxes = lamp::truth(alone);
  EXPECT_EQ(of_boxes.lights, lamp::brute_force_truth(alone).lights);
  std::vector<std::uint32_t> expected;
  for (const std::uint32_t id : slow.lights)
    if (id >= 40) expected.push_back(id);
  EXPECT_EQ(of_boxes.lights, expected);
  EXPECT_GT(expected.size(), 1000U);
  EXPECT_GT(slow.lights.size(), expected.size());
}

}  // namespace
