// Look-ups are included by shaders that they know nothing of: what they declare begins as docs/integrating.md says.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

const std::filesystem::path LOOKUPS = LAMPLIGHT_SOURCE_DIR "/lib/shaders/lookup";

/// Names that a file declares outside of all braces.
std::vector<std::string> names_of(const std::filesystem::path& file) {
  static const std::array PATTERNS{std::regex(R"(#define (\w+))"), std::regex(R"(struct (\w+))"),
                                   std::regex(R"(LAMP_CONST\w* (\w+))"), std::regex(R"((?:const )?\w+ (\w+)\()"),
                                   std::regex(R"((?:const|shared) \w+ (\w+))")};
  std::vector<std::string> names;
  std::ifstream lines(file);
  std::ptrdiff_t depth = 0;
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find("//"));
    for (const std::regex& pattern : PATTERNS)
      if (std::smatch found;
          depth == 0 && std::regex_search(line, found, pattern, std::regex_constants::match_continuous))
        names.push_back(found[1]);
    depth += std::ranges::count(line, '{') - std::ranges::count(line, '}');
  }
  return names;
}

TEST(LookUpNames, BeginAsTheDocumentSays) {
  // What HLSL calls by another name, and macros that are there only while a look-up is included.
  const std::regex allowed(
      "(walk_|world_walk_|lookup_|LOOKUP_|LAMP_|Walk|Lookup|subgroup).*|(TREE|TILE|CELL_FIELD).*|SLICES|SLICE_SCALE|"
      "NEAR_MM|"
      "FAR_M");
  std::size_t names = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(LOOKUPS))
    if (entry.path().extension() == ".glsl")
      for (const std::string& name : names_of(entry.path())) {
        EXPECT_TRUE(std::regex_match(name, allowed)) << entry.path().filename() << " declares " << name;
        ++names;
      }
  EXPECT_GT(names, 100U);
}

}  // namespace
