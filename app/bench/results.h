// A bench's results: results.json, its table results.csv, and what is there already when a run goes on.
// The schema is described in docs/bench.md; `VERSION` changes when an old file would be misread.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "bench/groups.h"
#include "bench/statistics.h"

namespace lamp::app {

inline constexpr std::string_view RESULTS_FORMAT = "lamplight-results";
inline constexpr int RESULTS_VERSION = 1;

/// Where, with what and how a run was made.
struct RunInfo {
  std::string command;  ///< as typed
  std::string device, device_kind, driver;
  std::string commit;
  std::string date;  ///< when it began
};

/// A document without results.
[[nodiscard]] nlohmann::json new_results(const RunInfo& run, const Suite& suite);

/// A document that holds what docs/bench.md says, all of it of its type and range. Throws Error: `file`, the element,
/// what was expected; also for another version.
[[nodiscard]] nlohmann::json parse_results(std::string_view text, const std::string& file);
/// The same from a file.
[[nodiscard]] nlohmann::json load_results(const std::filesystem::path& file);

/// Takes over from an earlier run the results that the same configurations would give again. Throws Error when the
/// earlier run was another suite, or made on another device, driver or commit: its times cannot stand beside new ones.
void take_over(nlohmann::json& results, const nlohmann::json& earlier, const std::string& file,
               std::span<const Group> groups);

/// Whether every entry of the group has its result.
[[nodiscard]] bool has_group(const nlohmann::json& results, const Group& group);
/// Adds results of a group; those of the same keys go.
void add_group(nlohmann::json& results, const std::vector<nlohmann::json>& entries);

/// {"median": …, "p5": …, "p95": …, "mean": …, "deviation": …}
[[nodiscard]] nlohmann::json to_json(const Spread& spread);

/// One row a result, comma separated, a header first.
[[nodiscard]] std::string results_csv(const nlohmann::json& results);

}  // namespace lamp::app
