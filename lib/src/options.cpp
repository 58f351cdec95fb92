// Options: words or integers, checked against a method's row and completed with its defaults.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <set>
#include <string>

#include "complete_options.h"
#include "lamplight/method.h"

namespace lamp {
namespace {

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text;
}

std::optional<Error> check_value(const OptionSpec& spec, std::string_view value) {
  const std::string source = "option " + std::string(spec.key);
  if (!spec.choices.empty()) {
    if (std::ranges::find(spec.choices, value) != spec.choices.end()) return std::nullopt;
    return Error{source, "'" + std::string(value) + "' is not one of " + joined(spec.choices)};
  }
  long long number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error == std::errc{} && end == value.data() + value.size() && number >= spec.min && number <= spec.max)
    return std::nullopt;
  return Error{source, "expected an integer from " + std::to_string(spec.min) + " to " + std::to_string(spec.max) +
                           ", got '" + std::string(value) + "'"};
}

/// Levenshtein's distance, ignoring nothing: the number of letters to change, add or drop.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row[b.size()];
}

}  // namespace

std::vector<std::string> sample_values(const OptionSpec& spec) {
  std::vector<std::string> values(spec.choices.begin(), spec.choices.end());
  if (values.empty())
    for (const long long value : {spec.min, (spec.min + spec.max) / 2, spec.max})
      values.push_back(std::to_string(value));
  return values;
}

std::uint32_t Options::integer(std::string_view key) const {
  const std::string& text = word(key);
  std::uint32_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

const std::string& Options::word(std::string_view key) const {
  const auto found = values_.find(key);
  assert(found != values_.end() && "ask only for options of the method's row, after resolve_options");
  return found->second;
}

Result<Options> resolve_options(const Method& method, const std::vector<std::string>& settings) {
  Options options;
  for (const OptionSpec& spec : method.options) options.values_.emplace(spec.key, spec.fallback);
  std::set<std::string_view> set;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) return Error{"option '" + setting + "'", "expected KEY=VALUE"};
    const std::string key = setting.substr(0, equals);
    const auto spec = std::ranges::find(method.options, std::string_view(key), &OptionSpec::key);
    if (spec == method.options.end()) {
      std::vector<std::string_view> keys;
      for (const OptionSpec& known : method.options) keys.push_back(known.key);
      return Error{"option '" + key + "'", "method " + std::string(method.name) +
                                               (keys.empty() ? " has no options" : " has the options " + joined(keys))};
    }
    const std::string value = setting.substr(equals + 1);
    if (auto error = check_value(*spec, value)) return *error;
    if (!set.insert(spec->key).second) return Error{"option " + key, "is given twice, expected once"};
    options.values_[key] = value;
  }
  return options;
}

std::vector<std::string> settings_of(const std::map<std::string, std::string, std::less<>>& values) {
  std::vector<std::string> settings;
  for (const auto& [key, value] : values) settings.push_back(std::string(key).append("=").append(value));
  return settings;
}

Result<Options> complete_options(const Method& method, const Options& options) {
  return resolve_options(method, settings_of(options.all()));
}

std::vector<std::string> nearest_names(std::string_view wanted, std::span<const std::string_view> names,
                                       std::size_t count) {
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string_view name : names) ranked.emplace_back(edit_distance(wanted, name), name);
  std::ranges::sort(ranked);  // by distance, then by name
  std::vector<std::string> nearest;
  for (std::size_t i = 0; i < std::min(count, ranked.size()); ++i) nearest.push_back(ranked[i].second);
  return nearest;
}

}  // namespace lamp
