// Temporaries: gone with their owner, kept when asked to, and none where none can be made.
// SPDX-License-Identifier: Apache-2.0
#include "system/temporary.h"

#include <gtest/gtest.h>

#include <fstream>

#include "image/write_file.h"
#include "temporary_folder.h"
#include "unit/this_system.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

class Temporaries : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] std::size_t entries() const {
    const fs::recursive_directory_iterator all(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

 private:
  TemporaryFolder folder_;
};

std::function<fs::path()> made_file(const fs::path& path) {
  return [path] {
    std::ofstream(path) << "new";
    return path;
  };
}

std::function<fs::path()> made_folder(const fs::path& path) {
  return [path] {
    fs::create_directory(path);
    std::ofstream(path / "inside") << "new";
    return path;
  };
}

std::string content(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_F(Temporaries, GoWithTheirOwner) {
  {
    const Temporary file(Temporary::Removal::everything, made_file(path("file")));
    const Temporary folder(Temporary::Removal::everything, made_folder(path("folder")));
    EXPECT_EQ(entries(), 3U);
  }
  EXPECT_EQ(entries(), 0U);
}

TEST_F(Temporaries, StayWhereTheyAreMovedTo) {
  std::ofstream(path("place")) << "old";
  fs::create_directory(path("frame"));
  std::ofstream(path("frame/old")) << "old";
  {
    Temporary file(Temporary::Removal::everything, made_file(path("file")));
    Temporary folder(Temporary::Removal::everything, made_folder(path("folder")));
    file.move_to(path("place"));
    folder.move_to(path("frame"));
  }
  EXPECT_EQ(content(path("place")), "new");
  EXPECT_EQ(content(path("frame/inside")), "new");
  EXPECT_EQ(entries(), 3U) << "what was there before is still there";
}

TEST_F(Temporaries, AMoveThatFailsChangesNothing) {
  fs::create_directory(path("frame"));
  {
    Temporary file(Temporary::Removal::everything, made_file(path("file")));
    EXPECT_THROW(file.move_to(path("nowhere/place")), fs::filesystem_error);
    EXPECT_EQ(content(path("file")), "new");
  }
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Temporaries, NewFoldersGoUnlessTheyAreKeptOrUsed) {
  {
    const NewFolders folders(path("a/b/c"));
  }
  EXPECT_EQ(entries(), 0U);
  {
    const NewFolders folders(path("a/b/c"));
    std::ofstream(path("a/used")) << "by somebody";
  }
  EXPECT_EQ(entries(), 2U);
  {
    NewFolders folders(path("a/b/c"));
    folders.keep();
  }
  EXPECT_EQ(entries(), 4U);
}

TEST_F(Temporaries, AFolderThatCannotBeMadeIsNamedWithTheReason) {
  write_file(path("file"), "no folder");
  for (const fs::path& folder : {path("nowhere"), path("file")}) {
    std::error_code reason;
    fs::create_directory(folder / "new", reason);
    const test::Variable named("TMPDIR", folder.string());
    try {
      const TemporaryFolder none;
      ADD_FAILURE() << "a folder in " << folder;
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_TRUE(line.starts_with((folder / "lamp-").string())) << line;
      EXPECT_NE(line.find(reason.message()), std::string::npos) << line;
    }
  }
}

TEST_F(Temporaries, FilesAreWrittenThroughLinks) {
  if (!test::has_links()) GTEST_SKIP() << test::NO_LINKS;
  fs::create_directory(path("folder"));
  fs::create_symlink("folder/target", path("dangling"));
  fs::create_symlink("dangling", path("link"));
  write_file(path("link"), "first");
  write_file(path("link"), "second");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_symlink(path("dangling")));
  EXPECT_EQ(content(path("folder/target")), "second");
  fs::create_symlink("circle", path("circle"));
  try {
    write_file(path("circle"), "x");
    ADD_FAILURE() << "a circle of links";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("Too many levels of symbolic links"), std::string::npos) << error.what();
  }
}

TEST_F(Temporaries, FileNamesMayBeAsLongAsTheSystemTakes) {
  const std::string name(255, 'x');
  write_file(path(name), "all of it");
  EXPECT_EQ(content(path(name)), "all of it");
  EXPECT_EQ(entries(), 1U);
}

}  // namespace
}  // namespace lamp::app
