// Moments of shadow maps for vsm and evsm: an image as large as the atlas, and what blurs into it what was drawn.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gpu/context.h"
#include "lamplight/shadow_atlas.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"

namespace lamp::app {

/// How moments are blurred: in one pass; in two passes, line by line, with an image between them; or likewise by the
/// indices of the OpenGL article's listing, which mix lines.
enum class ShadowBlur : std::uint8_t { fused, lines, listing };

class ShadowMoments {
 public:
  /// Throws Error for a device that cannot store such images. Of filters that have moments.
  ShadowMoments(const Context& context, const ShaderLibrary& shaders, ShadowFilter filter, ShadowBlur blur,
                std::uint32_t atlas_size);

  /// Whether a filter reads moments.
  [[nodiscard]] static bool has(ShadowFilter filter) {
    return filter == ShadowFilter::vsm || filter == ShadowFilter::evsm;
  }
  /// Of the next `record`: all squares of these lights.
  void set(std::span<const shared::ShadowMap> maps, std::span<const ShadowRedraw> redraws);
  /// `maps`: the buffer of all maps; `atlas`: depths.
  void record(vulkan::Recorder& recorder, const vulkan::Resource& maps, const GpuImage& atlas) const;

  [[nodiscard]] const GpuImage& image() const { return blurred_; }

 private:
  void record_pass(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline,
                   std::vector<vulkan::Bound> bound) const;

  struct Block {
    std::uint32_t light = 0;
    std::uint32_t square = 0;
    std::uint32_t block = 0;
  };
  ShadowBlur blur_;
  GpuImage between_;  ///< of two passes: blurred along x
  GpuImage blurred_;
  vulkan::Buffer blocks_;
  vulkan::Pipeline from_depths_;   ///< along x, or both ways
  vulkan::Pipeline from_between_;  ///< of two passes: along y
  std::uint32_t block_count_ = 0;
};

}  // namespace lamp::app
