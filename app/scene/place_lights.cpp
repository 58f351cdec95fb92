// Generated lights: one random sequence a light, drawn in a fixed order, so that no light depends on another.
// Based on: uniform directions by Archimedes' cylinder; Lissajous paths; HSV hues.
// Promise: all of a light's path lies in open air; frame f and frame f + frames are the same.
// SPDX-License-Identifier: Apache-2.0
#include "scene/place_lights.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.h"
#include "scene/procedural_random.h"

namespace lamp::app {
namespace {

using procedural::Random;

constexpr double OVERLAP = 24.0;       // lights whose range holds a point of open air, with automatic ranges
constexpr float AUTOMATIC_MIN = 0.6F;  // of the mean range; the mean of the cubes is then 0.995
constexpr float AUTOMATIC_MAX = 1.4F;
constexpr float WARM_WHITES = 0.2F;  // part of the lights that have no hue
constexpr float DOWNWARDS = 0.7F;    // added to a spot's unit direction: most look down, some sideways, few up
constexpr float DEGREE = std::numbers::pi_v<float> / 180.0F;
constexpr double TURN = 2.0 * std::numbers::pi;

/// What ranges are drawn from: between `min` and `max`, uniform in their logarithm, or with so many fewer large ones
/// that the part of the lights whose range is above r falls as r^-power (Pareto's law, cut at `max`).
struct Ranges {
  float min = 0.0F;
  float max = 0.0F;
  double power = 0.0;
  float spot_reach = 1.0F;
};

// Ranges from max / ratio to max, of which about LARGE lie above half of max, and as many overlap as everywhere.
Ranges wide_ranges(double sphere_m3, double count, float ratio) {
  constexpr double LARGE = 8.0;
  const double power = std::clamp(std::log(count / LARGE) / std::log(0.5 * ratio), 0.05, 2.0);
  const double mean_cube = power / (3.0 - power) * (std::pow(ratio, 3.0 - power) - 1.0) /
                           (1.0 - std::pow(ratio, -power));  // over the smallest range's
  const double smallest = std::cbrt(sphere_m3 / mean_cube);
  return {.min = static_cast<float>(smallest), .max = static_cast<float>(smallest * ratio), .power = power};
}

bool without_range(const PlaceLights& how) { return std::isinf(how.min_range) && std::isinf(how.max_range); }

Ranges ranges_of(const OpenAir& air, const PlaceLights& how) {
  const bool given = how.min_range != 0.0F || how.max_range != 0.0F;
  if (given && !without_range(how)) return {.min = how.min_range, .max = how.max_range};
  const LightPlacement& placement = air.placement;
  const double count = std::max(how.count, 1U);
  const double cube = 3.0 * OVERLAP * air.volume() / count / (4.0 * std::numbers::pi);  // of the range
  const double range = std::cbrt(cube);
  float largest = std::max(air.diagonal_m, air.cell_m);
  if (placement.max_range > 0.0F) largest = std::min(largest, placement.max_range);
  Ranges ranges{.min = static_cast<float>(AUTOMATIC_MIN * range), .max = static_cast<float>(AUTOMATIC_MAX * range)};
  if (placement.range_ratio > 0.0F) {
    ranges = wide_ranges(cube, count, placement.range_ratio);
    ranges.min = std::min(ranges.min, largest / placement.range_ratio);  // the ratio stays where the scene is too small
  }
  return {.min = std::min(ranges.min, largest),
          .max = std::min(ranges.max, largest),
          .power = ranges.power,
          .spot_reach = placement.spot_reach};
}

float draw_range(Random& random, const Ranges& ranges) {
  const float share = random.unit();
  const float ratio = ranges.max / ranges.min;
  float times_min = std::pow(ratio, share);
  if (ranges.power > 0.0) {  // in 64 bits: what counts are the shares near 1
    times_min =
        static_cast<float>(std::pow(1.0 - share * (1.0 - std::pow(double{ratio}, -ranges.power)), -1.0 / ranges.power));
  }
  return std::clamp(ranges.min * times_min, ranges.min, ranges.max);
}

void check(const PlaceLights& how) {
  const bool is_fraction = how.spots >= 0.0F && how.spots <= 1.0F;  // false for a NaN
  if (!is_fraction) {
    throw Error(fmt::format("spots: the fraction must lie in 0 .. 1, got {}", how.spots));
  }
  const bool is_part = how.still >= 0.0F && how.still <= 1.0F;
  if (!is_part) throw Error(fmt::format("still: the fraction must lie in 0 .. 1, got {}", how.still));
  const bool automatic = how.min_range == 0.0F && how.max_range == 0.0F;
  const bool is_range = how.min_range > 0.0F && how.min_range <= how.max_range && std::isfinite(how.max_range);
  const bool none = without_range(how) && how.min_range > 0.0F;
  if (!automatic && !none && !is_range) {
    throw Error(fmt::format("range: expected 0 < min <= max, both finite or both infinite, got {}:{}", how.min_range,
                            how.max_range));
  }
  if (how.frames == 0) throw Error("frames: a path must have at least 1 frame, got 0");
}

// A seed for light i that shares no pattern with its neighbours' (Steele et al., SplitMix, OOPSLA 2014).
std::uint64_t seed_of(std::uint64_t seed, std::uint32_t i) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL + i + 1;
  h = (h ^ (h >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27U)) * 0x94D049BB133111EBULL;
  return h ^ (h >> 31U);
}

glm::vec3 draw_color(Random& random) {
  const float hue = 6.0F * random.unit();
  const float saturation = random.between(0.35F, 0.9F);
  const bool warm_white = random.chance(WARM_WHITES);
  if (warm_white) return {1.0F, 0.78F, 0.5F};
  const auto channel = [&](float shift) {
    const float k = std::fmod(hue + shift, 6.0F);
    return 1.0F - saturation * std::clamp(std::min(k, 4.0F - k), 0.0F, 1.0F);
  };
  return {channel(5.0F), channel(3.0F), channel(1.0F)};
}

glm::vec3 draw_direction(Random& random) {
  const double y = 2.0 * random.unit() - 1.0;
  const double angle = TURN * random.unit();
  const double side = std::sqrt(1.0 - y * y);
  return glm::normalize(glm::vec3(side * std::cos(angle), y - DOWNWARDS, side * std::sin(angle)));
}

LightPath draw_path(Random& random, const OpenAir& air, float range) {
  const AirCell& cell = air.cells[random.below(static_cast<std::uint32_t>(air.cells.size()))];
  LightPath path;
  for (int axis = 0; axis < 3; ++axis) {
    // In cells: the path's middle inside its cell, and how far from it, along this axis, there is only air.
    const float middle = random.between(0.01F, 0.99F);
    const float room = std::min(middle, 1.0F - middle) + static_cast<float>(cell.clearance - 1);
    path.amplitude[axis] = std::min(0.5F * range, 0.98F * room * air.cell_m);
    set_phase(path, axis, random.unit());
    path.waves[axis] = 1 + random.below(MOST_PATH_WAVES);
    path.middle[axis] = cell.min[axis] + middle * air.cell_m;
  }
  return path;
}

struct PlacedLight {
  Light light;
  LightPath path;
};

PlacedLight make_light(const OpenAir& air, const PlaceLights& how, const Ranges& ranges, std::uint32_t i,
                       const PathTime& time) {
  Random random(seed_of(how.seed, i));
  PlacedLight made;
  Light& light = made.light;
  light.range = draw_range(random, ranges);
  made.path = draw_path(random, air, light.range);
  if (i >= how.count - still_count(how)) made.path = resting_at(position_at(made.path, {}));
  light.position = position_at(made.path, time);
  light.color = draw_color(random);
  light.direction = draw_direction(random);
  light.outer_angle = random.between(15.0F, 45.0F) * DEGREE;
  if (air.placement.spot_angle > 0.0F) light.outer_angle = air.placement.spot_angle;
  light.inner_angle = light.outer_angle * random.between(0.6F, 0.9F);
  light.type = random.chance(how.spots) ? LightType::spot : LightType::point;
  if (light.type == LightType::spot) light.range *= ranges.spot_reach;
  // About 9 lux at a third of the range, whatever the range.
  light.intensity = std::min(light.range * light.range, LARGEST_INTENSITY);
  if (without_range(how)) light.range = std::numeric_limits<float>::infinity();
  return made;
}

}  // namespace

std::uint32_t still_count(const PlaceLights& how) {
  return static_cast<std::uint32_t>(std::lround(double{how.still} * how.count));
}

std::vector<Light> place_lights(const OpenAir& air, const PlaceLights& how) {
  check(how);
  const Ranges ranges = ranges_of(air, how);
  const PathTime time = path_time(how.frame, how.frames);
  std::vector<Light> lights(how.count);
  tbb::parallel_for(std::uint32_t{0}, how.count,
                    [&](std::uint32_t i) { lights[i] = make_light(air, how, ranges, i, time).light; });
  return lights;
}

PlacedLights place_on_paths(const OpenAir& air, const PlaceLights& how) {
  check(how);
  const Ranges ranges = ranges_of(air, how);
  const PathTime time = path_time(how.frame, how.frames);
  PlacedLights placed{.lights = std::vector<Light>(how.count), .paths = std::vector<LightPath>(how.count)};
  tbb::parallel_for(std::uint32_t{0}, how.count, [&](std::uint32_t i) {
    const PlacedLight made = make_light(air, how, ranges, i, time);
    placed.lights[i] = made.light;
    placed.paths[i] = made.path;
  });
  return placed;
}

std::vector<Light> place_lights(const Scene& scene, const PlaceLights& how) {
  check(how);
  return how.count == 0 ? std::vector<Light>{} : place_lights(find_open_air(scene), how);
}

}  // namespace lamp::app
