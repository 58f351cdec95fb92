// Whether a place or a colour has numbers alone.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "lamplight/vectors.h"

#if (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error "Lamplight checks for NaN: compile its sources with -fno-fast-math, as its CMake target does"
#endif

namespace lamp {

[[nodiscard]] inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace lamp
