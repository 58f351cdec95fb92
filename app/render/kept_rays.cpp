// Makes rays of a scene, or moves them.
// SPDX-License-Identifier: Apache-2.0
#include "render/kept_rays.h"

#include <utility>

namespace lamp::app {

const MirrorScene& KeptRays::of(Context& context, const GpuScene& scene, Renderer& renderer) {
  if (renderer.mirrored() != nullptr) return renderer.mirrored()->scene();
  const bool moved = std::exchange(moved_, false);
  if (!rays_)
    rays_.emplace(context, scene);
  else if (moved)
    rays_->move(context, scene.scene());
  renderer.also([&](vulkan::Recorder& recorder) { rays_->record_upload(recorder); });
  return *rays_;
}

}  // namespace lamp::app
