// lamp list pipelines: compiles all of them, and says what the driver says of each.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "error.h"

namespace lamp::app {

/// `method`: a name of the table, or empty for all. `device`: as of `--device`.
Exit list_pipelines_of(const std::string& method, const std::string& device, bool json);

}  // namespace lamp::app
