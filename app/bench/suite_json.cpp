// Reads values, remembers keys.
// SPDX-License-Identifier: Apache-2.0
#include "bench/suite_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "error.h"
#include "files/json_values.h"
#include "lamplight/method.h"

namespace lamp::app {
namespace {

using nlohmann::json;

bool is_whole(const json& value, std::uint64_t min, std::uint64_t max) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() >= min && value.get<std::uint64_t>() <= max;
}

bool is_within(const json& value, double min, double max) {
  return value.is_number() && value.get<double>() >= min && value.get<double>() <= max;
}

/// A list of one or more values that all pass.
template <class Test>
bool is_list(const json& value, const Test& test) {
  return value.is_array() && !value.empty() && std::ranges::all_of(value, test);
}

}  // namespace

SuiteJson::SuiteJson(const json& json, std::string where) : json_(json), where_(std::move(where)) {
  if (!json.is_object()) throw Error(where_ + ": expected an object { ... }");
}

bool SuiteJson::has(std::string_view key) {
  known_.emplace_back(key);
  return json_.contains(key);
}

const json& SuiteJson::at(std::string_view key) const { return json_.at(std::string(key)); }

void SuiteJson::wrong(std::string_view key, const std::string& expected) const {
  const std::string got = json_.contains(std::string(key)) ? shown(at(key)) : "none";
  throw Error(fmt::format("{}: {}: expected {}, got {}", where_, key, expected, got));
}

void SuiteJson::missing(std::string_view key, const std::string& expected) const {
  throw Error(fmt::format("{}: {}: is missing; expected {}", where_, key, expected));
}

void SuiteJson::read(std::string_view key, std::string& out) {
  if (!has(key)) return;
  if (!at(key).is_string()) wrong(key, "a text");
  out = at(key).get<std::string>();
}

void SuiteJson::require(std::string_view key, std::string& out) {
  read(key, out);
  if (out.empty()) missing(key, "a text");
}

void SuiteJson::read(std::string_view key, bool& out) {
  if (!has(key)) return;
  if (!at(key).is_boolean()) wrong(key, "true or false");
  out = at(key).get<bool>();
}

void SuiteJson::read(std::string_view key, std::uint32_t& out, std::uint64_t min, std::uint64_t max) {
  if (!has(key)) return;
  if (!is_whole(at(key), min, max)) wrong(key, fmt::format("a whole number from {} to {}", min, max));
  out = at(key).get<std::uint32_t>();
}

void SuiteJson::read(std::string_view key, std::uint64_t& out) {
  if (!has(key)) return;
  if (!at(key).is_number_unsigned()) wrong(key, "a whole number");
  out = at(key).get<std::uint64_t>();
}

void SuiteJson::read(std::string_view key, double& out, double min, double max) {
  if (!has(key)) return;
  if (!is_within(at(key), min, max)) wrong(key, fmt::format("a number from {} to {}", min, max));
  out = at(key).get<double>();
}

void SuiteJson::read(std::string_view key, std::vector<std::string>& out) {
  if (!has(key)) return;
  if (!is_list(at(key), [](const json& v) { return v.is_string(); })) wrong(key, "a list of texts");
  out = at(key).get<std::vector<std::string>>();
}

void SuiteJson::read(std::string_view key, std::vector<double>& out, double min, double max) {
  if (!has(key)) return;
  if (!is_list(at(key), [&](const json& v) { return is_within(v, min, max); }))
    wrong(key, fmt::format("a list of numbers from {} to {}", min, max));
  out = at(key).get<std::vector<double>>();
}

void SuiteJson::read(std::string_view key, std::vector<std::uint32_t>& out, std::uint64_t min, std::uint64_t max) {
  if (!has(key)) return;
  if (!is_list(at(key), [&](const json& v) { return is_whole(v, min, max); }))
    wrong(key, fmt::format("a list of whole numbers from {} to {}", min, max));
  out = at(key).get<std::vector<std::uint32_t>>();
}

void SuiteJson::finish() const {
  for (const auto& [key, value] : json_.items()) {
    if (std::ranges::find(known_, key) != known_.end()) continue;
    const std::vector<std::string_view> names(known_.begin(), known_.end());
    throw Error(fmt::format("{}: key '{}': there is none of that name; the nearest are {}", where_, key,
                            fmt::join(nearest_names(key, names), ", ")));
  }
}

}  // namespace lamp::app
