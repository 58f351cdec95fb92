// Lengths for a reader.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace lamp::app {

/// Two digits behind the point; of what is shorter than a centimetre or longer than a thousand kilometres three digits
/// and a power of ten.
[[nodiscard]] std::string metres(double length_m);

}  // namespace lamp::app
