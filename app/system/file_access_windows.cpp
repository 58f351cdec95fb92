// By handles, and by the C library's descriptors where errno has to say why.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include "system/file_access.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

/// A file that nobody else can open, and that goes when it is closed.
HANDLE open_own(const std::filesystem::path& file) {
  return CreateFileW(file.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS,
                     FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
}

}  // namespace

/// Tries it: what a folder allows is a matter of its owner, of lists and of the disk.
bool is_writable(const std::filesystem::path& folder) {
  const HANDLE file = open_own(temporary_name(folder / "file"));
  return file != INVALID_HANDLE_VALUE && CloseHandle(file) != 0;
}

std::FILE* open_to_write(const std::filesystem::path& file, Opening how) {
  const int flags = how == Opening::new_file ? _O_CREAT | _O_EXCL : _O_TRUNC;
  const int descriptor = _wopen(file.c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT | flags, _S_IREAD | _S_IWRITE);
  return descriptor < 0 ? nullptr : _fdopen(descriptor, "wb");
}

/// A file of that name in the folder, which a process that ends cannot leave behind.
FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(reinterpret_cast<std::intptr_t>(open_own(folder / ".lamp-lock"))),
      is_taken_(reinterpret_cast<HANDLE>(file_) == INVALID_HANDLE_VALUE && GetLastError() == ERROR_SHARING_VIOLATION) {}

FolderLock::~FolderLock() {
  if (reinterpret_cast<HANDLE>(file_) != INVALID_HANDLE_VALUE) CloseHandle(reinterpret_cast<HANDLE>(file_));
}

}  // namespace lamp::app
