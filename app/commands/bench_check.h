// Holds an entry's output against the oracle and brute force, for all of a picture or for a band of rows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/bench_device.h"
#include "render/gpu_verifier.h"
#include "render/judgement.h"

namespace lamp::app {

/// What was found about one entry.
struct Checked {
  std::string verdict;               ///< exact, approximate, wrong, could not check, unverified, impossible
  std::string reason;                ///< of all but exact and approximate; what was not checked
  std::optional<Findings> findings;  ///< of lights
  std::optional<Findings> decals;    ///< where there are some
  std::optional<Findings> probes;
  std::optional<float> difference;  ///< from brute force's picture
  Rendered rendered;                ///< the frame that was checked
};

/// The truth about one frame: made once for a group.
class Checker {
 public:
  Checker(BenchDevice& device, const Group& group, Renderer& renderer, const BenchFrame& frame);

  /// Shows the frame anew, with lists of still lights or none: before `check` of a lighting that was made for them.
  void show(const StillLists* still);
  /// `same_picture`: nothing that shines through walls is left out.
  [[nodiscard]] Checked check(Lighting& lighting, bool same_picture = true);

 private:
  [[nodiscard]] const HdrImage& reference(ShadingPath path);
  [[nodiscard]] Findings find(Lighting& lighting);
  /// Of decals or probes, by the oracle.
  [[nodiscard]] Findings find_boxes(Lighting& lighting, Renderer::Kind kind);
  /// Uses the depth that was rendered last: the same for every entry.
  void need_truths();
  /// The oracle's.
  void for_each_truth(std::size_t picture, const std::function<void(const Truth&)>& use);
  [[nodiscard]] Judgement judge_output(const Lighting& lighting, const Checked& checked);

  BenchDevice& device_;
  const Group& group_;
  Renderer& renderer_;
  const BenchFrame& frame_;
  std::optional<const StillLists*> shown_;
  Rows rows_;
  std::vector<std::vector<float>> depths_;  ///< of each of the renderer's pictures
  std::vector<std::vector<Truth>> truths_;  ///< likewise, of all rows, where they are few enough to be kept
  std::optional<GpuVerifier> verifier_;
  std::optional<HdrImage> forward_, deferred_;
};

/// The lighting of an entry.
[[nodiscard]] LightingInfo lighting_info(const BenchScene& scene, const Group& group, const GroupEntry& entry);

}  // namespace lamp::app
