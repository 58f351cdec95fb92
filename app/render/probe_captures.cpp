// Which probes are captured, and captures them.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_captures.h"

#include <algorithm>
#include <utility>

#include "lamplight/shadow_atlas.h"

namespace lamp::app {
namespace {

/// Of a picture, that a probe may light: none is 0, so that those out of sight have their turn too.
float share_of(const gpu::ProbeData& probe, std::span<const View> views) {
  const shared::LightSphere sphere{.center = probe.volume.center,
                                   .radius = glm::length(glm::vec3(probe.volume.half_extents))};
  double most = 1e-6;
  for (const View& view : views) {
    const double across = shown_diameter_px(view, sphere) / std::max(view.width(), view.height());
    most = std::max(most, across * across);
  }
  return static_cast<float>(std::min(most, 1.0));
}

}  // namespace

ProbeCaptures::ProbeCaptures(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                             const ProbeCaptureInfo& info, std::vector<gpu::ProbeData> probes)
    : atlas_(context, shaders, static_cast<std::uint32_t>(probes.size())),
      capture_(context, shaders, scene, info),
      set_(context, atlas_, gpu::PROBES_CAPTURED, std::move(probes)),
      schedule_(static_cast<std::uint32_t>(set_.probes().size())) {}

void ProbeCaptures::renew(const Frame& frame, std::uint32_t budget, const std::function<void(double)>& progress) {
  const std::span<const gpu::ProbeData> probes = set_.probes();
  std::vector<ProbeDemand> demands;
  demands.reserve(probes.size());
  for (const gpu::ProbeData& probe : probes)
    demands.push_back({.share = share_of(probe, frame.views), .changed = frame.changed});
  const ProbeFrame scheduled = schedule_.schedule({.probes = demands, .budget = budget});
  counts_ = scheduled.counts;
  capture_.set(frame.lights, frame.decals);
  std::size_t done = 0;
  for (const std::uint32_t drawn : scheduled.draws) {
    if (progress) progress(static_cast<double>(done++) / static_cast<double>(scheduled.draws.size()));
    capture_.capture(probes[drawn].capture, atlas_, probes[drawn].slot);
  }
}

}  // namespace lamp::app
