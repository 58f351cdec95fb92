// A JSON object that is read strictly: every key must be known, every value of the type that was asked for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lamp::app {

/// An object of a suite.
class SuiteJson {
 public:
  /// `where` begins every error: "quick.json: series 'cull'". Throws Error if it is no object.
  SuiteJson(const nlohmann::json& json, std::string where);
  SuiteJson(const nlohmann::json&&, std::string) = delete;  // the object is referred to, so it must outlive this

  /// Whether the object has the key; from here on, the key is known.
  [[nodiscard]] bool has(std::string_view key);
  /// The value at a key that the object has.
  [[nodiscard]] const nlohmann::json& at(std::string_view key) const;

  /// Each leaves `out` as it is when the key is missing, and throws Error when its value is of another kind.
  void read(std::string_view key, std::string& out);
  void read(std::string_view key, bool& out);
  void read(std::string_view key, std::uint32_t& out, std::uint64_t min, std::uint64_t max);
  void read(std::string_view key, std::uint64_t& out);
  void read(std::string_view key, double& out, double min, double max);
  void read(std::string_view key, std::vector<std::string>& out);
  void read(std::string_view key, std::vector<double>& out, double min, double max);
  void read(std::string_view key, std::vector<std::uint32_t>& out, std::uint64_t min, std::uint64_t max);
  void require(std::string_view key, std::string& out);

  /// Throws Error for a key that nobody asked for, with the nearest that there are.
  void finish() const;

  [[noreturn]] void wrong(std::string_view key, const std::string& expected) const;
  [[noreturn]] void missing(std::string_view key, const std::string& expected) const;
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const nlohmann::json& json_;
  std::string where_;
  std::vector<std::string> known_;
};

}  // namespace lamp::app
