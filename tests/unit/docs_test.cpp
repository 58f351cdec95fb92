// The documents say what the code says: a block marked with "from FILE" stands in that file, word for word.
// Pages of methods are complete.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "lamplight/version.h"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Docs, QuotesStandInTheFilesTheyName) {
  constexpr std::string_view MARK = "<!-- from ";
  int quotes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(LAMPLIGHT_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = read(entry.path());
    for (std::size_t at = text.find(MARK); at != std::string::npos; at = text.find(MARK, at + 1)) {
      const std::size_t name = at + MARK.size();
      const std::string file = text.substr(name, text.find(" -->", name) - name);
      const std::size_t begin = text.find('\n', text.find("```", name)) + 1;
      const std::string quote = text.substr(begin, text.find("```", begin) - begin);
      EXPECT_NE(read(fs::path(LAMPLIGHT_SOURCE_DIR) / file).find(quote), std::string::npos)
          << entry.path() << ": not in " << file << ":\n"
          << quote;
      ++quotes;
    }
  }
  EXPECT_GE(quotes, 10);
}

// A command that is taken over without its end would hand both include folders to the compiler as one.
TEST(Docs, CommandsOfCMakeArePrintedToTheirEnd) {
  int commands = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(LAMPLIGHT_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = read(entry.path());
    constexpr std::string_view BLOCK = "```cmake\n";
    for (std::size_t at = text.find(BLOCK); at != std::string::npos; at = text.find(BLOCK, at + 1)) {
      const std::size_t begin = at + BLOCK.size();
      const std::string block = text.substr(begin, text.find("```", begin) - begin);
      if (block.find("COMMAND ") == std::string::npos) continue;
      EXPECT_NE(block.find("add_custom_command("), std::string::npos) << entry.path() << ":\n" << block;
      EXPECT_NE(block.find("COMMAND_EXPAND_LISTS VERBATIM)\n"), std::string::npos) << entry.path() << ":\n" << block;
      ++commands;
    }
  }
  EXPECT_GE(commands, 3);
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

TEST(Docs, TheCitationNamesThisVersion) {
  const std::string version = "\nversion: " + std::string(lamp::version()) + "\n";
  EXPECT_NE(read(fs::path(LAMPLIGHT_SOURCE_DIR) / "CITATION.cff").find(version), std::string::npos) << version;
}

// The page for those who create the device has every feature that is asked for, and no other.
TEST(Docs, WhatToEnableNamesEveryRequiredFeature) {
  const fs::path root(LAMPLIGHT_SOURCE_DIR);
  const std::string page = read(root / "docs" / "what-to-enable.md");
  const std::string table = page.substr(page.find("| feature |"), page.find("## Optional") - page.find("| feature |"));
  const auto asked = matches(read(root / "lib" / "src" / "vulkan" / "device.cpp"),
                             std::regex("function\\(features\\.[a-z0-9.]*[a-zA-Z0-9]+, \"(\\w+)\"\\)"));
  EXPECT_GE(asked.size(), 7);
  EXPECT_EQ(matches(table.substr(0, table.rfind('|')), std::regex("`([a-z][a-zA-Z0-9]+)`")), asked);
}

// Index pages aside, every page of docs/methods shows its idea in a picture and says what it costs, where it wins and
// loses, how to try it and whose idea it is; and the index leads to it.
TEST(Docs, PagesOfMethodsAreComplete) {
  const fs::path folder = fs::path(LAMPLIGHT_SOURCE_DIR) / "docs" / "methods";
  const std::string index = read(folder / "README.md");
  int pages = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    SCOPED_TRACE(name);
    const std::string text = read(entry.path());
    EXPECT_NE(index.find("(" + name + ")"), std::string::npos) << "docs/methods/README.md has no link to it";
    EXPECT_NE(text.find("](../images/"), std::string::npos) << "has no picture";
    for (const char* heading : {"## How it works", "## Cost", "## Where (it|each) wins", "## Where (it|each) loses",
                                "## Try it", "## (Papers?|Source)"})
      EXPECT_TRUE(std::regex_search(text, std::regex("(^|\n)" + std::string(heading)))) << "has no heading " << heading;
    ++pages;
  }
  EXPECT_GE(pages, 15);
}

// Pictures that pages show are in the repository, and tools/pictures knows how to make them.
TEST(Docs, PicturesAreThereAndCanBeMadeAnew) {
  const fs::path docs = fs::path(LAMPLIGHT_SOURCE_DIR) / "docs";
  const std::string maker = read(fs::path(LAMPLIGHT_SOURCE_DIR) / "tools" / "pictures");
  const std::regex picture("\\]\\(\\.\\./images/([a-z0-9_]+)\\.png\\)");
  for (const auto& entry : fs::directory_iterator(docs / "methods")) {
    const std::string text = read(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), picture), end; at != end; ++at) {
      const std::string name = (*at)[1];
      EXPECT_TRUE(fs::exists(docs / "images" / (name + ".png"))) << entry.path() << ": " << name;
      EXPECT_TRUE(std::regex_search(maker, std::regex("\\b" + name + "\\b"))) << "tools/pictures: no " << name;
    }
  }
}

}  // namespace
