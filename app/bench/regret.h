// The regret of `auto`: its time of cull and shading over that of whatever did best, for the same frames.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lamp::app {

/// Adds to every timed result of `auto` what it was measured against: "regret": {"factor": 1.08, "best": "tiled",
/// "best_ms": 0.31}; and to the run "regret": {"count", "mean" (geometric), "worst", "where"}. Rivals share the series
/// and all parameters but method and options; those that may miss lights are none, `auto` itself is one. `factor`: the
/// median over "rounds", in which all are timed one after the other; over medians where a result has none.
void add_regret(nlohmann::json& results);

/// One sentence, or nothing when `auto` was not measured.
[[nodiscard]] std::string regret_words(const nlohmann::json& results);

}  // namespace lamp::app
