// Lights: the check of what a user gave, and the packing for the GPU.
// Based on: Khronos, KHR_lights_punctual (units, cone).
// Promise: what passes `check_lights` packs without a NaN; derived numbers of a packed light are computed in double and
// rounded once.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>

#include "is_finite.h"
#include "light_faults.h"

namespace lamp {
namespace {

// pi/2 as a 32-bit number lies a little above pi/2; it stands for a half-angle of exactly 90 degrees.
constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;

bool at_least_zero(const Vec3& v) { return v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F; }

// False for a NaN.
bool within(float value, float low, float high) { return value >= low && value <= high; }

std::string show(float value) {
  std::ostringstream text;
  text << value;
  return text.str();
}
std::string show(const Vec3& value) {
  std::ostringstream text;
  text << '(' << value.x << ", " << value.y << ", " << value.z << ')';
  return text.str();
}

std::string fault_of_inner(float inner, float outer) {
  if (within(inner, 0.0F, outer)) return {};
  return expected("inner angle must be 0 .. outer angle (" + show(outer) + ") radians", inner);
}

// What is wrong with a light, or an empty text.
std::string fault(const Light& light) {
  if (light.type != LightType::point && light.type != LightType::spot) {
    return "type must be point or spot, got " + std::to_string(static_cast<std::uint32_t>(light.type));
  }
  if (!is_finite(light.position)) return expected("position must be finite", light.position);
  if (!(light.range >= 0.0F)) return expected("range must be >= 0 m", light.range);
  if (!is_finite(light.color) || !at_least_zero(light.color)) {
    return expected("color must be finite and >= 0", light.color);
  }
  if (!std::isfinite(light.intensity) || light.intensity < 0.0F) {
    return expected("intensity must be finite and >= 0 candela", light.intensity);
  }
  const glm::vec3 power = glm::vec3(light.color) * light.intensity;
  if (!is_finite(power)) return expected("color times intensity must fit 32 bits", power);
  if (light.type == LightType::point) return {};
  if (!is_finite(light.direction) || light.direction == Vec3{}) {
    return expected("direction must be finite and not 0", light.direction);
  }
  if (!within(light.outer_angle, 0.0F, RIGHT_ANGLE)) {
    return expected("outer angle must be 0 .. pi/2 radians", light.outer_angle);
  }
  return fault_of_inner(light.inner_angle, light.outer_angle);
}

constexpr shared::LightSphere NO_SPHERE{.center = {}, .radius = shared::REACHES_NOTHING};
constexpr float COS_45 = 0.70710678F;

/// `value` or `other`, without a branch: points and spots come in no order that a processor could foresee.
float choose(bool first, float value, float other) {
  const std::uint32_t mask = -static_cast<std::uint32_t>(first);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) & mask) |
                              (std::bit_cast<std::uint32_t>(other) & ~mask));
}

double cosine(float half_angle) { return half_angle >= RIGHT_ANGLE ? 0.0 : std::cos(static_cast<double>(half_angle)); }

}  // namespace

std::string expected(std::string_view what, float value) { return std::string(what) + ", got " + show(value); }
std::string expected(std::string_view what, const Vec3& value) { return std::string(what) + ", got " + show(value); }

std::string fault_of_packed(const shared::Light& light) {
  if (light.type != shared::LIGHT_POINT && light.type != shared::LIGHT_SPOT)
    return "type must be LIGHT_POINT or LIGHT_SPOT, got " + std::to_string(light.type);
  if (!is_finite(Vec3(light.position))) return expected("position must be finite", Vec3(light.position));
  if (!(light.range >= 0.0F)) return expected("range must be >= 0 m", light.range);
  if (!is_finite(light.intensity) || !at_least_zero(light.intensity))
    return expected("intensity must be finite and >= 0 candela", light.intensity);
  if (light.type == shared::LIGHT_POINT) return {};
  const Vec3 direction = light.direction;
  const float length = direction.x * direction.x + direction.y * direction.y + direction.z * direction.z;
  if (!(std::abs(length - 1.0F) < 1e-3F)) return expected("direction must have a length of 1", direction);
  if (!within(light.outer_angle, 0.0F, RIGHT_ANGLE))
    return expected("outer angle must be 0 .. pi/2 radians", light.outer_angle);
  const double cosine_error = std::abs(double{light.cos_outer} - cosine(light.outer_angle));
  const double sine_error = std::abs(double{light.sin_outer} - std::sin(double{light.outer_angle}));
  if (!(cosine_error < 1e-3)) return expected("cos_outer must be the cosine of outer_angle", light.cos_outer);
  if (!(sine_error < 1e-3)) return expected("sin_outer must be the sine of outer_angle", light.sin_outer);
  return fault_of_inner(light.inner_angle, light.outer_angle);
}

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
  packed.intensity = glm::vec3(light.color) * light.intensity;
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

shared::LightReach light_reach(const shared::Light& light) { return {light.position, light.range}; }

shared::LightCone light_cone(const shared::Light& light) {
  return {light.direction, light.type == shared::LIGHT_SPOT ? light.outer_angle : -1.0F};
}

/// A narrow cone's goes through the apex and the rim, a wide one's has the rim as a great circle: `shift` to the centre
/// and the radius are the lesser and the greater of both, and a point light is the widest. What reaches everything does
/// so around the origin, where scenes are, wherever the light may be.
shared::LightSphere bounding_sphere(const shared::Light& light) {
  const bool spot = light.type == shared::LIGHT_SPOT;
  const bool dark = !(light.range > 0.0F);
  if (dark | (spot & (light.outer_angle <= 0.0F))) return NO_SPHERE;
  const bool everywhere = light.range >= shared::INFINITE_RADIUS;
  const float range = std::min(light.range, shared::INFINITE_RADIUS);
  const bool cone = spot & !everywhere;
  const float cosine = choose(cone, light.cos_outer, 0.0F);
  const float sine = choose(cone, light.sin_outer, 1.0F);
  const float shift = std::min(range * cosine, range / (2.0F * std::max(cosine, COS_45)));
  const glm::vec3 direction(choose(cone, light.direction.x, 0.0F), choose(cone, light.direction.y, 0.0F),
                            choose(cone, light.direction.z, 0.0F));
  const glm::vec3 position(choose(everywhere, 0.0F, light.position.x), choose(everywhere, 0.0F, light.position.y),
                           choose(everywhere, 0.0F, light.position.z));
  return {.center = position + shift * direction, .radius = std::max(range * sine, shift)};
}

std::vector<shared::LightSphere> bounding_spheres(std::span<const shared::Light> lights) {
  std::vector<shared::LightSphere> spheres;
  spheres.reserve(lights.size());
  for (const shared::Light& light : lights) spheres.push_back(bounding_sphere(light));
  return spheres;
}

}  // namespace lamp
