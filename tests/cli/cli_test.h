// Runs the built `lamp` as its users do, in an empty folder of its own, and holds what it says against the promises:
// results on stdout, one line on stderr for what is wrong, exit codes, nothing left behind.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "temporary_folder.h"

namespace lamp::cli {

// Exit codes.
inline constexpr int BAD_INPUT = 2;
inline constexpr int UNCHECKED = 4;

/// What a run of `lamp` left.
struct Outcome {
  int exit_code = -1;  ///< -1: it was ended by a signal
  int signal = 0;      ///< which; 0: it ended by itself
  std::string out;     ///< stdout
  std::string err;     ///< stderr
};

/// A program that was started, its output in pipes.
class Running {
 public:
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running();
  void send(int signal) const;
  /// Reads its output until it ends.
  [[nodiscard]] Outcome finish();

 private:
  friend class CliTest;
  struct Pipes;
  explicit Running(std::unique_ptr<Pipes> pipes, int process);
  std::unique_ptr<Pipes> pipes_;
  int process_;
};

using Arguments = std::vector<std::string>;
/// Environment variables that the run has besides the test's own.
using Environment = std::vector<std::pair<std::string, std::string>>;

class CliTest : public ::testing::Test {
 protected:
  CliTest();

  /// Starts `lamp` in the test's folder.
  [[nodiscard]] Running start(const Arguments& arguments, const Environment& environment = {}) const;
  /// Runs it there.
  [[nodiscard]] Outcome lamp(const Arguments& arguments, const Environment& environment = {}) const;

  /// Runs a script of `sh` there, in which $LAMP is the executable.
  [[nodiscard]] Outcome shell(const std::string& script) const;

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
  [[nodiscard]] Running start_program(Arguments words, const Environment& environment) const;

  app::TemporaryFolder folder_;
};

/// A scene and a picture so small that a software device takes no time.
[[nodiscard]] Arguments small(const Arguments& command);

/// Of a PNG file's header: width, then height.
[[nodiscard]] std::pair<unsigned, unsigned> size_of_png(const std::string& bytes);

}  // namespace lamp::cli
