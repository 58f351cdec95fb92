// A folder of its own in the system's folder for temporary files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "error.h"
#include "files/utf8_path.h"
#include "system/temporary.h"

namespace lamp::app {

/// Goes away with its owner, with all that is in it.
class TemporaryFolder {
 public:
  /// Throws an Error if none can be made.
  TemporaryFolder() : folder_(Temporary::Removal::everything, make) {}
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

 private:
  static std::filesystem::path make() {
    namespace fs = std::filesystem;
    std::error_code error;
    const char* named = std::getenv("TMPDIR");
    fs::path folder = named != nullptr && *named != '\0' ? utf8_path(named) : fs::temp_directory_path(error);
    folder /= unique_name();
    if (!error && !fs::create_directory(folder, error) && !error) error = std::make_error_code(std::errc::file_exists);
    if (!error) fs::permissions(folder, fs::perms::owner_all, error);
    if (error)
      throw Error(folder.string() + ": no temporary folder can be made: " + error.message() +
                  "; expected TMPDIR to name a folder that is writable");
    return folder;
  }

  Temporary folder_;
};

}  // namespace lamp::app
