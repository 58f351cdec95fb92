// Frames under way: recorded by a Culler, with the engine's shader behind it, to be submitted later or never.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "gpu/commands.h"
#include "gpu/engine_frame.h"

namespace lamp::app {

struct CullerCandidate {
  std::string_view method;
  std::vector<std::string> options;
};

/// Every row, and options that keep something from frame to frame or work on the CPU.
[[nodiscard]] std::vector<CullerCandidate> culler_candidates();

[[nodiscard]] vulkan::Culler culler_of(const CullerCandidate& candidate, std::uint32_t frames_in_flight);

/// What a frame gives by a Culler of its own.
[[nodiscard]] Masks masks_alone(const CullerCandidate& candidate, const EngineFrame& frame);

struct Flying {
  Flying(vulkan::Culler& culler, const EngineFrame& frame);

  std::uint64_t number = 0;
  MaskPass pass;
  Commands commands;
};

}  // namespace lamp::app
