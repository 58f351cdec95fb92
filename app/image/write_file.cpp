// A file appears whole or not at all: temporary name, checked close, rename.
// SPDX-License-Identifier: Apache-2.0
#include "image/write_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include "error.h"
#include "image/image.h"
#include "system/file_access.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr int MOST_LINKS = 40;  // as many as Linux follows

[[noreturn]] void fail(const fs::path& file, int error_number, const char* expected) {
  throw Error(fmt::format("{}: cannot be written: {}; expected {}", file.string(),
                          std::generic_category().message(error_number), expected));
}

/// An open file. What an Error names is another name, the one that the user knows.
class Output {
 public:
  Output(const fs::path& named, const fs::path& path, Opening how) : named_(named), file_(open_to_write(path, how)) {
    if (file_ == nullptr) fail(named_, errno, "a folder that exists and is writable");
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (file_ != nullptr) std::fclose(file_);
  }
  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(named_, errno, "room for it");
    // The last bytes arrive now.
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(named_, errno, "room for it");
  }

 private:
  const fs::path& named_;
  std::FILE* file_;
};

}  // namespace

fs::path followed(fs::path file) {
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(file, error)); ++links) {
    if (links == MOST_LINKS) fail(file, ELOOP, "a link that leads somewhere");
    const fs::path next = fs::read_symlink(file, error);
    if (error) fail(file, error.value(), "a link that leads somewhere");
    file = file.parent_path() / next;
  }
  return file;
}

void write_file(const fs::path& file, std::string_view bytes) {
  const fs::path target = followed(file);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) {
    throw Error(fmt::format("{}: is a folder; expected the name of a file", file.string()));
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) return Output(file, target, Opening::existing).write(bytes);
  std::optional<Output> output;
  Temporary temporary(Temporary::Removal::everything, [&] {
    const fs::path name = temporary_name(target);
    output.emplace(file, name, Opening::new_file);
    return name;
  });
  output->write(bytes);
  try {
    temporary.move_to(target);
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("{}: cannot be replaced: {}", file.string(), failure.code().message()));
  }
}

void write_text(const fs::path& file, std::string_view text) { write_file(file, text); }

}  // namespace lamp::app
