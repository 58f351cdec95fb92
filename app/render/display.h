// A frame as a screen shows it: exposed, tone-mapped, with an overlay, in an image of eight bits a channel.
// Promise: the same exposure and curve as pictures in files have, but for rounding.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "render/renderer.h"

namespace lamp::app {

class Display {
 public:
  /// For frames of this size.
  Display(const vulkan::Device& device, const ShaderLibrary& shaders, std::uint32_t width, std::uint32_t height);

  /// Records what `exposure` needs of a frame.
  void record_sums(vulkan::Recorder& recorder, const Targets& targets);
  /// After that has run: what automatic_exposure() says of the frame.
  [[nodiscard]] float exposure() const;

  /// RGBA of each pixel, eight bits each, red lowest: what `record` lays over the picture as far as alpha says.
  [[nodiscard]] std::span<std::uint32_t> overlay();

  struct Part {
    float exposure = 1.0F;
    std::uint32_t first_x = 0;  ///< columns that are written
    std::uint32_t end_x = ~0U;
    bool overlaid = false;
  };
  /// Records the way from the targets' radiance to the image, which is left to be copied from.
  void record(vulkan::Recorder& recorder, const Targets& targets, const Part& part);

  /// Whoever shows it holds it meanwhile.
  [[nodiscard]] std::shared_ptr<const GpuImage> image() const { return image_; }

 private:
  std::shared_ptr<GpuImage> image_;
  vulkan::Buffer sums_;
  vulkan::Buffer overlay_;
  vulkan::Pipeline sum_;
  vulkan::Pipeline show_;
};

}  // namespace lamp::app
