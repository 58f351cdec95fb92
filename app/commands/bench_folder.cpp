// Checks, empties and fills the folder.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>

#include "bench/report.h"
#include "bench/results.h"
#include "error.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "image/image.h"
#include "image/write_file.h"
#include "system/file_access.h"

namespace lamp::app {

namespace fs = std::filesystem;

namespace {

fs::path make_folder(const std::string& out) {
  const fs::path folder = fs::absolute(followed(utf8_path(out)));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("--out '{}': the folder cannot be made: {}", out, error.message()));
  if (!is_writable(folder)) throw Error(fmt::format("--out '{}': the folder is not writable", out));
  return folder;
}

}  // namespace

BenchFolder::BenchFolder(const std::string& out) : lock_(make_folder(out)) {
  if (lock_.is_taken())
    throw Error(fmt::format("--out '{}': another lamp bench writes to it, expected another folder", out));
}

void check_own_file(const std::string& out, const std::string& suite) {
  std::error_code none;
  if (fs::equivalent(utf8_path(suite), utf8_path(out) / "results.json", none))
    throw Error(fmt::format("--out '{}': its results.json is the suite, expected another folder", out));
}

void remove_pictures(const fs::path& folder, const nlohmann::json& results) {
  std::set<std::string> named;
  for (const nlohmann::json& result : results.at("results"))
    if (const auto pictures = result.find("pictures"); pictures != result.end())
      for (const nlohmann::json& picture : *pictures) named.insert(picture.get<std::string>());
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "pictures", none))
    if (entry.path().extension() == ".png" && !named.contains("pictures/" + entry.path().filename().string()))
      fs::remove(entry.path(), none);
}

void write_all(const fs::path& folder, const nlohmann::json& results) {
  write_text(folder / "results.json", json_text(results, 1) + "\n");
  write_text(folder / "results.csv", results_csv(results));
  const ReportRun run{.results = results, .file = folder / "results.json"};
  write_text(folder / "report.html", report_html({&run, 1}));
}

}  // namespace lamp::app
