// What is laid over the picture, from what the walks of its pixels met. Pure: no device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/view_state.h"
#include "render/shadow_leaks.h"
#include "render/visit.h"

namespace lamp::app {

/// A frame's walks and depth, row by row.
struct Walked {
  const View& view;
  std::span<const Visit> visits;
  std::span<const float> depth;  ///< device depth, for Overlay::depth_range
  std::span<const Visit> other;  ///< of the second method, for Overlay::difference
  std::uint32_t lights = 0;      ///< that the lists could have: of the frame, without those of lists of still lights
  bool overflowed = false;       ///< some cells did not fit
  double scale_least = 0.0;      ///< the top of the scale, unless more is walked
};

/// How the colours of an overlay are to be read.
struct Legend {
  Overlay overlay = Overlay::none;
  double low = 0.0;  ///< of the scale; lights, or metres
  double high = 0.0;
  double mean = 0.0;
  double max = 0.0;
  std::string refused;      ///< why there is nothing to show
  std::uint64_t cells = 0;  ///< that hold pixels; of Overlay::overflow, pixels that walk every light; of
                            ///< Overlay::missed, pixels that miss one, and `max` is of how many pairs; of
                            ///< Overlay::difference, pixels that differ, and `mean` is of the first less the second
  // Of Overlay::light_cells, whose `cells` list the light:
  std::uint64_t reached = 0;      ///< of these cells, those in which it reaches a pixel
  std::uint64_t lacking = 0;      ///< cells in which it does, and that do not list it
  std::optional<LeakSums> leaks;  ///< of Overlay::shadow_leaks
};

/// RGBA of every pixel, eight bits each, red lowest. Alpha 0 leaves the picture as it is.
struct Overlaid {
  std::vector<std::uint32_t> pixels;
  Legend legend;
};
[[nodiscard]] Overlaid make_overlay(Overlay overlay, Palette palette, const Walked& walked);

/// Nothing over the picture, and why.
[[nodiscard]] Overlaid refused_overlay(Overlay overlay, std::size_t pixels, std::string why);

/// Cells whose lists have from `low` to `high` lights.
struct ListLengths {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint64_t cells = 0;

  friend bool operator==(const ListLengths&, const ListLengths&) = default;
};
/// Of the cells that hold a pixel: 0, 1, 2, 3 to 4, 5 to 8 and so on, up to the longest list. A cell whose pixels walk
/// different lists counts with the longest.
[[nodiscard]] std::vector<ListLengths> list_lengths(std::span<const Visit> visits);

/// Colours of Overlay::difference: where the first walks more lights, and where the second does.
inline constexpr glm::u8vec3 FIRST_WALKS_MORE{255, 150, 20};
inline constexpr glm::u8vec3 SECOND_WALKS_MORE{50, 130, 255};

/// Overlay::slice: lights that points at `slice_m` ahead of the eye would walk, fainter where a surface hides the
/// point.
[[nodiscard]] Overlaid make_slice(Palette palette, const Walked& walked, double slice_m);

/// The numbers of pixels on a logarithmic scale, as `lamp render --heatmap` has it; SKY_CELL is sky. `special` may
/// give a colour to what is no number; such pixels count for the legend's `cells`.
[[nodiscard]] Overlaid heat_over(Palette palette, std::span<const std::uint32_t> counts, double scale_least,
                                 const std::function<std::optional<glm::u8vec3>(std::uint32_t)>& special);

/// A colour of Overlay::cells: hue and lightness are at random, so that neighbours are unlikely to share them, however
/// many cells a row has.
[[nodiscard]] glm::u8vec3 cell_color(std::uint32_t cell);

/// A colour of the scale, at 0 .. 1.
[[nodiscard]] glm::u8vec3 palette_color(Palette palette, double position);

}  // namespace lamp::app
