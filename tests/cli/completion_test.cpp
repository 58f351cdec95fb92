// lamp completion: the words that may end a line, and scripts that bring them into shells.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

class Completion : public CliTest {
 protected:
  [[nodiscard]] std::vector<std::string> words(const std::string& line) const {
    std::istringstream lines(output_of({"completion", "words", "--", line}));
    std::vector<std::string> all;
    for (std::string word; std::getline(lines, word);) all.push_back(word);
    return all;
  }
  void expect_words(const std::string& line, const std::vector<std::string>& expected) const {
    EXPECT_EQ(words(line), expected) << line;
  }
  void expect_among(const std::string& line, const std::string& word) const {
    const std::vector<std::string> all = words(line);
    EXPECT_TRUE(std::ranges::find(all, word) != all.end()) << line << ": no " << word;
  }
};

TEST_F(Completion, OfCommandsAndOptions) {
  expect_words("lamp ren", {"render"});
  expect_words("lamp help com", {"compare", "completion"});
  expect_words("lamp render --heat", {"--heatmap", "--heatmap-of"});
  expect_words("lamp render --heatmap-of sh", {"shadow-age", "shadow-size", "shadow-leaks"});
  expect_words("lamp verify --ver", {"--verifier"});
  expect_words("lamp --vers", {"--version"});
  expect_among("lamp ", "verify");
  expect_words("lamp nothing ", {});
  expect_words("lam", {});
}

TEST_F(Completion, OfValues) {
  expect_words("lamp render --path def", {"deferred"});
  expect_words("lamp render atr", {"atrium"});
  expect_words("lamp render --size 8x8 --json atr", {"atrium"});
  expect_words("lamp render atrium bl", {});
  expect_words("lamp info --json blo", {"blocks"});
  expect_words("lamp verify --method lampl", {"lamplight"});
  expect_words("lamp render --method tiled --option ti", {"tile="});
  expect_words("lamp render --method tiled --option tile=", {"tile=8", "tile=16", "tile=32"});
  expect_words("lamp compare all tiled:tile=8,tile=1", {"tiled:tile=8,tile=16"});
  expect_words("lamp compare tiled:til", {"tiled:tile="});
  expect_words("lamp list sui", {"suites"});
  expect_words("lamp list methods tiled-b", {"tiled-bits"});
  expect_words("lamp bench stewart-f", {"stewart-flight"});
  expect_words("lamp render --method=tiled-b", {"--method=tiled-bits"});
  expect_words("lamp render --method=tiled --option ti", {"tile="});
  expect_words("lamp render --method=tiled --option=tile=1", {"--option=tile=16"});
  expect_words("lamp list pipelines tiled-b", {"tiled-bits"});
  expect_words("lamp compare --panels pos", {"posts"});
  expect_words("lamp compare --panels tig", {});
  expect_words("lamp compare --panels posts ", {});
  expect_words("lamp probe --at 1 ", {});
  expect_words("lamp probe --at 1 2 -3 atr", {"atrium"});
  expect_words("lamp render --out lam", {});  // a file: the shell's own
}

TEST_F(Completion, OfEveryCommandsOptionsIsComplete) {
  for (const std::string& command : words("lamp "))
    for (const std::string& option : words("lamp " + command + " --"))
      EXPECT_NE(output_of({"help", command}).find(option), std::string::npos) << command << ' ' << option;
}

TEST_F(Completion, InBash) {
  const auto replies = [this](const std::string& line) {
    const std::string script = "eval \"$($LAMP completion bash)\"; COMP_LINE='" + line +
                               "' COMP_POINT=" + std::to_string(line.size()) +
                               "; _lamp \"$LAMP\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
    write("ask.bash", script);
    const Outcome outcome = shell("bash ask.bash");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_EQ(replies("lamp rend"), "render\n");
  EXPECT_EQ(replies("lamp render --method tiled --option tile=1"), "16\n");
  EXPECT_EQ(replies("lamp render --method=tiled-b"), "tiled-bits\n");
  EXPECT_EQ(replies("lamp compare tiled:tile=3"), "32\n");
}

TEST_F(Completion, OfAShellThatIsNone) {
  expect_error(BAD_INPUT, {"completion", "fsh"}, {"'fsh'", "nearest are fish, "});
  expect_error(BAD_INPUT, {"completion", "bash", "lamp"}, {"argument 'lamp'"});
}

}  // namespace
}  // namespace lamp::cli
