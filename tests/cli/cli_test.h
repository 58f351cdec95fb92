// Runs the built `lamp` as its users do, in an empty folder of its own, and holds what it says against the promises:
// results on stdout, one line on stderr for what is wrong, exit codes, nothing left behind.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "temporary_folder.h"

namespace lamp::cli {

inline constexpr int BAD_INPUT = 2;  ///< the exit code

/// What a run of `lamp` left.
struct Outcome {
  int exit_code = -1;  ///< -1: it was ended by a signal
  std::string out;     ///< stdout
  std::string err;     ///< stderr
};

using Arguments = std::vector<std::string>;
/// Environment variables that the run has besides the test's own.
using Environment = std::vector<std::pair<std::string, std::string>>;

class CliTest : public ::testing::Test {
 protected:
  CliTest();

  /// Runs `lamp` in the test's folder, its output in pipes.
  [[nodiscard]] Outcome lamp(const Arguments& arguments, const Environment& environment = {}) const;

  /// Runs it and expects exit code 0 and nothing on stderr.
  [[nodiscard]] std::string output_of(const Arguments& arguments) const;
  [[nodiscard]] nlohmann::json json_of(const Arguments& arguments) const;

  /// Runs it and expects this exit code, no output, one line on stderr that starts with "lamp: " and has all `parts`,
  /// and no new file.
  void expect_error(int exit_code, const Arguments& arguments, const std::vector<std::string>& parts,
                    const Environment& environment = {}) const;

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] std::string read(const std::string& name) const;
  void write(const std::string& name, const std::string& bytes) const;
  /// Names of everything in the test's folder, sorted.
  [[nodiscard]] std::vector<std::string> files() const;

 private:
  app::TemporaryFolder folder_;
};

/// A scene and a picture so small that a software device takes no time.
[[nodiscard]] Arguments small(const Arguments& command);

}  // namespace lamp::cli
