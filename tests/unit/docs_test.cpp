// The documents say what the code says: a block marked with "from FILE" stands in that file, word for word.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

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

}  // namespace
