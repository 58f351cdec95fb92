// Files and folders that are there for a while.
// Promise: they go with their owner, and before a signal ends the program. Nothing can be done about SIGKILL.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lamp::app {

class Temporary {
 public:
  enum class Removal { everything, if_empty };  ///< of a folder; a file is removed in any case

  /// `make` makes the file or the folder, and says where. When it throws, there is nothing to remove.
  Temporary(Removal removal, const std::function<std::filesystem::path()>& make);
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Moves it to its place, where it stays. What is there already becomes the temporary instead, and goes. Throws
  /// filesystem_error when the system refuses; then everything is where it was.
  void move_to(const std::filesystem::path& place);
  /// It stays where it is.
  void keep();

 private:
  std::filesystem::path path_;
};

/// The folders that are missing on the way to a place, and the place itself. They go again, where they are empty,
/// unless they are kept.
class NewFolders {
 public:
  /// Makes them. Throws filesystem_error when the system refuses.
  explicit NewFolders(const std::filesystem::path& place);
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  ~NewFolders();
  void keep();

 private:
  void remove();

  std::vector<std::unique_ptr<Temporary>> made_;  ///< from the outermost to the innermost
};

/// "lamp-1c9a2f0b7d3e4856-0": a name that no other process or thread takes.
[[nodiscard]] std::string unique_name();
/// The same, hidden and beside `place`.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& place);

/// Removes all that there are, and lets no thread make, move or remove another one: the program is about to end.
void remove_temporaries_for_good();

}  // namespace lamp::app
