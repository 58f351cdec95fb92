// lamp report: the page of a run again, or of two runs beside each other.
// SPDX-License-Identifier: Apache-2.0
#include "bench/report.h"
#include "files/utf8_path.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>

#include "bench/results.h"
#include "commands/commands.h"
#include "commands/pictures.h"
#include "image/write_file.h"
#include "system/print.h"

namespace lamp::app {
namespace {

struct ReportOptions {
  std::vector<std::string> files;
  std::string out = "report.html";
};

Exit report(const ReportOptions& o) {
  constexpr std::string_view EXTENSIONS[] = {".html"};
  check_output("--out", o.out, EXTENSIONS);
  std::vector<ReportRun> runs;
  for (const std::string& file : o.files)
    runs.push_back({.results = load_results(utf8_path(file)), .file = utf8_path(file)});
  const std::string page = report_html(runs);
  write_output(utf8_path(o.out), [&](const auto& file) { write_file(file, page); });
  print_out("report: {}\n", o.out);
  return Exit::done;
}

}  // namespace

Run add_report(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "Make the page of a bench again, or compare the results of two");
  auto o = std::make_shared<ReportOptions>();
  command->add_option("results", o->files, "results.json of a bench, and of a second one to compare it with")
      ->type_name("FILE")
      ->required()
      ->expected(1, 2);
  add_out_option(*command, o->out, "write the page to this file, .html");
  command->footer(
      "Examples:\n"
      "  lamp report out/quick/results.json --out quick.html\n"
      "  lamp report before/results.json after/results.json --out compared.html");
  return [o] { return report(*o); };
}

}  // namespace lamp::app
