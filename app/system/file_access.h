// What each system says and does about files in its own way.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>

namespace lamp::app {

/// Whether files can be made in the folder.
[[nodiscard]] bool is_writable(const std::filesystem::path& folder);

enum class Opening { new_file, existing };
/// A file to write bytes to, one that is not there yet or one that is, which is emptied. Null: errno says why.
[[nodiscard]] std::FILE* open_to_write(const std::filesystem::path& file, Opening how);

/// Keeps other processes that ask for the same from a folder.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  /// Whether another process has it. Some disks know no locks: there, none has.
  [[nodiscard]] bool is_taken() const { return is_taken_; }

 private:
  std::intptr_t file_;
  bool is_taken_;
};

}  // namespace lamp::app
