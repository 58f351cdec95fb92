// Options as a host hands them over: none, some, or those of another method.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lamplight/method.h"

namespace lamp {

/// "key=value" for each of them.
[[nodiscard]] std::vector<std::string> settings_of(const std::map<std::string, std::string, std::less<>>& values);

/// The same, with the method's defaults where nothing is set. Errors as of `resolve_options`.
[[nodiscard]] Result<Options> complete_options(const Method& method, const Options& options);

}  // namespace lamp
