// What `lamp verify` asks of lists of still lights.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "commands/still_stats.h"

namespace lamp::app {

/// At the pixels of all the frame's pictures and at `points` random points of all surfaces; 0: 10 000. Nothing where
/// there are no such lists.
[[nodiscard]] std::optional<StillStats> check_still_lists(const Request& request, Session& session, const Setup& setup,
                                                          std::uint32_t points);

/// A table, and what lists take.
void print_still(const StillStats& stats);

/// The worst of the checks.
[[nodiscard]] Verdict verdict_of(const StillStats& stats);

}  // namespace lamp::app
