// Every look-up by its name, and a method that makes it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/odd_frames.h"
#include "lamplight/method.h"

namespace lamp::app {

/// Lights: enough words of bits that scalar walks look for those with lights.
inline constexpr std::uint32_t LOOKUP_LIGHTS = 3 * ODD_LIGHTS;

struct LookUpCase {
  std::string_view lookup;
  std::string_view method;
  std::vector<std::string> settings;
  std::uint32_t max_loop_rounds = ~0U;
};
void PrintTo(const LookUpCase& c, std::ostream* out);

/// Every look-up, and what those of lists walk where lists do not fit.
[[nodiscard]] std::vector<LookUpCase> lookup_cases();

[[nodiscard]] Problem problem_of(const LookUpCase& c, glm::uvec2 size);

}  // namespace lamp::app
