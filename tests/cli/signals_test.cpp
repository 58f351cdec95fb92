// Signals that end `lamp`: at any time, by that signal, and nothing half-written stays behind.
// SPDX-License-Identifier: Apache-2.0
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int ENDING[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

class Signals : public CliTest {
 protected:
  Signals() {
    std::filesystem::create_directory(path("tmp"));
    environment_ = {{"TMPDIR", path("tmp").string()}};
  }

  /// Starts it, waits until `is_there`, sends the signal, and expects that it ends by it, within a second or two.
  void expect_end(const Arguments& arguments, int signal, const std::function<bool()>& is_there) const {
    SCOPED_TRACE(strsignal(signal));
    Running running = start(arguments, environment_);
    const Clock::time_point begin = Clock::now();
    while (!is_there() && Clock::now() - begin < 60s) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(is_there()) << "it never got there";
    const Clock::time_point sent = Clock::now();
    running.send(signal);
    const Outcome outcome = running.finish();
    EXPECT_LT(Clock::now() - sent, 3s);
    EXPECT_EQ(outcome.signal, signal) << outcome.exit_code << outcome.err;
  }

  Environment environment_;
};

bool has_temporary(const std::filesystem::path& folder) {
  return std::ranges::any_of(std::filesystem::directory_iterator(folder),
                             [](const auto& entry) { return entry.path().filename().string().starts_with(".lamp-"); });
}

TEST_F(Signals, ACaptureThatIsBeingWrittenGoes) {
  for (const int signal : ENDING) {
    expect_end({"capture", "plane", "--size", "1920x1080", "--lights", "2", "--out", "new/frame"}, signal,
               [&] { return std::filesystem::exists(path("new")) && has_temporary(path("new")); });
    EXPECT_EQ(files(), std::vector<std::string>{"tmp"});
  }
}

TEST_F(Signals, TheCaptureThatWasThereStays) {
  (void)output_of({"capture", "plane", "--size", "16x9", "--lights", "2", "--out", "frame"});
  const std::vector<std::string> before = files();
  const std::string manifest = read("frame/frame.json");
  expect_end({"capture", "plane", "--size", "1920x1080", "--lights", "2", "--out", "frame"}, SIGTERM,
             [&] { return has_temporary(path("")); });
  EXPECT_EQ(files(), before);
  EXPECT_EQ(read("frame/frame.json"), manifest);
}

// The test's glslc says that it was started, and takes its time.
TEST_F(Signals, WhileShadersAreCompiled) {
  std::filesystem::create_directory(path("bin"));
  write("bin/glslc", "#!/bin/sh\n: >'" + path("started").string() + "'\nexec sleep 5\n");
  chmod(path("bin/glslc").c_str(), 0755);
  environment_.emplace_back("PATH", path("bin").string() + ":/usr/bin:/bin");
  for (const int signal : ENDING) {
    expect_end(small({"render", "--shader-dir", LAMPLIGHT_SOURCE_DIR}), signal,
               [&] { return std::filesystem::exists(path("started")); });
    std::filesystem::remove(path("started"));
    EXPECT_EQ(files(), (std::vector<std::string>{"bin", "bin/glslc", "tmp"}));
  }
}

TEST_F(Signals, InEveryLongPhase) {
  const Arguments commands[] = {
      {"render", "atrium", "--size", "3840x2160", "--lights", "100000", "--method", "all"},
      {"verify", "atrium", "--size", "1920x1080", "--lights", "16384"},
      {"compare", "all", "tiled", "atrium", "--size", "3840x2160", "--lights", "100000"},
      {"render", "plane", "--calibration", "measure"},
  };
  for (const Arguments& command : commands)
    for (const auto wait : {20ms, 600ms}) {  // while a scene is made, and while the device works
      SCOPED_TRACE(command.front());
      const Clock::time_point begin = Clock::now();
      expect_end(command, SIGINT, [&] { return Clock::now() - begin > wait; });
      EXPECT_EQ(files(), std::vector<std::string>{"tmp"});
    }
}

// A shell's background job and what `nohup` starts must not be ended by what they were told to ignore.
TEST_F(Signals, WhatWasIgnoredStaysIgnored) {
  const Outcome outcome = shell(
      "trap '' HUP INT; $LAMP render plane --size 64x36 --lights 2 --method tiled --out lamp.png & pid=$!\n"
      "kill -HUP $pid; kill -INT $pid; wait $pid");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace lamp::cli
