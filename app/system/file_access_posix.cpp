// By descriptors.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "system/file_access.h"

namespace lamp::app {

bool is_writable(const std::filesystem::path& folder) { return access(folder.c_str(), W_OK) == 0; }

std::FILE* open_to_write(const std::filesystem::path& file, Opening how) {
  const int flags = how == Opening::new_file ? O_CREAT | O_EXCL : O_TRUNC;
  const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  return descriptor < 0 ? nullptr : fdopen(descriptor, "wb");
}

FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      is_taken_(file_ >= 0 && flock(static_cast<int>(file_), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(static_cast<int>(file_));
}

}  // namespace lamp::app
