// The rows of the table, each made by its method's file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/method.h"

namespace lamp {

[[nodiscard]] Method all_method();
[[nodiscard]] Method tiled_method();
[[nodiscard]] Method tiled_bits_method();
[[nodiscard]] Method clustered_method();

}  // namespace lamp
