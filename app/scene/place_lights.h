// Generated lights: placed in a scene's open air, coloured, moving on smooth closed paths.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/light_path.h"
#include "scene/open_air.h"
#include "scene/scene.h"

namespace lamp::app {

struct PlaceLights {
  std::uint32_t count = 0;
  float spots = 0.5F;      ///< fraction of the lights that are spots, 0 .. 1
  float still = 0.0F;      ///< fraction of the lights that stand still, 0 .. 1: the last ones; where frame 0 has them
  float min_range = 0.0F;  ///< m, > 0; both 0: chosen so that a point of open air lies in about 24 lights' ranges
  float max_range = 0.0F;  ///< m, >= min_range, finite; both infinite: as with automatic ranges, but without them
  std::uint64_t seed = 1;
  std::uint32_t frame = 0;     ///< of a flight: lights move along their paths
  std::uint32_t frames = 300;  ///< a path closes after so many frames, > 0
};

/// `count` lights; the same input gives the same lights, bit for bit with the same compiler and C library. Light i
/// depends on `count` through an automatic range alone. Intensities follow the range, so that with automatic ranges
/// the picture's brightness hardly depends on the count. All of a light's path lies in open air.
/// Throws Error for a fraction, a range or a frame count outside the limits above.
[[nodiscard]] std::vector<Light> place_lights(const Scene& scene, const PlaceLights& how);

/// How many of them stand still.
[[nodiscard]] std::uint32_t still_count(const PlaceLights& how);

/// The same for air that is already known, which takes most of the time: for frame after frame of one scene.
[[nodiscard]] std::vector<Light> place_lights(const OpenAir& air, const PlaceLights& how);

/// The same lights, and the path of each: at path_time(frame, frames) it is where place_lights has it in that frame.
struct PlacedLights {
  std::vector<Light> lights;
  std::vector<LightPath> paths;
};
[[nodiscard]] PlacedLights place_on_paths(const OpenAir& air, const PlaceLights& how);

}  // namespace lamp::app
