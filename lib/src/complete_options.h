// Options as a host hands them over: none, some, or those of another method.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/method.h"

namespace lamp {

/// The same, with the method's defaults where nothing is set. Errors as of `resolve_options`.
[[nodiscard]] Result<Options> complete_options(const Method& method, const Options& options);

}  // namespace lamp
