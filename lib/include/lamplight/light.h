// Lights as a user describes them, and their checked GPU form.
// Based on: Khronos, KHR_lights_punctual.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/shared/light.h"
#include "lamplight/vectors.h"

namespace lamp {

enum class LightType : std::uint32_t { point = shared::LIGHT_POINT, spot = shared::LIGHT_SPOT };

/// A punctual light in world space: metres, radians, candela, linear Rec. 709.
struct Light {
  LightType type = LightType::point;
  Vec3 position{};
  float range = shared::INFINITE_RADIUS;  ///< m, >= 0; 0 reaches nothing, 1e18 and more everything, infinity too
  Vec3 color{1.0F, 1.0F, 1.0F};           ///< linear Rec. 709, >= 0
  float intensity = 1.0F;                 ///< candela, >= 0
  Vec3 direction{0.0F, 0.0F, -1.0F};      ///< spots: where it looks; any length but 0
  float inner_angle = 0.0F;               ///< spots: radians, 0 .. outer_angle
  float outer_angle = 0.785398163F;       ///< spots: radians, half-angle of the cone, 0 .. pi/2
};

/// The first light that breaks the ranges above, as an error that names it ("light 3: range must be ..."); or nothing.
[[nodiscard]] LAMPLIGHT_API std::optional<Error> check_lights(std::span<const Light> lights);

/// The 64-byte GPU record of a checked light.
[[nodiscard]] LAMPLIGHT_API shared::Light pack(const Light& light);

/// `pack` for many.
[[nodiscard]] LAMPLIGHT_API std::vector<shared::Light> pack(std::span<const Light> lights);

/// What culling reads of a light, for hosts that bring no more (light_layout.h).
[[nodiscard]] LAMPLIGHT_API shared::LightReach light_reach(const shared::Light& light);
[[nodiscard]] LAMPLIGHT_API shared::LightCone light_cone(const shared::Light& light);

/// The 16-byte sphere around all that a light reaches, in world space. Source: for spots, Primal engine, Light Culling
/// with Approximate Sphere-Cone Intersection, listing 6.
[[nodiscard]] LAMPLIGHT_API shared::LightSphere bounding_sphere(const shared::Light& light);

/// `bounding_sphere` for many.
[[nodiscard]] LAMPLIGHT_API std::vector<shared::LightSphere> bounding_spheres(std::span<const shared::Light> lights);

}  // namespace lamp
