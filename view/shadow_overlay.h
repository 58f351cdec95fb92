// The shadow atlas over the picture: whose square is where, and how far what it sees is. Pure: no device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "lamplight/shared/shadow.h"
#include "render/leak_map.h"
#include "view/overlay.h"

namespace lamp::app {

struct AtlasSeen {
  std::span<const float> texels;  ///< side * side, as the atlas holds them
  std::uint32_t side = 0;
  std::span<const shared::ShadowMap> maps;  ///< by records
  std::optional<std::uint32_t> record;      ///< of the light whose squares alone are shown, if it has any
  glm::uvec2 picture{0};
};

/// The atlas, or the light's squares beside each other, as large as the picture has room for. Near is bright, nothing
/// drawn is black. The legend's `cells` are the lights with a map, `max` texels a side: of the atlas, or of the square.
[[nodiscard]] Overlaid make_shadow_overlay(Palette palette, const AtlasSeen& seen);

/// One square's texels as a picture of `side` pixels: of the texels that fall on one, the one in their middle.
[[nodiscard]] std::vector<std::uint32_t> picture_of_square(Palette palette, const shared::ShadowMap& map,
                                                           std::span<const float> texels, std::uint32_t side);

/// Of Overlay::shadow_age and Overlay::shadow_size, what `shadow_heat` says of each pixel. The legend's `cells` are
/// pixels with a light that has no shadow, or whose shadow waits.
[[nodiscard]] Overlaid make_shadow_heat(Overlay overlay, Palette palette, std::span<const std::uint32_t> worst,
                                        double scale_least);

/// Of Overlay::shadow_leaks, in place of the picture: the light of lights in grey, and what is wrong with it in the
/// palette's colours.
[[nodiscard]] Overlaid make_shadow_leaks(Palette palette, std::span<const gpu::ShadowLeak> pixels);
[[nodiscard]] LeakColors leak_colors(Palette palette);

}  // namespace lamp::app
