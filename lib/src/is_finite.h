// Whether a place or a colour has numbers alone.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "lamplight/vectors.h"

namespace lamp {

[[nodiscard]] inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace lamp
