// What a host says of its device, before anybody divides by it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/plan.h"

namespace lamp {

/// The first trait that no device of Vulkan 1.3 has, by its name, and what was expected; or nothing. What is merely
/// small is no error here: a plan that needs more is refused.
[[nodiscard]] std::optional<Error> check_traits(const DeviceTraits& traits);

}  // namespace lamp
