// Pictures and heat maps of a group, small enough for a report.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "bench/groups.h"
#include "render/renderer.h"

namespace lamp::app {

struct LabelledLighting {
  std::string label;
  Lighting* lighting = nullptr;
};

/// Writes a picture and a heat map for each into `folder`/pictures, the maps on one scale. Returns, by label,
/// {"picture": file, "heatmap": file}, relative to the folder.
[[nodiscard]] nlohmann::json write_pictures(const std::filesystem::path& folder, const Group& group, Renderer& renderer,
                                            std::span<const LabelledLighting> shown);

}  // namespace lamp::app
