// Fuzzes calibrations: any bytes give a calibration or an Error, and what is written out is read back the same.
// Seeds: corpus_calibration/. Build with -DLAMPLIGHT_FUZZ=ON; no file is opened.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "bench/calibration_file.h"
#include "error.h"
#include "files/read_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const lamp::Calibration read = lamp::app::parse_calibration(text, "fuzz.json");
    const std::string written = lamp::app::json_text(lamp::app::to_json(read), 1);
    const lamp::Calibration again = lamp::app::parse_calibration(written, "again.json");
    if (again.device != read.device || again.costs.size() != read.costs.size()) std::abort();
    for (std::size_t i = 0; i < read.costs.size(); ++i)
      if (again.costs[i].cull != read.costs[i].cull || again.costs[i].shade != read.costs[i].shade) std::abort();
  } catch (const lamp::app::Error&) {
    return 0;
  }
  return 0;
}
