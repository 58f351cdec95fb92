// A folder of its own in the system's folder for temporary files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "error.h"
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
    const char* named = std::getenv("TMPDIR");
    std::string name = std::filesystem::path(named != nullptr && *named != '\0' ? named : "/tmp") / "lamp-XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw Error(name + ": no temporary folder can be made: " + std::generic_category().message(errno) +
                  "; expected TMPDIR to name a folder that is writable");
    return name;
  }

  Temporary folder_;
};

}  // namespace lamp::app
