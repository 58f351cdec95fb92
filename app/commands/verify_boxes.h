// lamp verify of what is no light: decals and probes, each kind by its own range of ids, against the oracle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "commands/request.h"
#include "render/verification.h"

namespace lamp::app {

/// What a method's look-ups were found to hold of one kind; without a fused one, `fused` stays empty.
struct BoxCheck {
  BoxCheck(Renderer::Kind of, std::uint32_t width, const HostDepth& depth)
      : kind(of), separate(width, depth), fused(width, depth) {}
  Renderer::Kind kind;
  Verification separate;
  Verification fused;

  [[nodiscard]] Findings findings(const Lighting& lighting) const;
};

/// A frame's decals and probes.
struct FrameBoxes {
  std::span<const gpu::DecalData> decals;
  std::span<const gpu::ProbeData> probes;
};

/// Holds rows of the picture that the renderer shows, of that depth, against the oracle: `checks` are one kind's, of
/// one lighting each. Of boxes there are few: always by the oracle.
void check_boxes_of(Renderer& renderer, const FrameBoxes& frame, std::span<const float> depth, Rows rows,
                    std::span<const std::pair<Lighting*, BoxCheck*>> checks);

}  // namespace lamp::app
