// Builds trees.
// SPDX-License-Identifier: Apache-2.0
#include "render/still_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "gpu/check.h"
#include "lamplight/method.h"

namespace lamp::app {

bool are_same(std::span<const shared::Light> a, std::span<const shared::Light> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

WorldTree make_still_tree(std::span<const shared::Light> lights, const Options& options, float eyes_m,
                          std::shared_ptr<const StillOccluders> occluders) {
  WorldTreeInfo info{.lights = lights, .occluders = std::move(occluders), .eyes_m = eyes_m};
  set_options(info, options);
  return take(WorldTree::build(info));
}

std::vector<std::string> notes_of(const WorldTree& tree, const TimeTaken& time, const Options& options) {
  const WorldTreeCounts& counts = tree.counts();
  std::vector<std::string> notes{
      fmt::format("made ahead in {:.2f} s ({:.2f} s of CPU time): {:.1f} MiB, {} leaves, {} entries, at most {:.1f} "
                  "cells in a light's range",
                  time.seconds, time.cpu_seconds, static_cast<double>(tree.words().size_bytes()) / (1 << 20),
                  counts.leaves, counts.entries, counts.detail)};
  for (std::string& note : notes_of(counts, options.integer("detail"))) notes.push_back(std::move(note));
  return notes;
}

std::vector<std::string> notes_of(const WorldTreeCounts& counts, std::uint32_t detail) {
  if (counts.every_light) return {"the budget holds no list: every point walks every light"};
  if (counts.coarser <= 1.0 && counts.detail >= detail) return {};
  return {
      fmt::format("to keep the budget, cells are coarser than detail={} asks for, and were merged: walks are {:.2f} "
                  "times as long as without that",
                  detail, counts.coarser)};
}

void StillTree::bring(Context& context, FrameData& data, const Plan& plan, const Options& options) {
  if (!plan.binds(INPUT_STILL)) return;
  if (options.word("occlusion") == "ahead")
    throw Error(
        "option occlusion=ahead: pictures are lit without it, so that no light is missed; it goes with --points");
  const std::span<const shared::Light> lights = data.host_lights();
  const float eye_m = data.farthest_eye_m();
  if (is_there_ && are_same(lights, lights_) && options.all() == options_.all() && eye_m <= eyes_m_) return;
  eyes_m_ = static_cast<float>(std::bit_ceil(static_cast<std::uint32_t>(std::min(eye_m, 1e9F)) + 1U));
  eyes_m_ = std::max(eyes_m_, eye_m);
  data.set_still(context, make_still_tree(lights, options, eyes_m_).words());
  lights_.assign(lights.begin(), lights.end());
  options_ = options;
  is_there_ = true;
}

}  // namespace lamp::app
