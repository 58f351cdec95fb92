// A camera and a flight for scenes that come without: inside what is as large as a building, around what is smaller.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace lamp::app {

/// Named "default". Inside: near one end of the longer horizontal axis, at eye height, looking along it.
[[nodiscard]] Camera default_camera(const Box& bounds);

/// Eight keys on a closed loop. Inside: along the middle of the longer axis and back, looking ahead.
[[nodiscard]] Flight default_flight(const Box& bounds);

/// Eight keys that turn once around, a step away from where a perspective camera stands: whoever placed it chose open
/// air, and in a maze of rooms the middle of the bounds seldom is. The step is shorter in a small scene.
[[nodiscard]] Flight flight_at(const Camera& camera, const Box& bounds);

}  // namespace lamp::app
