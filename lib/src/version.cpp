// Implements version.h.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/version.h"

namespace lamp {

std::string_view version() { return LAMPLIGHT_VERSION; }  // CMake's, which it has read from the header

}  // namespace lamp
