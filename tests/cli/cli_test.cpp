// Starts a process with its output in pipes, and reads them until it has ended.
// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_test.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace lamp::cli {

/// What the child writes into one end comes out of the other.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) ADD_FAILURE() << "no pipe";
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  std::string drain() {
    close(std::exchange(ends[1], -1));
    std::string text;
    std::array<char, 4096> block{};
    for (ssize_t count = 0; (count = ::read(ends[0], block.data(), block.size())) != 0;) {
      if (count < 0 && errno != EINTR) break;
      if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
    }
    return text;
  }
};

namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> environment_with(const Environment& more) {
  std::vector<std::string> all;
  for (char** variable = environ; *variable != nullptr; ++variable) all.emplace_back(*variable);
  for (const auto& [name, value] : more) {
    std::string entry = name;
    entry += '=';
    std::erase_if(all, [&](const std::string& old) { return old.starts_with(entry); });
    entry += value;
    all.push_back(std::move(entry));
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  all.reserve(texts.size() + 1);
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

CliTest::CliTest() {
  // What `auto` chooses must not depend on how fast this machine is.
  setenv("LAMPLIGHT_CALIBRATION", LAMPLIGHT_SOURCE_DIR "/tests/calibration.json", /* overwrite= */ 1);
}

struct Running::Pipes {
  Pipe out;
  Pipe err;
};

Running::Running(std::unique_ptr<Pipes> pipes, int process) : pipes_(std::move(pipes)), process_(process) {}

Running::~Running() = default;

void Running::send(int signal) const { EXPECT_EQ(kill(process_, signal), 0); }

Outcome Running::finish() {
  if (process_ == 0) return {};
  // What `lamp` writes to stderr fits a pipe's buffer (64 KiB), so that reading one after the other cannot block it.
  Outcome outcome;
  outcome.out = pipes_->out.drain();
  outcome.err = pipes_->err.drain();
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  return outcome;
}

Running CliTest::start_program(Arguments words, const Environment& environment) const {
  std::vector<std::string> variables = environment_with(environment);
  auto pipes = std::make_unique<Running::Pipes>();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder_.path().c_str());
  posix_spawn_file_actions_adddup2(&actions, pipes->out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipes->err.ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, words.front().c_str(), &actions, nullptr, pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) ADD_FAILURE() << words.front() << " cannot be started";
  return Running(std::move(pipes), failed == 0 ? child : 0);
}

Running CliTest::start(const Arguments& arguments, const Environment& environment) const {
  Arguments words{LAMP_EXECUTABLE};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return start_program(std::move(words), environment);
}

Outcome CliTest::lamp(const Arguments& arguments, const Environment& environment) const {
  return start(arguments, environment).finish();
}

Outcome CliTest::shell(const std::string& script) const {
  return start_program({"/bin/sh", "-c", script}, {{"LAMP", LAMP_EXECUTABLE}}).finish();
}

std::string CliTest::output_of(const Arguments& arguments) const {
  Outcome outcome = lamp(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return std::move(outcome.out);
}

nlohmann::json CliTest::json_of(const Arguments& arguments) const {
  const std::string text = output_of(arguments);
  nlohmann::json json = nlohmann::json::parse(text, nullptr, /* allow_exceptions= */ false);
  EXPECT_FALSE(json.is_discarded()) << "no JSON: " << text;
  return json;
}

void CliTest::expect_error(int exit_code, const Arguments& arguments, const std::vector<std::string>& parts,
                           const Environment& environment) const {
  std::string command = "lamp";
  for (const std::string& argument : arguments) command += " " + argument;
  SCOPED_TRACE(command);
  const std::vector<std::string> before = files();
  const Outcome outcome = lamp(arguments, environment);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("lamp: ")) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\n")) << outcome.err;
  for (const std::string& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << "\"" << part << "\" is not in: " << outcome.err;
  EXPECT_EQ(files(), before);
}

std::string CliTest::read(const std::string& name) const { return read_file(path(name)); }

void CliTest::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(path(name), std::ios::binary) << bytes;
}

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
    names.push_back(fs::relative(entry.path(), folder_.path()).string());
  std::ranges::sort(names);
  return names;
}

Arguments small(const Arguments& command) {
  Arguments all = command;
  for (const char* word : {"--scene", "plane", "--lights", "8", "--size", "64x36"}) all.emplace_back(word);
  return all;
}

std::pair<unsigned, unsigned> size_of_png(const std::string& bytes) {
  const auto number_at = [&](std::size_t at) {
    unsigned number = 0;
    for (std::size_t i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes.at(at + i));
    return number;
  };
  return {number_at(16), number_at(20)};
}

}  // namespace lamp::cli
