// Checks a glTF document before anything trusts it: types, ranges, lengths, and that every index points into its array.
// Based on: Khronos, glTF 2.0 specification and its JSON schemas, cut down to what the loader reads.
// Promise: after it, every value in the rules (gltf_rules.cpp) that is there has the type and range its rule says.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/gltf_error.h"
#include "scene/gltf_rules.h"

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

/// Calls visit(value, indices) for everything at a path.
template <class Visit>
void for_each_at(const json& value, std::string_view path, std::vector<std::size_t>& indices, const Visit& visit) {
  if (path.empty()) {
    visit(value, indices);
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
  while (!words.empty()) {
    const std::size_t space = words.find(' ');
    if (words.substr(0, space) == word) return true;
    words = space == std::string_view::npos ? std::string_view{} : words.substr(space + 1);
  }
  return false;
}

bool in_range(const Rule& rule, const json& value) {
  if (!value.is_number()) return false;
  const auto number = value.get<double>();
  return number >= rule.min && number <= rule.max;
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
  switch (rule.want) {
    case Want::object:
      return value.is_object();
    case Want::objects:
      return value.size() <= rule.size && all_of(value, [](const json& element) { return element.is_object(); });
    case Want::index:
      return is_index(value);
    case Want::indices:
      return all_of(value, is_index);
    case Want::named_indices:
      return value.is_object() && std::all_of(value.begin(), value.end(), is_index);
    case Want::natural:
      if (!value.is_number_unsigned()) return false;
      return rule.words.empty() ? in_range(rule, value) : is_word(rule.words, value.dump());
    case Want::number:
      return in_range(rule, value);
    case Want::numbers:
      return value.size() == rule.size && all_of(value, [&rule](const json& number) { return in_range(rule, number); });
    case Want::text:
      return value.is_string() && (rule.words.empty() || is_word(rule.words, value.get_ref<const std::string&>()));
    case Want::texts:
      return all_of(value, [](const json& text) { return text.is_string(); });
    case Want::flag:
      return value.is_boolean();
  }
  return false;
}

std::string range_text(const Rule& rule) {
  const double unbounded = Rule{}.max;
  if (rule.min == static_cast<double>(std::numeric_limits<float>::min())) return " > 0";
  if (rule.min >= 0.0 && rule.max < unbounded) return fmt::format(" {} .. {}", rule.min, rule.max);
  return rule.min >= 0.0 ? fmt::format(" >= {}", rule.min) : std::string();
}

std::string expectation(const Rule& rule, std::size_t into_size) {
  switch (rule.want) {
    case Want::object:
      return "an object";
    case Want::objects:
      return fmt::format("an array of at most {} objects", rule.size);
    case Want::index:
      return fmt::format("an index into {} ({} there)", rule.into, into_size);
    case Want::indices:
      return fmt::format("an array of indices into {} ({} there)", rule.into, into_size);
    case Want::named_indices:
      return fmt::format("an object of indices into {} ({} there)", rule.into, into_size);
    case Want::natural:
      return rule.words.empty() ? fmt::format("an integer{}", range_text(rule)) : fmt::format("one of {}", rule.words);
    case Want::number:
      return fmt::format("a number{}", range_text(rule));
    case Want::numbers:
      return fmt::format("{} numbers{}", rule.size, range_text(rule));
    case Want::text:
      return rule.words.empty() ? "a string" : fmt::format("one of {}", rule.words);
    case Want::texts:
      return "an array of strings";
    case Want::flag:
      return "true or false";
  }
  return {};
}

std::string shown(const json& value) {
  if (value.is_array() && value.size() > 16) return fmt::format("an array of {} elements", value.size());
  if (value.is_object()) return "an object";
  std::string text = value.dump();
  if (text.size() > 80) text = text.substr(0, 60) + "...";
  return text;
}

/// What is wrong with a value that breaks its rule, and what was expected; of named indices, the first that is none.
std::string complaint(const Rule& rule, const json& value, std::size_t into_size) {
  if (rule.want == Want::named_indices && value.is_object()) {
    const Rule of_one{.want = Want::index, .into = rule.into};
    for (const auto& [name, index] : value.items())
      if (!fits(of_one, index, into_size))
        return fmt::format("{} {} is {}, expected {}", rule.key, name, shown(index), expectation(of_one, into_size));
  }
  return fmt::format("{} is {}, expected {}", rule.key, shown(value), expectation(rule, into_size));
}

/// Checks one rule below `place`, everywhere it applies.
void check_rule(const json& document, std::string_view place, const Rule& rule, const std::string& file) {
  const std::string path =
      place.empty() || rule.at.empty() ? fmt::format("{}{}", place, rule.at) : fmt::format("{}/{}", place, rule.at);
  const std::size_t into_size = rule.into.empty() ? 0 : array_size(document, rule.into);
  std::vector<std::size_t> indices;
  for_each_at(document, path, indices, [&](const json& object, const std::vector<std::size_t>& where) {
    const auto found = object.find(rule.key);
    const bool there = found != object.end();
    if (there ? fits(rule, *found, into_size) : !rule.required) return;
    gltf_fail(file, element_name(path, where),
              there ? complaint(rule, *found, into_size)
                    : fmt::format("{} is missing, expected {}", rule.key, expectation(rule, into_size)));
  });
}

/// A camera and a spot light hold an object that is named like their type.
void check_typed(const json& document, std::string_view path, std::string_view type, const std::string& file) {
  std::vector<std::size_t> indices;
  for_each_at(document, path, indices, [&](const json& object, const std::vector<std::size_t>& where) {
    if (object.at("type") != type || object.contains(type)) return;
    gltf_fail(file, element_name(path, where), fmt::format("{0} is missing, expected an object, as type is {0}", type));
  });
}

}  // namespace

void check_gltf(const json& document, const std::string& file) {
  if (!document.is_object()) gltf_fail(file, "", "the JSON is not an object, expected a glTF document");
  for (const Rule& rule : gltf_rules()) check_rule(document, {}, rule, file);
  for (const std::string_view place : gltf_texture_places()) {
    for (const Rule& rule : gltf_texture_rules()) check_rule(document, place, rule, file);
  }
  check_typed(document, "cameras/*", "perspective", file);
  check_typed(document, "cameras/*", "orthographic", file);
  check_typed(document, "extensions/KHR_lights_punctual/lights/*", "spot", file);
}

}  // namespace lamp::app
