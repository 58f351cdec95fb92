// Frames that few hosts have, but that every method must take: surfaces and lights behind the eye of an orthographic
// view, matrices that are not quite rigid, ranges beyond every scene. Lights only just reach what they reach.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/view.h"

namespace lamp::app {

/// A captured frame without its surfaces' looks. All have one size and number of lights, so that one lighting does for
/// all of them.
struct OddFrame {
  std::string name;
  View view;
  std::vector<float> depth;
  std::vector<Light> lights;
};

inline constexpr glm::uvec2 ODD_SIZE{75, 53};
inline constexpr std::uint32_t ODD_LIGHTS = 128;  // as many as one pass of `lamplight` gathers

[[nodiscard]] std::vector<OddFrame> odd_frames();

}  // namespace lamp::app
