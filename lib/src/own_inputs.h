// Spheres of a plan's own, for hosts that keep none.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/plan.h"

namespace lamp {

/// The plan makes the lights' spheres itself, from INPUT_LIGHTS, in a buffer that takes the place of INPUT_SPHERES: a
/// pass more, which reads 64 bytes a light. Nothing changes in a plan that reads no spheres. Needs
/// Plan::light_capacity.
void make_own_spheres(Plan& plan, const DeviceTraits& traits);

}  // namespace lamp
