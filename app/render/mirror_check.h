// Mirrored light against the truth: what each ray meets, by rays in double precision; and the lights of what they met,
// by the oracle. Promise: the reference meets the same sides, and the same holes, as a pixel shows. What another ray so
// close that 32 bits do not tell them apart meets instead is counted apart.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "render/mirror_reference.h"
#include "render/point_check.h"
#include "render/renderer.h"

namespace lamp::app {

struct MirrorFindings {
  std::uint64_t rays = 0;     ///< of the frame
  std::uint64_t checked = 0;  ///< every so many of them
  std::uint64_t hits = 0;     ///< of the checked: something is met
  std::uint64_t wrong = 0;    ///< meet something else than the reference
  std::uint64_t unclear = 0;  ///< likewise, but so does a reference that is off by rounding
  std::uint64_t ended = 0;    ///< the device ended the search; of no other number here
  std::string first_wrong;
  std::optional<PointFindings> lists;  ///< of the lights at checked hits, where they are looked up

  /// Of another picture of the frame.
  void add(const MirrorFindings& more);
  [[nodiscard]] Verdict verdict() const;
  [[nodiscard]] std::string reason() const;  ///< of a verdict that is not ok, one line
};

/// Of what the rays of a renderer that mirrors read. Both must outlive it.
[[nodiscard]] MirrorReference mirror_reference(const Renderer& renderer, const Scene& scene);

/// Of the last picture of a renderer that mirrors; the reference is of its scene, `lights` are the frame's, `most` rays
/// are checked.
[[nodiscard]] MirrorFindings check_mirror(Renderer& renderer, const ShaderLibrary& shaders,
                                          const MirrorReference& reference, std::span<const shared::Light> lights,
                                          std::size_t most);

}  // namespace lamp::app
