// What tests ask of a system in its own way.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace lamp::test {

/// Sets a variable of the environment and gives it back as it was.
class Variable {
 public:
  Variable(std::string name, const std::string& value);
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable();
  static void set(const std::string& name, const std::string& value);

 private:
  std::string name_;
  std::optional<std::string> before_;
};

/// While one exists, no file of this process may grow beyond it, as on a full disk. Windows has none: is_there() is
/// false.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uint64_t bytes);
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit();
  [[nodiscard]] static bool is_there();

 private:
  std::uint64_t before_ = 0;
  void (*handler_)(int) = nullptr;
};

/// Whether std::filesystem makes links here: not in libstdc++ for Windows.
[[nodiscard]] bool has_links();
inline constexpr const char* NO_LINKS = "std::filesystem makes no links here";

/// A pipe with a name, which nobody writes to; false: the system has none.
[[nodiscard]] bool make_pipe(const std::filesystem::path& file);

}  // namespace lamp::test
