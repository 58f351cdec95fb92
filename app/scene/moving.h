// Instances that move, for scenes whose own stand still: small things drift on a circle, sink, rise and turn.
// Promise: the same places for the same frame on every machine; at the end of the frames they are where they began.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

/// The instances of a scene at rest, as they are in a frame of so many. A third of those that are no larger than a
/// chair move.
[[nodiscard]] std::vector<Instance> moved_instances(const Scene& at_rest, std::uint32_t frame, std::uint32_t frames);

}  // namespace lamp::app
