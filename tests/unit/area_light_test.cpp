// Lights around area lights: random points that a surface reaches are inside, and hardly any sphere is smaller.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/area_light.h"

#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "random.h"

namespace {

using lamp::DiscLight;
using lamp::Faces;
using lamp::Light;
using lamp::LightType;
using lamp::RectangleLight;
using lamp::TubeLight;

constexpr float INFINITE = std::numeric_limits<float>::infinity();

using lamp::test::RandomDoubles;

/// At most `most` away from the origin: one axis in three lies at 0.
glm::vec3 position(RandomDoubles& random, double most) {
  const double away = random.in(0.0, most);
  return glm::vec3(away * random.direction());
}

/// Whether the light reaches a point, by the contract of a result; nearly on its border counts as inside.
bool reaches(const Light& light, const glm::dvec3& point) {
  const lamp::shared::Light packed = lamp::pack(light);
  const glm::dvec3 offset = point - glm::dvec3(packed.position);
  if (!(glm::length(offset) <= double{packed.range})) return false;
  return packed.type != lamp::shared::LIGHT_SPOT ||
         glm::dot(offset, glm::dvec3(packed.direction)) >= double{packed.cos_outer} * glm::length(offset);
}

/// And whether its bounding sphere holds the point: no culling may lose it.
void expect_inside(const Light& light, const glm::dvec3& point) {
  ASSERT_TRUE(reaches(light, point)) << point.x << ' ' << point.y << ' ' << point.z;
  const lamp::shared::LightSphere sphere = lamp::bounding_sphere(lamp::pack(light));
  ASSERT_LE(glm::length(point - glm::dvec3(sphere.center)), double{sphere.radius} * (1.0 + 4e-6));
}

/// Half its sides, that are not at right angles.
TEST(AreaLights, ASkewedRectanglesFarCornersAreInside) {
  for (const float sign : {1.0F, -1.0F}) {
    const RectangleLight skewed{.half_x = {1, 0, 0}, .half_y = {sign * 0.9F, 0.1F, 0}, .faces = Faces::both};
    const Light light = lamp::bounding_light(skewed, 0.5F);
    EXPECT_GE(light.range, 0.5F + 1.9F);
    EXPECT_LT(light.range, 0.5F + 1.91F);
  }
}

/// Points within the range of a point of the surface, on the side of the normal if the front alone shines: (0, 0, 0)
/// for both. `farthest`: of all that is reached.
void expect_reached(const Light& light, const std::function<glm::dvec3()>& surface, const glm::dvec3& normal,
                    double range, double farthest, RandomDoubles& random) {
  for (int i = 0; i < 200; ++i) {
    glm::dvec3 way = random.direction();
    if (glm::dot(way, normal) < 0.0) way = -way;
    if (i % 4 == 2) way = glm::normalize(way - glm::dot(way, normal) * normal);  // of a front: along the surface
    const double distance = i % 2 == 0 ? range : random.in(0.0, range);
    expect_inside(light, surface() + distance * (1.0 - 1e-12) * way);
  }
  EXPECT_GE(double{light.range}, farthest);
  EXPECT_LE(double{light.range}, farthest * (1.0 + 1e-5) + 1e-5 * glm::length(glm::dvec3(light.position)));
}

TEST(AreaLights, RectanglesReachWhatTheirLightsReach) {
  RandomDoubles random(7);
  for (int round = 0; round < 100; ++round) {
    const glm::dvec3 x = random.in(0.0, 3.0) * random.direction();
    const glm::dvec3 y = random.in(0.1, 3.0) * glm::normalize(glm::cross(x, random.direction()));
    const RectangleLight shape{.center = position(random, round % 2 == 0 ? 10.0 : 1e4),
                               .half_x = glm::vec3(x),
                               .half_y = glm::vec3(y),
                               .faces = round % 3 == 0 ? Faces::both : Faces::front};
    const auto range = static_cast<float>(random.in(0.01, 20.0));
    const glm::dvec3 half_x(shape.half_x);
    const glm::dvec3 half_y(shape.half_y);
    const auto surface = [&] {
      const double u = random.in(-1.0, 1.0);
      const double v = random.in(-1.0, 1.0);
      // Half of them in a corner.
      return glm::dvec3(shape.center) + (random.in(0.0, 1.0) < 0.5
                                             ? std::copysign(1.0, u) * half_x + std::copysign(1.0, v) * half_y
                                             : u * half_x + v * half_y);
    };
    const glm::dvec3 normal = shape.faces == Faces::both ? glm::dvec3(0.0) : glm::normalize(glm::cross(half_x, half_y));
    const double corner = std::max(glm::length(half_x + half_y), glm::length(half_x - half_y));
    const Light light = lamp::bounding_light(shape, range);
    EXPECT_EQ(light.type, shape.faces == Faces::both ? LightType::point : LightType::spot);
    expect_reached(light, surface, normal, range, corner + range, random);
    EXPECT_FALSE(lamp::check_lights(std::span(&light, 1)));
  }
}

TEST(AreaLights, DiscsReachWhatTheirLightsReach) {
  RandomDoubles random(7);
  for (int round = 0; round < 100; ++round) {
    const DiscLight shape{.center = position(random, round % 2 == 0 ? 10.0 : 1e4),
                          .normal = glm::vec3(random.in(0.1, 5.0) * random.direction()),
                          .radius = static_cast<float>(random.in(0.0, 3.0)),
                          .faces = round % 3 == 0 ? Faces::both : Faces::front};
    const auto range = static_cast<float>(random.in(0.01, 20.0));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(shape.normal));
    const auto surface = [&] {
      const glm::dvec3 way = glm::normalize(glm::cross(normal, random.direction()));
      return glm::dvec3(shape.center) +
             double{shape.radius} * (random.in(0.0, 1.0) < 0.5 ? 1.0 : random.in(0.0, 1.0)) * way;
    };
    const Light light = lamp::bounding_light(shape, range);
    expect_reached(light, surface, shape.faces == Faces::both ? glm::dvec3(0.0) : normal, range,
                   double{shape.radius} + range, random);
  }
}

TEST(AreaLights, TubesReachWhatTheirLightsReach) {
  RandomDoubles random(7);
  for (int round = 0; round < 100; ++round) {
    const glm::vec3 from = position(random, round % 2 == 0 ? 10.0 : 1e4);
    const TubeLight shape{.from = from,
                          .to = from + position(random, 5.0),
                          .radius = round % 4 == 0 ? 0.0F : static_cast<float>(random.in(0.0, 0.5))};
    const auto range = static_cast<float>(random.in(0.01, 20.0));
    const glm::dvec3 axis = glm::dvec3(shape.to) - glm::dvec3(shape.from);
    // Ends are half balls: with the radius added in every direction, points of the axis are all it takes.
    const auto surface = [&] {
      const double u = random.in(-0.5, 1.5);
      return glm::dvec3(shape.from) + std::clamp(u, 0.0, 1.0) * axis + double{shape.radius} * random.direction();
    };
    const Light light = lamp::bounding_light(shape, range);
    EXPECT_EQ(light.type, LightType::point);
    expect_reached(light, surface, glm::dvec3(0.0), range, glm::length(axis) / 2.0 + double{shape.radius} + range,
                   random);
    expect_inside(light, glm::dvec3(shape.to) + (double{range} + double{shape.radius}) * (1.0 - 1e-12) *
                                                    (glm::length(axis) > 0.0 ? glm::normalize(axis) : axis));
  }
}

TEST(AreaLights, OfNoOrOfInfiniteRange) {
  for (const Faces faces : {Faces::both, Faces::front}) {
    const Light rectangle[] = {lamp::bounding_light(RectangleLight{.faces = faces}, 0.0F),
                               lamp::bounding_light(DiscLight{.faces = faces}, 0.0F),
                               lamp::bounding_light(TubeLight{}, 0.0F)};
    for (const Light& light : rectangle) {
      EXPECT_EQ(light.range, 0.0F);
      EXPECT_LT(lamp::bounding_sphere(lamp::pack(light)).radius, 0.0F);
    }
    const Light everywhere = lamp::bounding_light(DiscLight{.faces = faces}, INFINITE);
    EXPECT_EQ(everywhere.range, INFINITE);
    EXPECT_EQ(everywhere.position, glm::vec3(0.0F));
    EXPECT_FALSE(lamp::check_lights(std::span(&everywhere, 1)));
  }
}

TEST(AreaLights, WhatIsWrongIsWrongWithTheLight) {
  const auto error = [](const Light& light) {
    const auto found = lamp::check_lights(std::span(&light, 1));
    return found ? found->text() : "nothing";
  };
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(error(lamp::bounding_light(DiscLight{}, -1.0F)), "light 0: range must be >= 0 m, got -1");
  EXPECT_NE(error(lamp::bounding_light(DiscLight{}, not_a_number)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(DiscLight{.radius = -1.0F}, 5.0F)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(DiscLight{.radius = not_a_number}, 5.0F)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(TubeLight{.radius = -0.1F}, 5.0F)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(RectangleLight{.half_x = {not_a_number, 0.0F, 0.0F}}, 5.0F)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(RectangleLight{.center = {INFINITE, 0.0F, 0.0F}}, 5.0F)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(DiscLight{.normal = glm::vec3(0.0F), .faces = Faces::front}, 5.0F)), "nothing");
  EXPECT_NE(error(lamp::bounding_light(RectangleLight{.half_x = glm::vec3(0.0F), .faces = Faces::front}, 5.0F)),
            "nothing");
}

}  // namespace
