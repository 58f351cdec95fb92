// report.html: one file that opens without a network: results, words, charts, pictures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace lamp::app {

/// Results with where they came from.
struct ReportRun {
  nlohmann::json results;
  std::filesystem::path file;  ///< pictures lie beside it; a missing one is left out
};

/// The page of one run, or of two that are compared. Throws Error, naming the file, for results that are damaged.
[[nodiscard]] std::string report_html(std::span<const ReportRun> runs);

}  // namespace lamp::app
