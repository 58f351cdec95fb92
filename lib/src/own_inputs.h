// Inputs of a plan's own: what passes read and the host keeps in another form, or not at all.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/method.h"

namespace lamp {

/// The plan makes what its passes read and the host does not bring, each in a buffer that takes the place of the input,
/// by a pass at its head:
/// - the lights' spheres, of a problem with `own_spheres`;
/// - records of 64 bytes, where the host's layout is another, with all that culling reads, and of point lights no more
///   than the first 32 bytes.
/// Nothing changes in a plan that reads neither. Needs Plan::light_capacity.
void make_own_inputs(Plan& plan, const Problem& problem);

}  // namespace lamp
