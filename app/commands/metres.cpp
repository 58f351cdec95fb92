// Chooses the form by the size.
// SPDX-License-Identifier: Apache-2.0
#include "commands/metres.h"

#include <fmt/format.h>

#include <cmath>

namespace lamp::app {

std::string metres(double length_m) {
  const double size = std::abs(length_m);
  const bool plain = size == 0.0 || (size >= 0.01 && size < 1e6);
  return plain ? fmt::format("{:.2f}", length_m) : fmt::format("{:.3g}", length_m);
}

}  // namespace lamp::app
