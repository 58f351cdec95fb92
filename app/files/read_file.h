// Files as every reader takes them: regular ones of a sensible size, whole.
// Promise: a folder, a pipe, a device or a file beyond its limit is an Error before anything is opened or allocated.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"

namespace lamp::app {

struct FileWanted {
  std::string name;                     ///< what errors begin with; empty: the file's path
  std::string expected = "a file";      ///< what errors say was expected
  std::uint64_t most_bytes = 1U << 30;  ///< a larger file is an error
  std::uint64_t first_bytes = ~0ULL;    ///< what is read of it
};

/// The bytes of a regular file. Throws Error: its name, why it is not read, what was expected.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file, const FileWanted& wanted);

/// The same check for files that a library opens; returns the size in bytes.
std::uint64_t check_file(const std::filesystem::path& file, const FileWanted& wanted);

/// Whether a name in a file leads to a place below that file's folder: relative, and without a way up out of it. Links
/// are not looked at.
[[nodiscard]] bool stays_below(const std::filesystem::path& name);

[[nodiscard]] inline std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Calls `read`. Where memory does not suffice, the Error says of what.
template <class Read>
auto within_memory(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw Error(name + ": does not fit into memory, expected less in it or more of that");
  }
}

}  // namespace lamp::app
