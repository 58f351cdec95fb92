// Levels of a scene's images as rays read them.
// Promise: where images lose levels so that all fit, those that cut holes keep theirs longest, as a hole decides what a
// ray meets.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

/// Of a level, in texels.
[[nodiscard]] std::uint32_t side_at(std::uint32_t side, std::uint32_t level);

/// Of each image: whether the alpha of a masked material is read from it.
[[nodiscard]] std::vector<bool> cuts_holes(const Scene& scene);

/// Of each image: the first level that is read, so that all together have at most so many texels. The largest loses
/// one, again and again; those that cut holes do so when no other has any to lose.
[[nodiscard]] std::vector<std::uint32_t> levels_that_fit(const Scene& scene, std::uint64_t most_texels);

/// An image's levels, one behind the other, from the level that is `first` on: eight bits each of red, green, blue,
/// alpha. A texel of a level is the mean of those that it covers, in linear light.
[[nodiscard]] std::vector<std::uint32_t> texels_of(const Image& image, std::uint32_t first, std::uint32_t& levels);

/// That level alone, as an image.
[[nodiscard]] Image image_at(const Image& image, std::uint32_t level);

}  // namespace lamp::app
