// What each light holds of the atlas: its squares, and how it was when they were drawn.
// Promise: squares are given back before they are taken anew, and none is lost.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lamplight/shadow_atlas.h"
#include "sizes.h"
#include "square_tree.h"

namespace lamp::shadow {

/// Of one light, by its id.
struct Holding {
  int level = NO_LEVEL;  ///< of its squares; NO_LEVEL: it has none
  std::uint32_t squares = 0;
  std::array<std::uint32_t, shared::SQUARES_A_LIGHT> places{};
  bool drawn = false;  ///< `map` is what the squares show
  bool stale = false;  ///< something has moved since near it
  shared::Light light{};
  shared::ShadowMap map{};
  std::uint64_t in_frame = 0;   ///< the last frame that it was in
  std::uint64_t last_seen = 0;  ///< the last frame that showed it
  std::uint32_t waited = 0;     ///< frames since it was first to be drawn
};

class Holdings {
 public:
  Holdings(std::uint32_t root_level, std::uint32_t capacity) : tree_(root_level, LEAST_LEVEL), all_(capacity) {}

  [[nodiscard]] Holding& of(std::uint32_t id) { return all_[id]; }
  [[nodiscard]] std::span<Holding> all() { return all_; }
  [[nodiscard]] std::uint64_t used_texels() const { return used_texels_; }
  /// Top left of each of its squares.
  [[nodiscard]] static std::vector<UVec2> corners(const Holding& holding);

  void release(Holding& holding);
  /// Squares of `level` or, where that does not fit, the next less, but none as small as it has now: then it keeps
  /// those. Lights that no view showed since `frame` lose theirs before it takes less, the longest unseen first:
  /// `level` is what fits beside all that are seen. False: it has none.
  bool resize(Holding& holding, std::uint32_t squares, int level, std::uint64_t frame);
  /// Lights that lost their squares to `resize` since the last call.
  [[nodiscard]] std::uint32_t take_evicted();

 private:
  bool take(Holding& holding, std::uint32_t squares, int level);
  void give(Holding& holding);
  bool evict_one(std::uint64_t frame);

  SquareTree tree_;
  std::vector<Holding> all_;
  std::uint64_t used_texels_ = 0;
  std::uint32_t evicted_ = 0;
};

}  // namespace lamp::shadow
