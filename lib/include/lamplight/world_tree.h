// Lights that stand still, listed in a tree of cells over all of the world that they reach, ahead of all frames. A
// light is left out of a cell only where it does not reach it or is proved not to see any of it.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering (2017), bonus slides: world-space sparse voxel
// trees with occlusion computed ahead; bottom-up pruning: Breiman et al., Classification and Regression Trees (1984).
// Promise: pure code, no device. Of any point, the list has every light that reaches and sees it, ascending. What does
// not fit the budget is kept coarser, never left out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/occlusion.h"
#include "lamplight/shared/light.h"

namespace lamp {

class Options;

struct WorldTreeInfo {
  std::span<const shared::Light> lights{};            ///< light i has id i; at most MAX_LIGHTS (method.h)
  std::shared_ptr<const StillOccluders> occluders{};  ///< kept with the tree; null: nothing hides anything
  std::uint64_t budget = 64ULL << 20;                 ///< bytes of `words`, as built
  std::uint32_t detail = 16;  ///< cells in a light's range, at most, 1 .. 64; fewer where the budget holds no more
  std::uint32_t texels = 32;  ///< a side of a face of OcclusionMap, 1 .. 1024
  std::uint32_t threads = 0;  ///< that build; 0: as many as the machine has
  float eyes_m =
      0.0F;  ///< the most that an eye is away from the origin, 0 .. 1e15: rounding moves its pixels' positions
};

/// What the options of the method `world-tree` say, as `resolve_options` gives them; without occlusion=ahead, no
/// occluders.
LAMPLIGHT_API void set_options(WorldTreeInfo& info, const Options& options);

struct WorldTreeCounts {
  std::uint64_t leaves = 0;   ///< with lights
  std::uint64_t entries = 0;  ///< lights of all leaves' lists
  std::uint64_t outside = 0;  ///< lights in the list of points outside of the tree
  std::uint32_t levels = 0;   ///< from the root to the finest leaf
  double cell_m = 0.0;        ///< side of the finest cell that there may be
  double detail = 0.0;        ///< cells in a light's range, at most; less than asked for where the budget holds no more
  double coarser = 1.0;       ///< and lights of an average cell, over those before cells were merged to keep the budget
  std::uint64_t peak_entries = 0;  ///< that lists held at once while the tree was built, 16 bytes each
  bool every_light = false;        ///< the budget holds no list at all: every point walks every light
};

/// A part of `words` that is no longer what it was.
struct ChangedWords {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

class LAMPLIGHT_API WorldTree {
 public:
  /// Errors: a light that `check_lights` would refuse (it is named), more than MAX_LIGHTS, an option out of its range.
  [[nodiscard]] static Result<WorldTree> build(const WorldTreeInfo& info);
  WorldTree(WorldTree&&) noexcept;
  WorldTree& operator=(WorldTree&&) noexcept;
  ~WorldTree();

  /// shared/world_tree.h says what they are. Upload them into a buffer of `capacity` words; upload what `change` names
  /// before the next frame.
  [[nodiscard]] std::span<const std::uint32_t> words() const;
  [[nodiscard]] std::uint64_t capacity() const;  ///< words: with room for changes

  /// A light is another, a new one (id: as many as there are) or none any more (one of range 0). Only the leaves that
  /// it touches change, and they stay as large as they are. Where the room for changes is used up all is built anew:
  /// then all words changed, and the capacity may have. Errors as of `build`, and a gap in the ids; they change
  /// nothing.
  [[nodiscard]] Result<std::vector<ChangedWords>> change(std::uint32_t id, const shared::Light& light);

  /// The list of a point, as look-ups find it.
  [[nodiscard]] std::vector<std::uint32_t> lights_at(const Vec3& position) const;

  [[nodiscard]] const WorldTreeCounts& counts() const;  ///< as built
  [[nodiscard]] std::span<const shared::Light> lights() const;

 private:
  struct State;
  explicit WorldTree(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace lamp
