// lamp list lookups: what shaders include to read the results of methods.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "error.h"

namespace lamp::app {

/// Prints every look-up that a method's result may need, with the least options that lead to it.
[[nodiscard]] Exit list_lookups(bool json);

}  // namespace lamp::app
