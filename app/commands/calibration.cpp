// Finds the calibration that `auto` goes by.
// Promise: a damaged or foreign file in the cache is never trusted: a GPU is measured anew.
// SPDX-License-Identifier: Apache-2.0
#include "commands/calibration.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "bench/calibration_file.h"
#include "bench/embedded_files.h"
#include "files/utf8_path.h"
#include "system/print.h"

namespace lamp::app {
namespace {

KnownCalibration named_calibration(const std::string& file, const DeviceRow& row) {
  KnownCalibration known{.calibration = load_calibration(file, fmt::format("--calibration '{}'", file)),
                         .origin = file};
  if (known.calibration.device != row.name) known.origin += fmt::format(", of {}", known.calibration.device);
  return known;
}

KnownCalibration built_in_calibration() {
  const EmbeddedFile& file = calibration_files().front();
  KnownCalibration known{.calibration = parse_calibration(file.text, std::string(file.name)), .origin = {}};
  known.origin = fmt::format("built in, of {}; --calibration measure takes this machine's", known.calibration.device);
  return known;
}

}  // namespace

void check_calibration(const std::string& named, bool is_read) {
  const char* variable = std::getenv(CALIBRATION_VARIABLE);
  if (is_read || named.empty() || (variable != nullptr && named == variable)) return;
  throw Error(fmt::format("--calibration {}: is of auto alone; expected --method auto or --explain too", named));
}

KnownCalibration find_calibration(Context& context, const ShaderLibrary& shaders, const std::string& named) {
  const DeviceRow& row = context.row();
  if (!named.empty() && named != MEASURE) return named_calibration(named, row);
  const std::string file = cached_calibration_file(row.name, row.driver);
  if (named != MEASURE) {
    if (auto cached = read_cached_calibration(file, row.name, row.driver))
      return {.calibration = std::move(*cached), .origin = file};
    if (row.kind == "CPU") {
      if (std::error_code error; std::filesystem::exists(utf8_path(file), error))
        print_error("auto: {} is damaged, or of another version or driver: --calibration measure makes it anew\n",
                    file);
      return built_in_calibration();
    }
  }
  const bool terminal = shows_progress();
  if (terminal) print_error("auto: measures {} once ...", row.name);
  const auto begin = std::chrono::steady_clock::now();
  KnownCalibration known{.calibration = measure_calibration(context, shaders), .origin = {}};
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (terminal) print_error("\r\033[K");
  known.origin = fmt::format("measured just now in {:.1f} s", seconds);
  const std::string problem = keep_calibration(file, known.calibration);
  if (problem.empty())
    known.origin += ", kept in " + file;
  else
    print_error("auto: the calibration could not be kept, and is measured again next time: {}\n", problem);
  return known;
}

}  // namespace lamp::app
