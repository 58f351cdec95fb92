// A file appears whole or not at all: temporary name, checked close, rename.
// SPDX-License-Identifier: Apache-2.0
#include "image/write_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

#include "error.h"
#include "image/image.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

std::string system_says(int error_number) { return std::generic_category().message(error_number); }

/// Removes the temporary file unless it was renamed.
class Temporary {
 public:
  explicit Temporary(const fs::path& file) : path_(file) {
    static std::atomic<std::uint32_t> number = 0;
    path_ += fmt::format(".{}-{}.tmp", getpid(), number++);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    std::error_code ignored;  // it may never have been made
    if (!path_.empty()) fs::remove(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }
  void rename_to(const fs::path& file) {
    fs::rename(path_, file);
    path_.clear();
  }

 private:
  fs::path path_;
};

/// `file` is what the message names; `path` is what is written.
void write_stream(const fs::path& file, const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  if (!stream) {
    throw Error(fmt::format("{}: cannot be written: {}; expected a folder that exists and is writable", file.string(),
                            system_says(errno)));
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();  // the last bytes reach the disk here, or do not
  if (!stream) {
    throw Error(fmt::format("{}: cannot be written: {}; expected room for {} bytes", file.string(), system_says(errno),
                            bytes.size()));
  }
}

}  // namespace

void write_file(const fs::path& file, std::string_view bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) {
    throw Error(fmt::format("{}: is a folder; expected the name of a file", file.string()));
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_stream(file, file, bytes);
  try {
    const fs::path target = fs::is_regular_file(status) ? fs::canonical(file) : file;  // follows a link
    Temporary temporary(target);
    write_stream(file, temporary.path(), bytes);
    temporary.rename_to(target);
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("{}: cannot be replaced: {}", file.string(), failure.code().message()));
  }
}

void write_text(const fs::path& file, std::string_view text) { write_file(file, text); }

}  // namespace lamp::app
