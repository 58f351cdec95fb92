// Where in the picture shadow filters leak, and where their shadows are false: a ray for each pixel and light of its
// list, on the GPU, for heat maps.
// Promise: what leaks and what is lost mean is what they mean to check_shadows (shadow_truth.h), whose rays are in
// double precision; light, filter and look-up are shading's own.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/mirror_scene.h"
#include "render/renderer.h"
#include "render/shaders/shadow_leak_data.h"
#include "render/shadow_truth.h"

namespace lamp::app {

/// Why rays and lists of a lighting cannot say it, in one line; empty: they can. Asked before a MirrorScene is made,
/// which takes time.
[[nodiscard]] std::string why_no_leaks(const Renderer& renderer, const Lighting& lighting, const Scene& scene);

/// Of each pixel that is shown, row by row. There is no reason against it, and a frame was drawn. `rays`: of the
/// renderer's scene as it stands, uploaded.
[[nodiscard]] std::vector<gpu::ShadowLeak> shadow_leaks(Renderer& renderer, Lighting& lighting,
                                                        const MirrorScene& rays);

/// Of pixels whose search came to its end.
struct LeakSums {
  ShadowLight light;          ///< nothing is known of `bled`
  std::uint64_t unclear = 0;  ///< pairs of pixel and light left out: other ends of the ray give another answer
  std::uint64_t ended = 0;    ///< pixels left out: the device ended their search

  friend bool operator==(const LeakSums&, const LeakSums&) = default;
};
[[nodiscard]] LeakSums sum_of(std::span<const gpu::ShadowLeak> pixels);

}  // namespace lamp::app
