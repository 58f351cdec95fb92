// What mirrored light came to, in words and as JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/mirror_check.h"

namespace lamp::app {

/// Of the last frame.
struct MirrorStats {
  MirrorSettings settings;
  gpu::MirrorCounts counts{};
  std::uint32_t overflowed_cells = 0;                        ///< of the lists
  std::vector<std::pair<std::string, std::uint64_t>> bytes;  ///< of buffers
  std::vector<std::string> notes;
  std::optional<MirrorFindings> findings;  ///< where rays were held against a reference
};
[[nodiscard]] std::optional<MirrorStats> mirror_stats(const MirrorPass* mirror);

/// "0.6: 51234 rays, 50001 meet something; lists of world-cells, 12.3 MB"
[[nodiscard]] std::string mirror_words(const MirrorStats& stats);
/// "50000 rays checked: all meet what the reference meets, ..."
[[nodiscard]] std::string mirror_words(const MirrorFindings& findings);
[[nodiscard]] nlohmann::json to_json(const MirrorStats& stats);

}  // namespace lamp::app
