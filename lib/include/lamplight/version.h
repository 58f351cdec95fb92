// The version, by the rules of semver.org: CHANGELOG.md says what changed. CMake reads it from here.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "lamplight/export.h"

#define LAMPLIGHT_VERSION_MAJOR 0
#define LAMPLIGHT_VERSION_MINOR 9
#define LAMPLIGHT_VERSION_PATCH 0

namespace lamp {

/// "MAJOR.MINOR.PATCH" of the library that is linked. The macros are those of the headers: with a shared library, the
/// patch may differ.
[[nodiscard]] LAMPLIGHT_API std::string_view version();

}  // namespace lamp
