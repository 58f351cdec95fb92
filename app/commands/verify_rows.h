// The rows of `lamp verify`, a method each, as a table and as JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "commands/stats.h"

namespace lamp::app {

/// Every row has a judgement; one without findings is of a method that cannot run here. `inf` is explained below.
void print_table(std::span<const Stats> rows);
/// An array of Stats objects.
void print_json(std::span<const Stats> rows);

}  // namespace lamp::app
