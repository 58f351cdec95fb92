// How many samples of a pixel the device's depth images may have.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/context.h"

namespace lamp::app {

[[nodiscard]] std::vector<std::uint32_t> depth_sample_counts(const Context& context);

}  // namespace lamp::app
