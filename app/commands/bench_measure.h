// Measures a group: checks every entry's output, then times those that were right in interleaved rounds.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "commands/bench_device.h"
#include "system/signals.h"

namespace lamp::app {

/// What a group needs from outside.
struct MeasureInfo {
  BenchDevice& device;
  const Group& group;
  std::filesystem::path folder;                                         ///< pictures go into its subfolder `pictures`
  std::function<void(const std::string& what, double share)> progress;  ///< share: of the group, 0 .. 1
  std::function<int()> stop;  ///< asked between frames: the signal that came and wants it to stop, or 0
  std::function<void(const std::string& words)> explain;  ///< told what `auto` predicts; may be empty
};

/// The results of the group's entries, as results.json holds them. Throws Interrupted.
[[nodiscard]] std::vector<nlohmann::json> measure(const MeasureInfo& info);

}  // namespace lamp::app
