// The tree of a frame's lights, for plans that read one: made when lights or options are others than before.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamplight/world_tree.h"
#include "render/frame_data.h"

namespace lamp::app {

/// With what the method's options say. `eyes_m`: of eyes from the origin, at most. Throws Error for lights that cannot
/// be.
[[nodiscard]] WorldTree make_still_tree(std::span<const shared::Light> lights, const Options& options, float eyes_m,
                                        std::shared_ptr<const StillOccluders> occluders = nullptr);

/// Byte by byte.
[[nodiscard]] bool are_same(std::span<const shared::Light> a, std::span<const shared::Light> b);

/// How long it took to make something.
struct TimeTaken {
  double seconds = 0.0;
  double cpu_seconds = 0.0;  ///< of all cores together
};

/// What its budget cost; one line each. `detail`: that was asked for.
[[nodiscard]] std::vector<std::string> notes_of(const WorldTreeCounts& counts, std::uint32_t detail);
/// How large a tree is, how long it took, and what its budget cost; one line each.
[[nodiscard]] std::vector<std::string> notes_of(const WorldTree& tree, const TimeTaken& time, const Options& options);

/// Brings it to the GPU with a frame's lights. Nothing hides any light.
class StillTree {
 public:
  void bring(Context& context, FrameData& data, const Plan& plan, const Options& options);

 private:
  std::vector<shared::Light> lights_;
  Options options_;
  float eyes_m_ = 0.0F;
  bool is_there_ = false;
};

}  // namespace lamp::app
