// Converts and checks the depth of captures.
// SPDX-License-Identifier: Apache-2.0
#include "scene/capture_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"

namespace lamp::app {
namespace {

constexpr double NEAR_ROUNDING = 1e-6;  // how far beyond 1 a pixel on the near plane may come out

const char* expectation(DepthKind kind) {
  switch (kind) {
    case DepthKind::reversed:
      return "device depth 0 (sky) .. 1 (near)";
    case DepthKind::standard:
      return "device depth 0 (near) .. 1 (sky)";
    case DepthKind::linear:
      break;
  }
  return "metres ahead of the eye, not before the near plane; 0 or infinity for sky";
}

/// NaN where there is no answer.
double reversed_depth(double given, DepthKind kind, const View& view) {
  if (kind == DepthKind::reversed) return given;
  if (kind == DepthKind::standard) return 1.0 - given;
  if (given == 0.0 || given == std::numeric_limits<double>::infinity()) return 0.0;
  const glm::dmat4& p = view.clip_from_view();
  const double depth = (p[3][2] - p[2][2] * given) / (p[3][3] - p[2][3] * given);
  if (!view.orthographic() && given < 0.0) return std::numeric_limits<double>::quiet_NaN();
  return depth > 1.0 && depth <= 1.0 + NEAR_ROUNDING ? 1.0 : std::max(depth, 0.0);
}

bool is_depth(float depth, const View& view) {
  if (depth == 0.0F) return true;
  const bool covered = depth > 0.0F && depth <= 1.0F;  // false for a NaN
  if (!covered) return false;
  const double z_view = view.z_view(depth);
  return std::abs(z_view) <= FURTHEST_M && (view.orthographic() || z_view > 0.0);
}

}  // namespace

void convert_depth(std::vector<float>& depth, DepthKind kind, const View& view, const std::string& file) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float given = depth[i];
    if (kind != DepthKind::reversed) depth[i] = static_cast<float>(reversed_depth(given, kind, view));
    if (!is_depth(depth[i], view))
      throw Error(fmt::format("{}: pixel ({}, {}) is {}, expected {}", file, i % view.width(), i / view.width(), given,
                              expectation(kind)));
  }
}

}  // namespace lamp::app
