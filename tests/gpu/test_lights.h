// Lights for tests: generated ones, and among them every kind that is hard to get right.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/view.h"
#include "scene/open_air.h"

namespace lamp::app {

enum class Mix : std::uint8_t { points, spots, both };
inline constexpr std::string_view MIX_NAMES[] = {"points", "spots", "both"};

/// The counts of every matrix: around words of 32 bits and work groups, none, one, and many.
inline constexpr std::uint32_t LIGHT_COUNTS[] = {0, 1, 31, 32, 33, 512, 513, 4096};

struct LightMix {
  std::uint32_t count = 0;
  Mix mix = Mix::both;
  std::uint32_t seed = 1;
};

/// Hard cases for a view: at the eye, behind it, across the near plane, range 0, infinite range, half-angles 0, half a
/// degree, 45 and 90 degrees, very large, very tiny, very far.
[[nodiscard]] std::vector<Light> hard_lights(const View& view);

/// Exactly `count` lights: all the hard ones spread among generated ones; one of them, chosen by the seed, if `count`
/// is smaller than their number. `points` and `spots` turn every light into such a one.
[[nodiscard]] std::vector<shared::Light> test_lights(const OpenAir& air, const View& view, const LightMix& mix);

}  // namespace lamp::app
