// What the tool's code does in one place, it does nowhere else; default bindings of look-ups.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <string_view>

namespace {

namespace fs = std::filesystem;

/// What only some files of app/ may say, and what to use instead.
struct Reserved {
  const char* text;
  std::string_view files;
  const char* instead;
};

// fmt::print and streams throw or stay silent when stdout is closed or full.
constexpr Reserved RESERVED[] = {
    {"fmt::print(", "", "system/print.h"},
    {"std::cout", "", "system/print.h"},
    {"std::cerr", "", "system/print.h"},
    {"fwrite(", "print.cpp write_file.cpp", "system/print.h or image/write_file.h"},
    // While it waits, std::system ignores SIGINT.
    {"std::system(", "", "system/run_program.h"},
    {"popen(", "", "system/run_program.h"},
    // What is half-written when a signal ends the program would stay, and a stream does not say why it fails.
    {"ofstream", "", "image/write_file.h"},
    {"temp_directory_path(", "temporary_folder.h", "temporary_folder.h"},
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
      EXPECT_TRUE(reserved.files.find(path.filename().string()) != std::string_view::npos ||
                  text.find(reserved.text) == std::string::npos)
          << path << " says " << reserved.text << "; use " << reserved.instead;
  }
  EXPECT_GT(files, 100);
}

/// What only one system has is in files of its own, which the build chooses from.
TEST(Sources, OfOneSystemSayItInTheirName) {
  const std::regex of_one(
      R"(#include <(unistd|fcntl|dlfcn|spawn|pthread|io|process|windows|sys/\w+)\.h>|#if.*(_WIN32|__linux__|__unix__))");
  for (const char* folder : {"app", "oracle", "lib/src"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(LAMPLIGHT_SOURCE_DIR) / folder)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".cpp" && path.extension() != ".h") continue;
      const std::string stem = path.stem().string();
      if (stem.ends_with("_posix") || stem.ends_with("_windows")) continue;
      std::ifstream stream(path, std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      EXPECT_FALSE(std::regex_search(text, of_one)) << path << ": NAME_posix.cpp and NAME_windows.cpp may";
    }
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
