// Pictures of a session: the tone-mapped scene and heat maps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands/request.h"
#include "image/image.h"

namespace lamp::app {

/// Visits of the whole picture, checked against nothing.
[[nodiscard]] std::vector<gpu::Visit> visit_all(Session& session, Lighting& lighting);

/// Lights walked at each pixel; NO_CELL for sky.
[[nodiscard]] std::vector<std::uint32_t> walked_lights(std::span<const gpu::Visit> visits);

struct HeatmapRequest {
  std::string title;
  std::uint32_t scale_max = 0;        ///< 0: from the largest count
  const LdrImage* overlay = nullptr;  ///< lay the map over this picture
};
[[nodiscard]] LdrImage heatmap_of(Session& session, std::span<const std::uint32_t> counts,
                                  const HeatmapRequest& request);

/// "auto" or a factor > 0.
[[nodiscard]] float parse_exposure(const std::string& text, const HdrImage& image);

/// Throws Error if `file` cannot be written: asked before long work begins.
void check_writable(const std::filesystem::path& file);

}  // namespace lamp::app
