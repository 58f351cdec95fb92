// Looks at what a path names, then reads it.
// SPDX-License-Identifier: Apache-2.0
#include "files/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const FileWanted& wanted, const std::string& problem) {
  throw Error(
      fmt::format("{}: {}, expected {}", wanted.name.empty() ? file.string() : wanted.name, problem, wanted.expected));
}

}  // namespace

std::uint64_t check_file(const fs::path& file, const FileWanted& wanted) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail(file, wanted, "is not there");
  if (status.type() == fs::file_type::none) fail(file, wanted, "cannot be looked at: " + error.message());
  if (status.type() == fs::file_type::directory) fail(file, wanted, "is a folder");
  if (status.type() != fs::file_type::regular) fail(file, wanted, "is not a regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail(file, wanted, "cannot be looked at: " + error.message());
  const std::uint64_t read = std::min<std::uint64_t>(size, wanted.first_bytes);
  if (read > wanted.most_bytes)
    fail(file, {.name = wanted.name, .expected = fmt::format("{} of at most {}", wanted.expected, wanted.most_bytes)},
         fmt::format("has {} bytes", read));
  return read;
}

std::vector<std::byte> read_file(const fs::path& file, const FileWanted& wanted) {
  std::vector<std::byte> bytes(check_file(file, wanted));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, wanted, "cannot be opened: " + std::generic_category().message(errno));
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    fail(file, wanted, fmt::format("ends after {} of its {} bytes", stream.gcount(), bytes.size()));
  return bytes;
}

bool stays_below(const fs::path& name) {
  const fs::path normal = name.lexically_normal();
  return !normal.empty() && !normal.has_root_path() && *normal.begin() != ".." &&
         normal.native().find('\0') == fs::path::string_type::npos;
}

}  // namespace lamp::app
