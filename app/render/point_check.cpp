// Compares walks with the truth, point by point.
// SPDX-License-Identifier: Apache-2.0
#include "render/point_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>

namespace lamp::app {
namespace {

void check_point(std::size_t point, std::span<const std::uint32_t> found, std::span<const std::uint32_t> truth,
                 std::size_t lights, WalkOrder order, PointFindings& findings) {
  findings.evaluations += found.size();
  findings.useful += truth.size();
  findings.list_max = std::max<std::uint64_t>(findings.list_max, found.size());
  findings.nowhere += std::ranges::count_if(found, [&](std::uint32_t light) { return light >= lights; });
  std::vector<std::uint32_t> sorted(found.begin(), found.end());
  const bool ascends = std::ranges::adjacent_find(found, std::greater_equal{}) == found.end();
  if (!ascends) std::ranges::sort(sorted);
  if (!ascends && order == WalkOrder::ascending) ++findings.unordered;
  if (order == WalkOrder::any && std::ranges::adjacent_find(sorted) != sorted.end()) ++findings.repeated;
  std::vector<std::uint32_t> missing;
  std::ranges::set_difference(truth, sorted, std::back_inserter(missing));
  if (!missing.empty() && findings.missed == 0) findings.first_miss = {.point = point, .light = missing.front()};
  findings.missed += missing.size();
}

}  // namespace

void PointFindings::add(const PointFindings& more, std::size_t first) {
  if (missed == 0 && more.missed != 0) first_miss = {first + more.first_miss.point, more.first_miss.light};
  missed += more.missed;
  evaluations += more.evaluations;
  useful += more.useful;
  reaching += more.reaching;
  boundary_pairs += more.boundary_pairs;
  list_max = std::max(list_max, more.list_max);
  unordered += more.unordered;
  repeated += more.repeated;
  nowhere += more.nowhere;
  unfollowed += more.unfollowed;
}

double PointFindings::waste() const { return waste_of(evaluations, useful); }

Verdict PointFindings::verdict() const {
  if (missed != 0 || unordered != 0 || repeated != 0 || nowhere != 0) return Verdict::failed;
  return unfollowed != 0 ? Verdict::unchecked : Verdict::ok;
}

std::string PointFindings::reason() const {
  if (missed != 0)
    return fmt::format("misses {} pairs of point and light, the first: point {}, light {}", missed, first_miss.point,
                       first_miss.light);
  if (unordered != 0) return fmt::format("the lights of {} points do not ascend", unordered);
  if (repeated != 0) return fmt::format("the walks of {} points name a light twice", repeated);
  if (nowhere != 0) return fmt::format("names {} lights that there are not", nowhere);
  return unfollowed == 0 ? "" : fmt::format("the device ended the walks of {} points before their end", unfollowed);
}

PointFindings check_points(const PointLights& found, const PointTruth& truth, std::size_t lights, WalkOrder order) {
  PointFindings findings{.boundary_pairs = truth.boundary_pairs};
  for (std::size_t point = 0; point + 1 < truth.offsets.size(); ++point) {
    if (found.ended[point] != 0)
      ++findings.unfollowed;
    else
      check_point(point, found.of(point), truth.of(point), lights, order, findings);
  }
  return findings;
}

}  // namespace lamp::app
