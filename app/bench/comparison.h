// Two runs beside each other, matched by what was measured: ratios within them are fair, across devices they are
// context.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lamp::app {

/// A configuration that both runs have times of.
struct ComparedRow {
  std::string key;  ///< without the number of frames and what was verified
  std::string series, label;
  std::size_t a = 0;  ///< places in "results"
  std::size_t b = 0;
  double cull_ratio = 0.0;  ///< b's median over a's; 0: a's is 0
  double cull_shade_ratio = 0.0;
  double frame_ratio = 0.0;
};

/// Geometric means of the ratios of one line of a series.
struct ComparedLine {
  std::string series, label;
  std::size_t count = 0;
  double cull_ratio = 0.0;
  double cull_shade_ratio = 0.0;
  double frame_ratio = 0.0;
};

struct Comparison {
  std::vector<ComparedRow> rows;
  std::vector<ComparedLine> lines;
  std::size_t only_a = 0;  ///< timed in one run alone
  std::size_t only_b = 0;
  std::size_t other_scene = 0;  ///< timed in both, but a file of the scene changed between them: left out
};
[[nodiscard]] Comparison compare_runs(const nlohmann::json& a, const nlohmann::json& b);

[[nodiscard]] nlohmann::json to_json(const Comparison& comparison);

}  // namespace lamp::app
