// What the walks of points were found to hold, against the oracle's truth.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "oracle/points.h"
#include "render/judgement.h"
#include "render/point_walks.h"

namespace lamp::app {

/// Sums over the points whose walk came to its end.
struct PointFindings {
  std::uint64_t missed = 0;          ///< pairs of point and light that the truth has and the walk has not
  std::uint64_t evaluations = 0;     ///< lights walked
  std::uint64_t useful = 0;          ///< lights of the truth
  std::uint64_t reaching = 0;        ///< lights that reach their point, seen or not; as useful where nothing hides them
  std::uint64_t boundary_pairs = 0;  ///< pairs in the boundary band, which are not checked
  std::uint64_t list_max = 0;
  std::uint64_t unordered = 0;   ///< points whose lights did not ascend, where they should
  std::uint64_t repeated = 0;    ///< points whose walk named a light twice, where they need not
  std::uint64_t nowhere = 0;     ///< lights walked that there are not
  std::uint64_t unfollowed = 0;  ///< points whose walk the device ended; of no other number here
  struct Miss {
    std::size_t point = 0;
    std::uint32_t light = 0;
  };
  Miss first_miss;  ///< where something is missed

  /// Of points behind `first` others.
  void add(const PointFindings& more, std::size_t first);
  [[nodiscard]] double waste() const;  ///< evaluations / useful; 1 when there is nothing to do and nothing done
  [[nodiscard]] Verdict verdict() const;
  [[nodiscard]] std::string reason() const;  ///< of a verdict that is not ok, one line
};

/// How a method's walks come (Plan::ordered).
enum class WalkOrder : std::uint8_t { ascending, any };
[[nodiscard]] inline WalkOrder order_of(const Plan& plan) {
  return plan.ordered ? WalkOrder::ascending : WalkOrder::any;
}

/// Both of the same points, of so many lights.
[[nodiscard]] PointFindings check_points(const PointLights& found, const PointTruth& truth, std::size_t lights,
                                         WalkOrder order = WalkOrder::ascending);

}  // namespace lamp::app
