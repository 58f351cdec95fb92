// A scene as rays read it on the GPU, for mirrors and for the truth of shadows: its hierarchy, vertices, materials, and
// images as plain texels.
// Promise: no more texels than a buffer of the device holds; images that do not fit are read from a coarser level on
// (mirror_images.h), and a note says so.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gpu/transfer.h"
#include "lamplight/vulkan.h"
#include "render/bvh.h"
#include "render/gpu_scene.h"
#include "render/shaders/mirror_data.h"

namespace lamp::app {

class MirrorScene {
 public:
  /// Shares its vertices, which must live on. Throws Error for a scene whose triangles do not fit a buffer of the
  /// device.
  MirrorScene(Context& context, const GpuScene& scene);

  /// Its instances have moved: they are uploaded anew with the next `record_upload`, and boxes of the upper level.
  void move(Context& context, const Scene& scene);
  void record_upload(vulkan::Recorder& recorder);

  [[nodiscard]] const Bvh& bvh() const { return bvh_; }
  /// Of each image of the scene: the level that rays read as its finest.
  [[nodiscard]] const std::vector<std::uint32_t>& first_levels() const { return first_levels_; }
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// At the bindings of common/bvh_scene.glsl, whose BVH_FIRST_BINDING is `first`.
  [[nodiscard]] std::vector<vulkan::Bound> bound(std::uint32_t first = 8) const;

 private:
  void upload_bvh(Context& context);
  void upload_images(Context& context, const Scene& scene);

  const GpuScene& drawn_;
  Bvh bvh_;
  std::vector<std::string> notes_;
  std::vector<std::uint32_t> first_levels_;
  vulkan::Buffer nodes_, triangles_, instances_, materials_, images_, texels_;
  vulkan::Buffer staging_;  ///< of instances, then of the upper level's nodes
  bool moved_ = false;      ///< since the last upload
};

}  // namespace lamp::app
