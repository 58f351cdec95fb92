// The folder that `lamp bench` writes to: results.json, results.csv, report.html, pictures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "system/file_access.h"

namespace lamp::app {

/// Made where it is not there, and one run's alone as long as this lives.
class BenchFolder {
 public:
  /// Throws Error where it cannot be made or written to, and while another run has it.
  explicit BenchFolder(const std::string& out);

 private:
  FolderLock lock_;
};

/// Throws Error for a suite's file that the results would replace.
void check_own_file(const std::string& out, const std::string& suite);

/// Those that no result names.
void remove_pictures(const std::filesystem::path& folder, const nlohmann::json& results);

void write_all(const std::filesystem::path& folder, const nlohmann::json& results);

}  // namespace lamp::app
