// Where methods miss lights: a map over the picture for each method that does.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/verification.h"

namespace lamp::app {

struct MethodMisses {
  std::string method;
  std::uint64_t missed = 0;         ///< pairs of pixel and light, as the table of `lamp verify` has them
  std::vector<PixelMisses> pixels;  ///< one may be there again, of another look-up or sample: its worst counts
};

/// A panel for each method that misses a light, in rows, on one scale of lights missed in a pixel. Where none does, the
/// picture, and words that say so.
[[nodiscard]] LdrImage draw_misses(std::span<const MethodMisses> methods, const LdrImage& picture);

}  // namespace lamp::app
