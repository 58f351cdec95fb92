// A bench's results: results.json, its table results.csv, and what is there already when a run goes on.
// The schema is described in docs/bench.md; `VERSION` changes when an old file would be misread.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "bench/groups.h"
#include "bench/statistics.h"

namespace lamp::app {

inline constexpr std::string_view RESULTS_FORMAT = "lamplight-results";
inline constexpr int RESULTS_VERSION = 1;
inline constexpr std::string_view BUILT_IN = "built in";
inline constexpr std::string_view OFF = "off";

/// Where, with what and how a run was made.
struct RunInfo {
  std::string command;  ///< as typed
  std::string device, device_kind, driver;
  std::string commit;
  std::string date;                      ///< when it began
  std::string shaders{BUILT_IN};         ///< or a hash of the sources that --shader-dir names
  std::string pipeline_statistics{OFF};  ///< or on: drivers may compile other pipelines then
};

/// A document without results.
[[nodiscard]] nlohmann::json new_results(const RunInfo& run, const Suite& suite);

/// A document that holds what docs/bench.md says, all of it of its type and range. Throws Error: `file`, the element,
/// what was expected; also for another version.
[[nodiscard]] nlohmann::json parse_results(std::string_view text, const std::string& file);
/// The same from a file.
[[nodiscard]] nlohmann::json load_results(const std::filesystem::path& file);

/// Throws Error when going on with an earlier run would lose any of its results: when it was another suite, was made on
/// another device, driver or commit, or with other shaders (its times cannot stand beside new ones), or measured what
/// this run does not.
void check_earlier(const nlohmann::json& results, const nlohmann::json& earlier, const std::string& file,
                   std::span<const Group> groups);
/// Takes over from an earlier run the results that the same groups would give again, by the names that they have now.
/// Returns how many of them are to be measured again; such as stand beside a method that is new stay until then.
[[nodiscard]] std::size_t take_over(nlohmann::json& results, const nlohmann::json& earlier,
                                    std::span<const Group> groups);

/// {"scene": …, "calibration": …}: hashes of files that decide a result; without what is of no concern.
[[nodiscard]] nlohmann::json hashes_of(const Group& group, const GroupEntry& entry);

/// Whether every entry of the group has its result, of files as they are now.
[[nodiscard]] bool has_group(const nlohmann::json& results, const Group& group);
/// Adds results of a group; those of the same keys go.
void add_group(nlohmann::json& results, const std::vector<nlohmann::json>& entries);

/// {"median": …, "p5": …, "p95": …, "mean": …, "deviation": …}
[[nodiscard]] nlohmann::json to_json(const Spread& spread);

/// One row a result, comma separated, a header first.
[[nodiscard]] std::string results_csv(const nlohmann::json& results);

}  // namespace lamp::app
