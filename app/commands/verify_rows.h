// The rows of `lamp verify`, a method each, as a table and as JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "commands/stats.h"

namespace lamp::app {

/// Of a method that this device has no way to run.
[[nodiscard]] Stats refused_row(const Request& request, Session& session, const Setup& setup, const Method& method,
                                const Error& error);

/// Every row has a judgement; one without findings is of a method that cannot run here. `inf` is explained below.
void print_table(std::span<const Stats> rows);
/// In such a table: "ok", "FAILED".
[[nodiscard]] std::string table_words(Verdict verdict);
/// An array of Stats objects.
void print_json(std::span<const Stats> rows);

}  // namespace lamp::app
