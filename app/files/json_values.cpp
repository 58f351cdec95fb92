// Checks values of JSON documents.
// SPDX-License-Identifier: Apache-2.0
#include "files/json_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "error.h"
#include "lamplight/method.h"

namespace lamp::app {
namespace {

constexpr double LARGEST = std::numeric_limits<float>::max();

bool is_number(const nlohmann::json& value) { return value.is_number() && std::abs(value.get<double>()) <= LARGEST; }

}  // namespace

std::string shown(const nlohmann::json& value) {
  constexpr std::size_t LONGEST = 60;
  if (value.is_array() && value.size() > 16) return fmt::format("an array of {} elements", value.size());
  if (value.is_object() && !value.empty()) return "an object";
  std::string text = value.dump(-1, ' ', /* ensure_ascii= */ true, nlohmann::json::error_handler_t::replace);
  if (text.size() > LONGEST) text.replace(LONGEST, std::string::npos, "...");
  return text;
}

void JsonObject::fail(std::string_view problem) const {
  throw Error(fmt::format("{}: {}{}{}", file, element, element.empty() ? "" : ": ", problem));
}

void JsonObject::check_keys(std::span<const std::string_view> known) const {
  if (!json.is_object()) fail(fmt::format("is {}, expected an object", shown(json)));
  for (const auto& [key, value] : json.items())
    if (std::ranges::find(known, key) == known.end())
      fail(fmt::format("{} is not a key of the format; the nearest are {}", shown(key),
                       fmt::join(nearest_names(key, known), ", ")));
}

const nlohmann::json& JsonObject::at(std::string_view key, std::string_view expected) const {
  const auto found = json.find(key);
  if (found == json.end()) fail(fmt::format("{} is missing, expected {}", key, expected));
  return *found;
}

std::uint32_t JsonObject::whole(std::string_view key, std::uint32_t min, std::uint32_t max) const {
  const std::string expected = fmt::format("a whole number {} .. {}", min, max);
  const nlohmann::json& value = at(key, expected);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < min || value.get<std::uint64_t>() > max)
    fail(fmt::format("{} is {}, expected {}", key, shown(value), expected));
  return value.get<std::uint32_t>();
}

double JsonObject::number(std::string_view key) const {
  const nlohmann::json& value = at(key, "a number");
  if (!is_number(value)) fail(fmt::format("{} is {}, expected a finite 32-bit number", key, shown(value)));
  return value.get<double>();
}

std::vector<double> JsonObject::numbers(std::string_view key, std::size_t count) const {
  const nlohmann::json& value = at(key, fmt::format("{} numbers", count));
  if (!value.is_array()) fail(fmt::format("{} is {}, expected an array of {} numbers", key, shown(value), count));
  if (value.size() != count) fail(fmt::format("{} has {} elements, expected {} numbers", key, value.size(), count));
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_number(value[i]))
      fail(fmt::format("{}[{}] is {}, expected a finite 32-bit number", key, i, shown(value[i])));
    numbers.push_back(value[i].get<double>());
  }
  return numbers;
}

std::string JsonObject::text(std::string_view key, std::string_view expected) const {
  const nlohmann::json& value = at(key, expected);
  if (!value.is_string()) fail(fmt::format("{} is {}, expected {}", key, shown(value), expected));
  return value.get<std::string>();
}

glm::vec3 JsonObject::vector(std::string_view key) const {
  const std::vector<double> xyz = numbers(key, 3);
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace lamp::app
