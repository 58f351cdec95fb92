// Lights: the check of what a user gave, and the packing for the GPU.
// Based on: Khronos, KHR_lights_punctual (units, cone).
// Promise: what passes `check_lights` packs without a NaN; derived numbers are computed in double and rounded once.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>

namespace lamp {
namespace {

// pi/2 as a 32-bit number lies a little above pi/2; it stands for a half-angle of exactly 90 degrees.
constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool at_least_zero(const glm::vec3& v) { return v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F; }

// False for a NaN.
bool within(float value, float low, float high) { return value >= low && value <= high; }

std::string show(float value) {
  std::ostringstream text;
  text << value;
  return text.str();
}
std::string show(const glm::vec3& value) {
  std::ostringstream text;
  text << '(' << value.x << ", " << value.y << ", " << value.z << ')';
  return text.str();
}

template <class T>
std::string expected(std::string_view what, const T& value) {
  return std::string(what) + ", got " + show(value);
}

// What is wrong with a light, or an empty text.
std::string fault(const Light& light) {
  if (light.type != LightType::point && light.type != LightType::spot) {
    return "type must be point or spot, got " + std::to_string(static_cast<std::uint32_t>(light.type));
  }
  if (!finite(light.position)) return expected("position must be finite", light.position);
  if (!(light.range >= 0.0F)) return expected("range must be >= 0 m", light.range);
  if (!finite(light.color) || !at_least_zero(light.color)) {
    return expected("color must be finite and >= 0", light.color);
  }
  if (!std::isfinite(light.intensity) || light.intensity < 0.0F) {
    return expected("intensity must be finite and >= 0 candela", light.intensity);
  }
  const glm::vec3 power = light.color * light.intensity;
  if (!finite(power)) return expected("color times intensity must fit 32 bits", power);
  if (light.type == LightType::point) return {};
  if (!finite(light.direction) || light.direction == glm::vec3(0.0F)) {
    return expected("direction must be finite and not 0", light.direction);
  }
  if (!within(light.outer_angle, 0.0F, RIGHT_ANGLE)) {
    return expected("outer angle must be 0 .. pi/2 radians", light.outer_angle);
  }
  if (!within(light.inner_angle, 0.0F, light.outer_angle)) {
    return expected("inner angle must be 0 .. outer angle (" + show(light.outer_angle) + ") radians",
                    light.inner_angle);
  }
  return {};
}

// Larger than any scene, and its square is still a finite float.
constexpr double INFINITE_RADIUS = 1e18;
constexpr shared::LightSphere REACHES_NOTHING{.center = glm::vec3(0.0F), .radius = -1e30F};

double cosine(float half_angle) { return half_angle >= RIGHT_ANGLE ? 0.0 : std::cos(static_cast<double>(half_angle)); }

}  // namespace

std::optional<Error> check_lights(std::span<const Light> lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::string message = fault(lights[i]);
    if (!message.empty()) return Error{"light " + std::to_string(i), std::move(message)};
  }
  return std::nullopt;
}

shared::Light pack(const Light& light) {
  shared::Light packed{};
  packed.position = light.position;
  packed.range = light.range;
  packed.intensity = light.color * light.intensity;
  packed.type = static_cast<std::uint32_t>(light.type);
  packed.direction = {0.0F, 0.0F, -1.0F};
  if (light.type == LightType::point) return packed;

  packed.direction = glm::vec3(glm::normalize(glm::dvec3(light.direction)));
  packed.outer_angle = light.outer_angle;
  packed.inner_angle = light.inner_angle;
  const double cos_outer = cosine(light.outer_angle);
  packed.cos_outer = static_cast<float>(cos_outer);
  packed.sin_outer = static_cast<float>(std::sin(double{light.outer_angle}));
  packed.spot_scale = static_cast<float>(1.0 / std::max(0.001, cosine(light.inner_angle) - cos_outer));
  return packed;
}

std::vector<shared::Light> pack(std::span<const Light> lights) {
  std::vector<shared::Light> packed;
  packed.reserve(lights.size());
  for (const Light& light : lights) packed.push_back(pack(light));
  return packed;
}

shared::LightSphere bounding_sphere(const shared::Light& light) {
  if (!(light.range > 0.0F)) return REACHES_NOTHING;
  glm::dvec3 center(light.position);
  double radius = std::min<double>(light.range, INFINITE_RADIUS);
  if (light.type == shared::LIGHT_SPOT) {
    if (light.outer_angle <= 0.0F) return REACHES_NOTHING;
    const double cos_outer = light.cos_outer;
    if (radius < INFINITE_RADIUS && cos_outer >= std::numbers::sqrt2 / 2.0) {
      radius /= 2.0 * cos_outer;  // through the apex and the rim of the cone
      center += glm::dvec3(light.direction) * radius;
    } else if (radius < INFINITE_RADIUS) {
      center += glm::dvec3(light.direction) * (radius * cos_outer);  // the rim is a great circle
      radius *= std::sqrt(1.0 - cos_outer * cos_outer);
    }
  }
  return {.center = glm::vec3(center), .radius = static_cast<float>(radius)};
}

std::vector<shared::LightSphere> bounding_spheres(std::span<const shared::Light> lights) {
  std::vector<shared::LightSphere> spheres;
  spheres.reserve(lights.size());
  for (const shared::Light& light : lights) spheres.push_back(bounding_sphere(light));
  return spheres;
}

}  // namespace lamp
