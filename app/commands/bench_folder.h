// The folder that `lamp bench` writes to: results.json, results.csv, report.html, pictures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lamp::app {

/// Makes it. Throws Error where it cannot be made or written to.
void check_folder(const std::string& out);

/// Throws Error for a suite's file that the results would replace.
void check_own_file(const std::string& out, const std::string& suite);

/// For results that are measured anew: no picture stays that none of the new ones names.
void remove_pictures(const std::filesystem::path& folder);

void write_all(const std::filesystem::path& folder, const nlohmann::json& results);

}  // namespace lamp::app
