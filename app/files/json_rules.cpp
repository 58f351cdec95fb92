// Walks a document by the paths of its rules.
// SPDX-License-Identifier: Apache-2.0
#include "files/json_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "error.h"
#include "files/json_values.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// Cuts the first key off a path.
std::string_view next_key(std::string_view& path) {
  const std::size_t slash = path.find('/');
  const std::string_view key = path.substr(0, slash);
  path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
  return key;
}

std::string_view singular(std::string_view key) {
  if (key == "meshes") return "mesh";
  if (key == "series") return key;
  return key.ends_with('s') ? key.substr(0, key.size() - 1) : key;
}

/// "meshes/*/primitives/*" and {0, 2} to "mesh 0 primitive 2". The keys that lead to an array are left out.
std::string element_name(std::string_view path, const std::vector<std::size_t>& indices) {
  std::string numbered;
  std::string plain;
  std::size_t used = 0;
  std::string_view previous;
  while (!path.empty()) {
    const std::string_view key = next_key(path);
    if (key == "*") {
      numbered += fmt::format("{}{} {}", numbered.empty() ? "" : " ", singular(previous), indices[used++]);
      plain.clear();
    } else if (key != "extensions" && !path.starts_with('*')) {
      plain += fmt::format(" {}", key);
    }
    previous = key;
  }
  return numbered.empty() && !plain.empty() ? plain.substr(1) : numbered + plain;
}

/// Calls visit(object, indices) for every object at a path.
template <class Visit>
void for_each_at(const json& value, std::string_view path, std::vector<std::size_t>& indices, const Visit& visit) {
  if (path.empty()) {
    if (value.is_object()) visit(value, indices);
    return;
  }
  const std::string_view key = next_key(path);
  if (key != "*") {
    if (const auto found = value.find(key); found != value.end()) for_each_at(*found, path, indices, visit);
    return;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    indices.push_back(i);
    for_each_at(value[i], path, indices, visit);
    indices.pop_back();
  }
}

std::size_t array_size(const json& document, std::string_view path) {
  const json* value = &document;
  while (!path.empty()) {
    const auto found = value->find(next_key(path));
    if (found == value->end()) return 0;
    value = &*found;
  }
  return value->size();
}

bool is_word(std::string_view words, std::string_view word) {
  constexpr std::string_view BETWEEN = ", ";
  while (!words.empty()) {
    const std::size_t end = words.find(BETWEEN);
    if (words.substr(0, end) == word) return true;
    words = end == std::string_view::npos ? std::string_view{} : words.substr(end + BETWEEN.size());
  }
  return false;
}

bool in_range(const Rule& rule, const json& value) {
  if (!value.is_number()) return false;
  const auto number = value.get<double>();
  return number >= rule.min && number <= rule.max;
}

bool is_allowed_text(const Rule& rule, const std::string& text) {
  return (rule.words.empty() || is_word(rule.words, text)) && (rule.size == 0 || text.size() <= rule.size);
}

template <class Test>
bool all_of(const json& array, const Test& test) {
  return array.is_array() && std::all_of(array.begin(), array.end(), test);
}

/// Whether a value is what its rule wants; `into_size` is the size of the array that indices point into.
bool fits(const Rule& rule, const json& value, std::size_t into_size) {
  const auto is_index = [into_size](const json& index) {
    return index.is_number_unsigned() && index.get<std::size_t>() < into_size;
  };
  const auto is_text = [](const json& text) { return text.is_string(); };
  if (rule.nullable && value.is_null()) return true;
  switch (rule.want) {
    case Want::object:
      return value.is_object();
    case Want::objects:
      return all_of(value, [](const json& element) { return element.is_object(); });
    case Want::index:
      return is_index(value);
    case Want::indices:
      return all_of(value, is_index);
    case Want::named_indices:
      return value.is_object() && std::all_of(value.begin(), value.end(), is_index);
    case Want::natural:
      if (!value.is_number_unsigned()) return false;
      if (!rule.words.empty()) return is_word(rule.words, value.dump());
      return in_range(rule, value) && value.get<std::uint64_t>() % rule.step == 0;
    case Want::number:
      return in_range(rule, value);
    case Want::numbers:
      return (rule.size == 0 || value.size() == rule.size) &&
             all_of(value, [&rule](const json& number) { return in_range(rule, number); });
    case Want::text:
      return value.is_string() && is_allowed_text(rule, value.get_ref<const std::string&>());
    case Want::texts:
      return all_of(value, is_text);
    case Want::named_texts:
      return value.is_object() && std::all_of(value.begin(), value.end(), is_text);
    case Want::flag:
      return value.is_boolean();
  }
  return false;
}

bool is_above_zero(const Rule& rule) { return rule.min == static_cast<double>(std::numeric_limits<float>::min()); }

/// Whether a text of the range tells the most there may be.
bool tells_max(const Rule& rule) { return !is_above_zero(rule) && rule.min >= 0.0 && rule.max < Rule{}.max; }

std::string range_text(const Rule& rule) {
  if (is_above_zero(rule)) return " > 0";
  if (tells_max(rule)) return fmt::format(" {} .. {}", rule.min, rule.max);
  return rule.min >= 0.0 ? fmt::format(" >= {}", rule.min) : std::string();
}

std::string natural_text(const Rule& rule) {
  if (!rule.words.empty()) return fmt::format("one of {}", rule.words);
  const std::string step = rule.step == 1 ? std::string() : fmt::format(", a multiple of {}", rule.step);
  return fmt::format("an integer{}{}", range_text(rule), step);
}

std::string expectation(const Rule& rule, std::size_t into_size) {
  switch (rule.want) {
    case Want::object:
      return "an object";
    case Want::objects:
      return fmt::format("an array of objects, at most {} in the file", rule.size);
    case Want::index:
      return fmt::format("an index into {} ({} there)", rule.into, into_size);
    case Want::indices:
      return fmt::format("an array of indices into {} ({} there)", rule.into, into_size);
    case Want::named_indices:
      return fmt::format("an object of indices into {} ({} there)", rule.into, into_size);
    case Want::natural:
      return natural_text(rule);
    case Want::number:
      return fmt::format("a number{}", range_text(rule));
    case Want::numbers:
      return rule.size == 0 ? fmt::format("numbers{}", range_text(rule))
                            : fmt::format("{} numbers{}", rule.size, range_text(rule));
    case Want::text:
      if (rule.size != 0) return fmt::format("a string of at most {} bytes", rule.size);
      return rule.words.empty() ? "a string" : fmt::format("one of {}", rule.words);
    case Want::texts:
      return "an array of strings";
    case Want::named_texts:
      return "an object of strings";
    case Want::flag:
      return "true or false";
  }
  return {};
}

/// What a text of the range does not tell of a number, or of the first in an array, that is too large or too small for
/// 32 bits; empty if that is not what is wrong.
std::string untold_limit(const Rule& rule, const json& value) {
  if (rule.want == Want::numbers && value.is_array() && (rule.size == 0 || value.size() == rule.size)) {
    const auto wrong = std::ranges::find_if(value, [&rule](const json& number) { return !in_range(rule, number); });
    if (wrong == value.end()) return {};
    const std::string limit = untold_limit({.want = Want::number, .min = rule.min, .max = rule.max}, *wrong);
    return limit.empty() ? limit : fmt::format("numbers of {}", limit);
  }
  if (rule.want != Want::number || !value.is_number()) return {};
  const auto number = value.get<double>();
  if (number > rule.max && !tells_max(rule)) return fmt::format("at most {:g}", rule.max);
  if (number < rule.min && (rule.min < 0.0 || (is_above_zero(rule) && number > 0.0)))
    return fmt::format("at least {:g}", rule.min);
  return {};
}

/// What is wrong with a value that breaks its rule, and what was expected; of named indices, the first that is none.
std::string complaint(const Rule& rule, const json& value, std::size_t into_size) {
  if (rule.want == Want::named_indices && value.is_object()) {
    const Rule of_one{.want = Want::index, .into = rule.into};
    for (const auto& [name, index] : value.items())
      if (!fits(of_one, index, into_size))
        return fmt::format("{} {} is {}, expected {}", rule.key, name, shown(index), expectation(of_one, into_size));
  }
  if (const std::string limit = untold_limit(rule, value); !limit.empty())
    return fmt::format("{} is {}, expected {}", rule.key, shown(value), limit);
  return fmt::format("{} is {}, expected {}", rule.key, shown(value), expectation(rule, into_size));
}

bool is_required(const Rule& rule, const json& object) {
  return rule.required && (rule.when.empty() || object.value("type", "") == rule.when);
}

/// Checks one rule below `place`, everywhere it applies.
void check_rule(const json& document, std::string_view place, const Rule& rule, const std::string& file) {
  const std::string path =
      place.empty() || rule.at.empty() ? fmt::format("{}{}", place, rule.at) : fmt::format("{}/{}", place, rule.at);
  const std::size_t into_size = rule.into.empty() ? 0 : array_size(document, rule.into);
  std::size_t objects = 0;
  std::vector<std::size_t> indices;
  for_each_at(document, path, indices, [&](const json& object, const std::vector<std::size_t>& where) {
    const auto found = object.find(rule.key);
    const bool there = found != object.end();
    if (!there && !is_required(rule, object)) return;
    if (there && rule.want == Want::objects) objects += found->size();
    if (there && objects <= rule.size && fits(rule, *found, into_size)) return;
    const std::string element = element_name(path, where);
    throw Error(fmt::format("{}: {}{}{}", file, element, element.empty() ? "" : ": ",
                            there ? complaint(rule, *found, into_size)
                                  : fmt::format("{} is missing, expected {}", rule.key, expectation(rule, into_size))));
  });
}

}  // namespace

void check_rules(const json& document, std::span<const Rule> rules, const std::string& file, std::string_view place) {
  if (!document.is_object()) throw Error(fmt::format("{}: is {}, expected an object", file, shown(document)));
  for (const Rule& rule : rules) check_rule(document, place, rule, file);
}

}  // namespace lamp::app
