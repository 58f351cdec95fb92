// Fuzzes results: any bytes give results or an Error. What is made of results that were taken, the table, the page of
// one run and of two, a run that goes on, is made of these as well, or an Error says why not.
// Seeds: corpus_results/. Build with -DLAMPLIGHT_FUZZ=ON; pictures are looked for in a folder that does not exist.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "bench/regret.h"
#include "bench/report.h"
#include "bench/results.h"
#include "error.h"

namespace {

using lamp::app::ReportRun;

void expect(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nlohmann::json results;
  try {
    results = lamp::app::parse_results({reinterpret_cast<const char*>(data), size}, "fuzz.json");
  } catch (const lamp::app::Error&) {
    return 0;
  }
  expect(!lamp::app::results_csv(results).empty());
  nlohmann::json again = results;
  expect(lamp::app::take_over(again, results, {}) == results["results"].size());
  lamp::app::add_regret(again);
  static_cast<void>(lamp::app::regret_words(again));
  const ReportRun run{.results = again, .file = "/nonexistent/results.json"};
  try {
    expect(!lamp::app::report_html({&run, 1}).empty());
    const ReportRun runs[] = {run, run};
    expect(!lamp::app::report_html(runs).empty());
  } catch (const lamp::app::Error&) {
    return 0;
  }
  return 0;
}
