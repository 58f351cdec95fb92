// A folder of its own in the system's folder for temporary files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "error.h"

namespace lamp::app {

/// Goes away with its owner, with all that is in it.
class TemporaryFolder {
 public:
  /// Throws an Error if none can be made.
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lamp-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw Error("no temporary folder can be made in " + name);
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lamp::app
