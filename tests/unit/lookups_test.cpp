// Look-ups stand in two languages, and say in one place where their resources lie.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

const fs::path LOOKUPS = fs::path(LAMPLIGHT_SOURCE_DIR) / "lib" / "shaders" / "lookup";

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(LookUps, HaveATwinInHlsl) {
  int twins = 0;
  for (const auto& entry : fs::directory_iterator(LOOKUPS)) {
    if (entry.path().extension() != ".glsl") continue;
    const std::string text = read(fs::path(entry.path()).replace_extension(".hlsl"));
    EXPECT_NE(text.find("#define LAMP_HLSL\n#include \"lookup/" + entry.path().filename().string() + "\"\n"),
              std::string::npos)
        << entry.path();
    ++twins;
  }
  EXPECT_GE(twins, 16);
}

// Those of fused shaders aside, whose bindings are those of a pass.
TEST(LookUps, LieWhereTheShaderSays) {
  const std::regex place("layout\\s*\\(|binding\\s*=|constant_id|#extension");
  for (const fs::path& folder : {LOOKUPS, LOOKUPS / "parts"})
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory() || name == "resources.glsl" || name == "subgroup.glsl" || name == "tile_shared.glsl")
        continue;
      EXPECT_FALSE(std::regex_search(read(entry.path()), place)) << entry.path();
    }
}

}  // namespace
