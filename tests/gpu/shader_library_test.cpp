// Shaders of a checkout: compiled once, and again when a file has changed.
// SPDX-License-Identifier: Apache-2.0
#include "render/shader_library.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "error.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* SHADER = "methods/world_scan";

class SourceTree : public ::testing::Test {
 protected:
  SourceTree() {
    for (const char* root : {"lib/shaders", "lib/include", "app/render/shaders"}) {
      fs::create_directories(folder_.path() / root);
      fs::copy(fs::path(LAMPLIGHT_SOURCE_DIR) / root, folder_.path() / root, fs::copy_options::recursive);
    }
  }
  ~SourceTree() override { setenv("PATH", path_.c_str(), 1); }
  void SetUp() override {
    if (std::system("glslc --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "glslc is not installed here";
  }
  SourceTree(const SourceTree&) = delete;
  SourceTree& operator=(const SourceTree&) = delete;

  /// Nobody finds glslc any more.
  static void lose_compiler() { setenv("PATH", "/nonexistent", 1); }
  void append(const std::string& file, const std::string& text) const {
    const fs::path path = folder_.path() / file;
    const fs::file_time_type before = fs::last_write_time(path);
    std::ofstream(path, std::ios::app) << text;
    while (fs::last_write_time(path) == before) fs::last_write_time(path, fs::file_time_type::clock::now());
  }

  std::string path_ = std::getenv("PATH");
  TemporaryFolder folder_;
  ShaderLibrary library_{folder_.path()};
};

TEST_F(SourceTree, IsCompiledOnceByAllCopiesOfALibrary) {
  const ShaderLibrary copy = library_;
  const std::vector<std::uint32_t> words = library_.spirv(SHADER);
  lose_compiler();
  EXPECT_EQ(copy.spirv(SHADER), words);
  EXPECT_THROW((void)library_.spirv("methods/world_merge"), Error);
}

TEST_F(SourceTree, HasAHashOfAllThatShadersMayInclude) {
  const std::string hash = hash_of_shaders(folder_.path());
  EXPECT_EQ(hash_of_shaders(folder_.path()), hash);
  EXPECT_EQ(hash_of_shaders(LAMPLIGHT_SOURCE_DIR), hash) << "where the tree is does not matter";
  const fs::path file = folder_.path() / "lib/include/lamplight/shared/world.h";
  fs::rename(file, folder_.path() / "lib/include/lamplight/shared/worlds.h");
  EXPECT_NE(hash_of_shaders(folder_.path()), hash);
  fs::rename(folder_.path() / "lib/include/lamplight/shared/worlds.h", file);
  EXPECT_EQ(hash_of_shaders(folder_.path()), hash);
  append("lib/include/lamplight/shared/world.h", "// a comment\n");
  EXPECT_NE(hash_of_shaders(folder_.path()), hash);
}

TEST_F(SourceTree, IsCompiledAnewWhenAnythingInItHasChanged) {
  const std::vector<std::uint32_t> words = library_.spirv(SHADER);
  append("lib/shaders/common/group_scan.glsl", "\n// a comment changes no code\n");
  EXPECT_EQ(library_.spirv(SHADER), words);
  append("lib/shaders/common/group_scan.glsl", "\nno shader\n");
  EXPECT_THROW((void)library_.spirv(SHADER), Error);
}

}  // namespace
}  // namespace lamp::app
