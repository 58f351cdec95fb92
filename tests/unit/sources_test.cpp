// What the tool's code does in one place, it does nowhere else; default bindings of look-ups.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

/// A call that only one file of app/ may make, and what to use instead.
struct Reserved {
  const char* text;
  const char* file;
  const char* instead;
};

// fmt::print and streams throw or stay silent when stdout is closed or full.
constexpr Reserved RESERVED[] = {
    {"fmt::print(", "", "system/print.h"},
    {"std::cout", "", "system/print.h"},
    {"std::cerr", "", "system/print.h"},
    {"fwrite(", "print.cpp", "system/print.h"},
    // While it waits, std::system ignores SIGINT.
    {"std::system(", "", "system/run_program.h"},
    {"popen(", "", "system/run_program.h"},
    // What is half-written when a signal ends the program would stay, and a stream does not say why it fails.
    {"ofstream", "", "image/write_file.h"},
    {"mkdtemp(", "temporary_folder.h", "temporary_folder.h"},
};

TEST(Sources, KeepToTheirOwnMeans) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(LAMPLIGHT_SOURCE_DIR) / "app")) {
    const fs::path& path = entry.path();
    if (path.extension() != ".cpp" && path.extension() != ".h") continue;
    ++files;
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (const Reserved& reserved : RESERVED)
      EXPECT_TRUE(path.filename() == reserved.file || text.find(reserved.text) == std::string::npos)
          << path << " says " << reserved.text << "; use " << reserved.instead;
  }
  EXPECT_GT(files, 100);
}

/// A shader that includes several look-ups and says nothing else has one resource at each binding.
TEST(Sources, DefaultBindingsOfLookUpsDiffer) {
  const std::regex given(R"(#ifndef (\w+_BINDING)\s+#define \1 (\d+))");
  std::map<std::string, std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(LAMPLIGHT_SOURCE_DIR) / "lib" / "shaders")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (std::sregex_iterator found(text.begin(), text.end(), given), end; found != end; ++found) {
      const auto [other, is_new] = names.emplace((*found)[2], (*found)[1]);
      EXPECT_TRUE(is_new) << other->second << " and " << (*found)[1] << " are both " << (*found)[2];
    }
  }
  EXPECT_EQ(names.size(), 4U) << "look-ups, shadows, lists of triangles, the world tree";
}

}  // namespace
