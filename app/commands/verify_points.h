// lamp verify --points: look-ups by position at random points, against the oracle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "commands/request.h"

namespace lamp::app {

struct PointsRequest {
  std::vector<std::string> methods;  ///< empty: all that have a look-up by position
  std::uint32_t points = 0;          ///< of each kind
  bool json = false;
  std::string cut;  ///< file of a picture, or empty
};

/// Adds `--points` and `--cut`.
void add_points_option(CLI::App& command, PointsRequest& of);

/// Prints a row for each method and kind of points. Throws Error for a method without such a look-up.
[[nodiscard]] Exit verify_points(const Request& request, const PointsRequest& of);

}  // namespace lamp::app
