// What the build put into the tool: suites, a calibration, the report's template and chart library, the commit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace lamp::app {

struct EmbeddedFile {
  std::string_view name;  ///< without folder
  std::string_view text;
};

/// Everything in bench/suites.
[[nodiscard]] std::span<const EmbeddedFile> suite_files();
/// bench/calibrations/software.json: of a software device, llvmpipe on two cores.
[[nodiscard]] std::span<const EmbeddedFile> calibration_files();
/// Everything in bench/report, and chart.min.js.
[[nodiscard]] std::span<const EmbeddedFile> report_files();
/// Everything in packaging/completion: lamp.bash and so on.
[[nodiscard]] std::span<const EmbeddedFile> completion_files();

/// The commit that the tool was built from, as `git describe` names it, or "unknown".
[[nodiscard]] std::string_view built_from();

}  // namespace lamp::app
