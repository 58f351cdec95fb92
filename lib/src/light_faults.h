// What is wrong with numbers that a host gives, in words that have the number.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "lamplight/shared/light.h"
#include "lamplight/vectors.h"

namespace lamp {

/// "WHAT, got VALUE"
[[nodiscard]] std::string expected(std::string_view what, float value);
[[nodiscard]] std::string expected(std::string_view what, const Vec3& value);

/// What is wrong with a packed light, or an empty text: all that `check_lights` refuses, and numbers that are not those
/// that `pack` derives.
[[nodiscard]] std::string fault_of_packed(const shared::Light& light);

}  // namespace lamp
