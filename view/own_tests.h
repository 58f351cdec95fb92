// Which tests a method itself makes before it lists a light, in the words of the inspector.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "lamplight/method.h"
#include "lamplight/plan.h"

namespace lamp::app {

struct OwnTests {
  std::uint32_t passes = 0;    ///< gpu::PASSES_SIDES and so on
  std::string_view otherwise;  ///< why it lists lights, where it makes none of these
};
/// By the shaders of its plan and what its options ask of them.
[[nodiscard]] OwnTests own_tests(const Plan& plan, const Options& options);

}  // namespace lamp::app
