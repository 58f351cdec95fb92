// Temporaries: gone with their owner, kept when asked to, and gone before a signal ends the program.
// SPDX-License-Identifier: Apache-2.0
#include "system/temporary.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>

#include "image/write_file.h"
#include "system/signals.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

/// Its folder is none of those that it tests: a child process that is ended would remove it.
class Temporaries : public ::testing::Test {
 protected:
  Temporaries() {
    std::string name = fs::temp_directory_path() / "temporaries-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~Temporaries() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::size_t entries() const {
    const fs::recursive_directory_iterator all(folder_);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

 private:
  fs::path folder_;
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

/// Does that in a child process; the signal that ended it.
int signal_that_ended(const std::function<void()>& what) {
  const pid_t child = fork();
  if (child == 0) {
    for (const int ended_by : {SIGHUP, SIGINT, SIGTERM}) std::signal(ended_by, SIG_DFL);  // nohup ignores one
    watch_signals();
    what();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

/// Sends this process a signal, and waits for its end.
[[noreturn]] void end_by(int signal) {
  kill(getpid(), signal);
  for (;;) pause();
}

TEST_F(Temporaries, GoBeforeASignalEndsTheProgram) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    EXPECT_EQ(signal, signal_that_ended([&] {
                const NewFolders folders(path("a/b"));
                const Temporary file(Temporary::Removal::everything, made_file(path("a/b/file")));
                const Temporary folder(Temporary::Removal::everything, made_folder(path("folder")));
                end_by(signal);
              }));
    EXPECT_EQ(entries(), 0U);
  }
}

TEST_F(Temporaries, AStopRequestTakesTheFirstSignal) {
  const auto ask = [&](bool again) {
    const StopRequest stop;
    kill(getpid(), SIGTERM);
    kill(getpid(), SIGTERM);  // a shell may send it twice
    while (StopRequest::signal() != SIGTERM) usleep(1000);
    usleep(1'100'000);
    if (again) end_by(SIGTERM);
  };
  EXPECT_EQ(signal_that_ended([&] { ask(false); }), 0);
  EXPECT_EQ(signal_that_ended([&] { ask(true); }), SIGTERM);
}

TEST_F(Temporaries, AFolderThatCannotBeMadeIsNamedWithTheReason) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  for (const auto& [folder, reason] : {std::pair{path("nowhere").string(), "No such file or directory"},
                                       {std::string("/dev/null"), "Not a directory"}}) {
    setenv("TMPDIR", folder.c_str(), 1);
    try {
      const TemporaryFolder none;
      ADD_FAILURE() << "a folder in " << folder;
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_TRUE(line.starts_with(folder + "/lamp-")) << line;
      EXPECT_NE(line.find(reason), std::string::npos) << line;
    }
  }
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
}

TEST_F(Temporaries, FilesAreWrittenThroughLinks) {
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
