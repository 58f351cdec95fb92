// What lists of still lights take and hold, in words and as JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "commands/request.h"
#include "render/still_check.h"

namespace lamp::app {

struct StillStats {
  std::size_t lights = 0;
  std::size_t triangles = 0;
  std::uint64_t bytes = 0;
  double build_ms = 0.0;
  TriangleListsStats lists;
  std::optional<WorldTreeCounts> tree;  ///< instead of `lists`
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, StillFindings>> findings;  ///< where they were checked: kind of points
};
[[nodiscard]] StillStats still_stats(const StillSetup& still);

/// "2048 lights: 1.2 MB, 14.9 bytes a triangle; ..."
[[nodiscard]] std::string still_words(const StillStats& stats);
[[nodiscard]] nlohmann::json to_json(const StillStats& stats);

}  // namespace lamp::app
