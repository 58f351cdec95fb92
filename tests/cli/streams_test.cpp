// Whatever stdout and stderr are: closed, full, a pipe that nobody reads. `lamp` ends with an exit code that says what
// happened, never by an abort, and what it prints never gets into a file.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <sstream>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using Streams = CliTest;

constexpr const char* UNWRITABLE[] = {">&-", ">/dev/full"};

/// Every command, as quick as it can be; and every way in which the command line ends early.
constexpr const char* COMMANDS[] = {
    "render plane --size 16x9 --lights 2 --method tiled",
    "render plane --size 16x9 --lights 2 --method tiled --json",
    "render plane --size 16x9 --lights 2 --explain",
    "verify plane --size 16x9 --lights 2 --method tiled",
    "verify plane --size 16x9 --lights 2 --method tiled --json",
    "compare tiled all plane --size 16x9 --lights 2",
    "compare tiled all plane --size 16x9 --lights 2 --json",
    "capture plane --size 16x9 --lights 2 --out frame",
    "bench plane --size 16x9 --lights 2 --method tiled --frames 1 --out bench",
    "report bench/results.json",
    "list methods",
    "list methods --json",
    "list scenes",
    "list suites",
    "list devices",
    "info plane",
    "info plane --json",
    "completion bash",
    "help",
    "help render",
    "",
    "--help",
    "render --help",
    "--version",
};

TEST_F(Streams, ResultsThatCannotBePrintedAreAnError) {
  (void)output_of(
      {"bench", "plane", "--size", "16x9", "--lights", "2", "--method", "tiled", "--frames", "1", "--out", "bench"});
  for (const char* command : COMMANDS)
    for (const char* where : UNWRITABLE) {
      SCOPED_TRACE(std::string(command) + " " + where);
      const Outcome outcome = shell(std::string("$LAMP ") + command + " " + where);
      EXPECT_EQ(outcome.exit_code, BAD_INPUT);
      EXPECT_TRUE(outcome.err.starts_with("lamp: standard output: cannot be written: ")) << outcome.err;
    }
}

// `script` runs a program on a terminal of its own.
TEST_F(Streams, ASummaryFitsTheTerminal) {
  if (shell("command -v script").exit_code != 0) GTEST_SKIP() << "there is no script(1)";
  const Outcome outcome = shell(
      "script --quiet --return --command \"stty cols 60; $LAMP render plane --size 16x9 --lights 2 --method "
      "clustered\" "
      "log </dev/null");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("\ntimes "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n          "), std::string::npos) << outcome.out;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 61U) << line;  // a terminal adds \r
}

TEST_F(Streams, ErrorsThatCannotBePrintedKeepTheirExitCode) {
  for (const char* where : UNWRITABLE)
    for (const char* command : {"render nowhere", "rendr", "render --size 0x0", "list nothing", "bench nowhere.json"}) {
      SCOPED_TRACE(std::string(command) + " 2" + where);
      const Outcome outcome = shell(std::string("$LAMP ") + command + " 2" + where);
      EXPECT_EQ(outcome.exit_code, BAD_INPUT);
      EXPECT_EQ(outcome.out, "");
    }
  EXPECT_EQ(shell("$LAMP render nowhere >/dev/full 2>/dev/full").exit_code, BAD_INPUT);
  EXPECT_EQ(shell("$LAMP list methods >&- 2>&-").exit_code, BAD_INPUT);
  EXPECT_EQ(shell("$LAMP list methods <&- >&- 2>&-").exit_code, BAD_INPUT);
  EXPECT_EQ(shell("VK_DRIVER_FILES=/nonexistent $LAMP list devices 2>/dev/full").exit_code, 3);
}

TEST_F(Streams, AClosedErrorStreamDisturbsNobody) {
  EXPECT_EQ(shell("$LAMP render plane --size 16x9 --lights 2 --method tiled --out lamp.png 2>&-").exit_code, 0);
  EXPECT_TRUE(read("lamp.png").starts_with("\x89PNG"));
  // What was to be said there is lost: that is no success.
  const std::string explain = "$LAMP render plane --size 16x9 --lights 2 --json --explain --out lamp.png";
  for (const char* where : UNWRITABLE) {
    const Outcome outcome = shell(explain + " 2" + where);
    EXPECT_EQ(outcome.exit_code, BAD_INPUT) << where;
    EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << outcome.out;
  }
}

// The next file to be opened takes the number of a closed stream.
TEST_F(Streams, NothingThatIsPrintedGetsIntoAFile) {
  EXPECT_EQ(shell("$LAMP render nowhere.gltf --out a.png 2>&-").exit_code, BAD_INPUT);
  EXPECT_EQ(shell("$LAMP capture plane --size 16x9 --lights 2 --out frame <&- >&- 2>&-").exit_code, BAD_INPUT);
  const nlohmann::json again = json_of({"verify", "frame", "--method", "tiled", "--json"});
  EXPECT_EQ(again.at(0).at("missed"), 0);
}

TEST_F(Streams, APipeThatNobodyReadsEndsItQuietly) {
  for (const char* command : {"list methods", "list methods --json", "--help", "render --help"}) {
    SCOPED_TRACE(command);
    const Outcome outcome = shell(std::string("{ sleep 0.2; $LAMP ") + command +
                                  "; echo $? >code; } | true; while [ ! -s code ]; do :; done");
    EXPECT_EQ(read("code"), std::to_string(128 + SIGPIPE) + "\n");
    EXPECT_EQ(outcome.err, "");
    std::filesystem::remove(path("code"));
  }
}

TEST_F(Streams, APipeThatNobodyReadsIsAnErrorForThoseWhoIgnoreTheSignal) {
  const Outcome outcome =
      shell("trap '' PIPE; { sleep 0.2; $LAMP list methods; echo $? >code; } | true; while [ ! -s code ]; do :; done");
  EXPECT_EQ(read("code"), "2\n");
  EXPECT_EQ(outcome.err, "lamp: standard output: cannot be written: Broken pipe\n");
}

TEST_F(Streams, AnErrorIntoAPipeThatNobodyReadsKeepsItsExitCode) {
  (void)shell(
      "{ sleep 0.2; $LAMP render nowhere 2>&1 >/dev/null; echo $? >code; } | true; while [ ! -s code ]; do :; done");
  EXPECT_EQ(read("code"), "2\n");
}

/// What the script says on a terminal that is stderr.
std::string on_a_terminal(const std::function<Outcome(const std::string& terminal)>& run) {
  const int controller = posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_TRUE(controller >= 0 && grantpt(controller) == 0 && unlockpt(controller) == 0);
  const std::string terminal = ptsname(controller);
  const int held = open(terminal.c_str(), O_RDWR | O_NOCTTY);  // so that what was written is kept
  EXPECT_EQ(run(terminal).exit_code, 0);
  std::string text(65536, '\0');
  fcntl(controller, F_SETFL, O_NONBLOCK);
  const ssize_t count = ::read(controller, text.data(), text.size());
  close(held);
  close(controller);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return text;
}

TEST_F(Streams, ProgressIsShownOnATerminalUnlessItIsHidden) {
  const auto verify = [&](const std::string& more) {
    return on_a_terminal([&](const std::string& terminal) {
      return shell("$LAMP verify plane --size 16x9 --lights 2 --method tiled" + more + " 2>" + terminal);
    });
  };
  EXPECT_NE(verify("").find("\r\033[Kverify"), std::string::npos);
  EXPECT_EQ(verify(" -q"), "");
  EXPECT_EQ(verify(" --quiet"), "");
}

}  // namespace
}  // namespace lamp::cli
