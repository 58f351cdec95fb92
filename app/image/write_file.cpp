// A file appears whole or not at all: temporary name, checked close, rename.
// SPDX-License-Identifier: Apache-2.0
#include "image/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include "error.h"
#include "image/image.h"
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
  Output(const fs::path& named, const fs::path& path, int flags)
      : named_(named), descriptor_(open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666)) {
    if (descriptor_ < 0) fail(named_, errno, "a folder that exists and is writable");
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(named_, errno, "room for it");
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    if (close(std::exchange(descriptor_, -1)) != 0) fail(named_, errno, "room for it");  // the last bytes arrive now
  }

 private:
  const fs::path& named_;
  int descriptor_;
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
  if (fs::exists(status) && !fs::is_regular_file(status)) return Output(file, target, O_TRUNC).write(bytes);
  std::optional<Output> output;
  Temporary temporary(Temporary::Removal::everything, [&] {
    const fs::path name = temporary_name(target);
    output.emplace(file, name, O_CREAT | O_EXCL);
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
