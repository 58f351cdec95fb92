// Asks a method's look-up by position at points, and holds what it names against the oracle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "render/point_check.h"
#include "world_lights.h"

namespace lamp::app {

inline constexpr std::uint32_t ASK_SIDE = 64;  // pixels: the picture does not matter

/// From a point, along -Z.
[[nodiscard]] View view_from(const glm::vec3& eye);

struct Asked {
  View view = view_from({});
  std::vector<shared::Light> lights;
  test::Points points;
  std::vector<std::string> settings;
  std::uint32_t max_groups = ~0U;  ///< of a dispatch, if that is fewer than the device takes
};

[[nodiscard]] Plan plan_of(const Method& method, const Asked& asked);

struct Answered {
  PointFindings findings;
  PointLights lights;
  shared::Counters counters{};
};

/// Expects no miss, and ids that ascend where the plan says so.
[[nodiscard]] Answered answer(const Method& method, const Asked& asked);

}  // namespace lamp::app
