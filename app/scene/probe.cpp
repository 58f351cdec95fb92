// The order of probes.
// SPDX-License-Identifier: Apache-2.0
#include "scene/probe.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

namespace lamp::app {

double volume_of(const Probe& probe) {
  const glm::dvec3 half(probe.half_extents);
  const double share = probe.shape == ProbeShape::box ? 1.0 : std::numbers::pi / 6.0;
  return 8.0 * half.x * half.y * half.z * share;
}

std::vector<std::uint32_t> by_volume(const std::vector<Probe>& probes) {
  std::vector<std::uint32_t> order(probes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(volume_of(probes[i]), i); });
  return order;
}

}  // namespace lamp::app
