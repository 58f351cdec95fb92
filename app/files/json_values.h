// Values of a JSON document that a user wrote: each is what was expected, or an Error names file and element.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamp::app {

/// An object of a document, and how errors call it: the file, and the element within ("light 3"; empty: all of it).
struct JsonObject {
  const nlohmann::json& json;
  std::string file;
  std::string element;

  /// Throws Error: file, element, then `problem`.
  [[noreturn]] void fail(std::string_view problem) const;
  /// Throws Error unless this is an object with no keys but these.
  void check_keys(std::span<const std::string_view> known) const;
  [[nodiscard]] bool has(std::string_view key) const { return json.contains(key); }

  [[nodiscard]] const nlohmann::json& at(std::string_view key, std::string_view expected) const;
  [[nodiscard]] std::uint32_t whole(std::string_view key, std::uint32_t min, std::uint32_t max) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count) const;
  [[nodiscard]] std::string text(std::string_view key, std::string_view expected) const;
  [[nodiscard]] float real(std::string_view key) const { return static_cast<float>(number(key)); }
  [[nodiscard]] glm::vec3 vector(std::string_view key) const;
};

/// A value as errors show it: on one line, not long.
[[nodiscard]] std::string shown(const nlohmann::json& value);

}  // namespace lamp::app
