// The plan of `lamplight` for few lights: cells look at every light, all in one pass.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "parts.h"

namespace lamp::lamplight {

/// Whether cells can look at every light themselves, and `cells=gather` may be asked for: a depth buffer, as many
/// lights as a piece holds, and room for all of them in every tile's list.
[[nodiscard]] bool can_gather(const Problem& problem);

/// Of a problem that can_gather.
[[nodiscard]] Plan plan_at_once(const Problem& problem);

}  // namespace lamp::lamplight
