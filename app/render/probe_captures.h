// The captures of a renderer's probes: all of them before the first frame, then as many a frame as the budget allows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "render/probe_atlas.h"
#include "render/probe_capture.h"
#include "render/probe_schedule.h"
#include "render/probe_set.h"

namespace lamp::app {

class ProbeCaptures {
 public:
  /// Throws Error where the device has no atlas for so many.
  ProbeCaptures(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ProbeCaptureInfo& info,
                std::vector<gpu::ProbeData> probes);

  /// What surfaces see of them, from the first `renew` on.
  [[nodiscard]] const ProbeSet& set() const { return set_; }

  struct Frame {
    std::span<const View> views;
    std::span<const shared::Light> lights;  ///< must live on
    std::span<const gpu::DecalData> decals;
    bool changed = true;  ///< lights or geometry are not where they were: all captures are old
  };
  /// Captures at most `budget` probes: such as have no capture, then those that are seen most and waited longest. Waits
  /// for them. `progress`: the share of them that is done, 0 .. 1.
  void renew(const Frame& frame, std::uint32_t budget, const std::function<void(double)>& progress = {});

  [[nodiscard]] const ProbeCounts& counts() const { return counts_; }  ///< of the last `renew`
  [[nodiscard]] std::uint32_t clipped() const { return atlas_.clipped(); }

 private:
  ProbeAtlas atlas_;
  ProbeCapture capture_;
  ProbeSet set_;
  ProbeSchedule schedule_;
  ProbeCounts counts_;
};

}  // namespace lamp::app
