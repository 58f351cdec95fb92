// Pictures and heat maps of a group, small enough for a report.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/groups.h"
#include "commands/request.h"
#include "render/renderer.h"

namespace lamp::app {

struct BenchPicture {
  std::string label;
  std::string key;  ///< of its result, which no other has
  Lighting* lighting = nullptr;
  const StillSetup* still = nullptr;  ///< null: it has no lists of still lights
  std::function<void()> show;         ///< makes the renderer's frame the lighting's
};

/// Writes a picture and a heat map for each into `folder`/pictures, the maps on one scale. Returns for each
/// {"picture": file, "heatmap": file}, relative to the folder.
[[nodiscard]] std::vector<nlohmann::json> write_pictures(const std::filesystem::path& folder, const Group& group,
                                                         Renderer& renderer, std::span<const BenchPicture> pictures);

}  // namespace lamp::app
