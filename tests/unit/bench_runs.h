// Runs of a small suite for tests of results: times that are known, of no device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/results.h"
#include "error.h"

namespace lamp::test {

using nlohmann::json;

inline const app::RunInfo RUN{.command = "lamp bench mine.json",
                              .device = "Device <1>",
                              .device_kind = "discrete GPU",
                              .driver = "driver 2",
                              .commit = "abc",
                              .date = "today"};

inline app::Suite suite_of(const std::string& members) {
  return app::parse_suite(R"({"version": 1, "name": "mine", "series": [{"name": "one", )" + members + "}]}",
                          "mine.json");
}

inline const app::Suite SWEEP = suite_of(R"("methods": ["tiled", "tight"], "lights": [16, 64])");

/// A result with these times of the cull, 2 ms of shading besides.
inline json result_of(const app::Group& group, const app::GroupEntry& entry, double cull_ms) {
  const json cull = app::to_json(app::Spread{cull_ms, cull_ms, cull_ms, cull_ms, 0.0});
  const json shade = app::to_json(app::Spread{2.0, 2.0, 2.0, 2.0, 0.0});
  const json both = app::to_json(app::Spread{cull_ms + 2.0, cull_ms + 2.0, cull_ms + 2.0, cull_ms + 2.0, 0.0});
  return {{"series", group.series},
          {"key", app::key_of(group, entry)},
          {"label", entry.label},
          {"parameters",
           {{"scene", group.scene},
            {"size", group.size},
            {"lights", group.lights},
            {"spots", group.spots},
            {"range", "automatic"},
            {"camera", "first"},
            {"projection", group.projection},
            {"path", entry.path},
            {"method", entry.name}}},
          {"verdict", "exact"},
          {"reason", ""},
          {"times", {{"cull", cull}, {"shade", shade}, {"cull+shade", both}, {"frame", both}}},
          {"stats",
           {{"passes", json::array()},
            {"bytes", {{"total", 100}}},
            {"missed", 0},
            {"useful", 5},
            {"options", {{"tile", "16"}}}}}};
}

/// A whole run; the cull of `tight` takes as many milliseconds as there are lights / 8, that of `tiled` 4.
inline json run_of(const app::Suite& suite, const app::RunInfo& run = RUN, double factor = 1.0) {
  json results = app::new_results(run, suite);
  for (const app::Group& group : app::expand(suite, {}).groups) {
    std::vector<json> entries;
    for (const app::GroupEntry& entry : group.entries)
      entries.push_back(result_of(group, entry, factor * (entry.name == "tight" ? group.lights / 8.0 : 4.0)));
    app::add_group(results, entries);
  }
  results["run"]["complete"] = true;
  return results;
}

inline std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const app::Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace lamp::test
