// Plans each method with its default options and with one of them set, and keeps what is new about the result; then
// with two of them, and keeps look-ups that are new.
// SPDX-License-Identifier: Apache-2.0
#include "commands/list_lookups.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/read_json.h"
#include "lamplight/method.h"
#include "system/print.h"

namespace lamp::app {
namespace {

/// A way to read a method's result.
struct Row {
  std::string_view method;
  std::vector<std::string> options;  ///< that lead to it, besides the defaults
  std::string lookup;
  std::size_t constants = 0;
  std::size_t bindings = 0;
  bool ordered = false;
  bool approximate = false;
  bool needs_depth = false;
  bool any_depth = false;
  bool any_point = false;  ///< of the method, whatever its options

  [[nodiscard]] bool reads_like(const Row& other) const {
    return lookup == other.lookup && constants == other.constants && bindings == other.bindings &&
           ordered == other.ordered && approximate == other.approximate && needs_depth == other.needs_depth &&
           any_depth == other.any_depth;
  }
};

/// A device that lacks nothing, so that no option is refused or replaced; sizes that every option takes.
std::optional<Row> row_of(const Method& method, const std::vector<std::string>& settings) {
  const Result<Options> options = resolve_options(method, settings);
  if (!options) return std::nullopt;
  const DeviceTraits traits{.max_storage_buffer_bytes = ~0U,
                            .max_group_invocations = 1024,
                            .shared_memory_bytes = 1U << 16,
                            .conservative_raster = true};
  const Result<Plan> planned = make_plan(
      method, {.width = 640, .height = 360, .light_capacity = 1024, .options = options.value(), .traits = traits});
  if (!planned) return std::nullopt;
  const Plan& plan = planned.value();
  return Row{.method = method.name,
             .options = settings,
             .lookup = plan.lookup.name,
             .constants = plan.lookup.constants.size(),
             .bindings = plan.lookup.bindings.size(),
             .ordered = plan.ordered,
             .approximate = plan.approximate,
             .needs_depth = plan.binds(INPUT_DEPTH),
             .any_depth = plan.any_depth,
             .any_point = method.any_point};
}

/// Each word of each option; numbers change no look-up.
std::vector<std::vector<std::string>> settings_of(const Method& method) {
  std::vector<std::vector<std::string>> settings;
  for (const OptionSpec& option : method.options) {
    std::vector<std::string>& words = settings.emplace_back();
    for (const std::string_view word : option.choices)
      if (word != option.fallback) words.push_back(fmt::format("{}={}", option.key, word));
  }
  return settings;
}

/// Keeps the row of these settings where `same(row, other)` holds for none that is known.
template <class Same>
void keep_new(std::vector<Row>& rows, const Method& method, const std::vector<std::string>& settings, Same same) {
  std::optional<Row> row = row_of(method, settings);
  if (row && std::ranges::none_of(rows, [&](const Row& known) { return same(*row, known); }))
    rows.push_back(std::move(*row));
}

std::vector<Row> rows_of(const Method& method) {
  std::vector<Row> rows;
  const auto reads_like = [](const Row& a, const Row& b) { return a.reads_like(b); };
  const auto same_lookup = [](const Row& a, const Row& b) { return a.lookup == b.lookup; };
  keep_new(rows, method, {}, reads_like);
  const std::vector<std::vector<std::string>> settings = settings_of(method);
  for (const std::vector<std::string>& words : settings)
    for (const std::string& word : words) keep_new(rows, method, {word}, reads_like);
  for (std::size_t a = 0; a < settings.size(); ++a)
    for (std::size_t b = a + 1; b < settings.size(); ++b)
      for (const std::string& first : settings[a])
        for (const std::string& second : settings[b]) keep_new(rows, method, {first, second}, same_lookup);
  return rows;
}

nlohmann::json json_of(const Row& row) {
  return {{"method", row.method},           {"options", row.options},         {"lookup", row.lookup},
          {"constants", row.constants},     {"bindings", row.bindings},       {"ordered", row.ordered},
          {"approximate", row.approximate}, {"needs_depth", row.needs_depth}, {"any_depth", row.any_depth},
          {"any_point", row.any_point}};
}

constexpr std::string_view COLUMNS = "{:<48} {:<22} {:>9} {:>8}  {}\n";

void print(const Row& row) {
  print_out(COLUMNS, fmt::format("{} {}", row.method, fmt::join(row.options, " ")), row.lookup, row.constants,
            row.bindings,
            fmt::format("{}{}{}{}{}", row.ordered ? "ordered" : "unordered", row.approximate ? ", approximate" : "",
                        row.needs_depth ? ", needs depth" : "", row.any_depth ? ", right at any depth" : "",
                        row.any_point ? ", takes a position" : ""));
}

}  // namespace

Exit list_lookups(bool json) {
  nlohmann::json array = nlohmann::json::array();
  if (!json) print_out(COLUMNS, "method, options", "look-up", "constants", "bindings", "");
  for (const Method& method : methods())
    for (const Row& row : rows_of(method))
      if (json)
        array.push_back(json_of(row));
      else
        print(row);
  if (json) write_out(json_text(array, 2) + "\n");
  return Exit::done;
}

}  // namespace lamp::app
