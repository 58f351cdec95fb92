// The cells that list one light: where it reaches a pixel, and where it is listed in vain. Pure but for the widget.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "oracle/reference.h"
#include "view/overlay.h"
#include "view/widgets.h"

namespace lamp::app {

/// Colours of cells that list the light: two that differ for all kinds of colour vision.
inline constexpr glm::u8vec3 REACHES_A_PIXEL{70, 165, 255};
inline constexpr glm::u8vec3 LISTED_IN_VAIN{255, 140, 20};

/// Why there is nothing to show.
inline constexpr const char* NO_LIGHT = "no light is looked at: click a pixel, then a row of the inspector's table";

/// Of each pixel, row by row.
struct LightSeen {
  std::uint32_t width = 0;
  std::span<const Visit> visits;
  std::span<const std::uint32_t> listed;  ///< 1 where the walk brings the light, else 0
  std::span<const Reach> reached;         ///< as the oracle says; what it leaves open counts as not reached
};
/// Tints the cells, with a darker edge; pixels that the light reaches are the brightest. A pixel that it reaches in a
/// cell that does not list it has the signal colour.
[[nodiscard]] Overlaid make_light_cells(const LightSeen& seen);

/// "light 12: listed in 41 cells, reaches a pixel in 17 of them: 41 %".
[[nodiscard]] std::string words_of_light_cells(const Legend& legend, std::uint32_t light);

/// A part of the inspector: switches the overlay.
void cells_of_light(ViewState& state, Widgets& widgets);

}  // namespace lamp::app
