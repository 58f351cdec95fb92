// Uploads a captured frame once, and copies it into the targets every frame, as meshes are drawn every frame.
// SPDX-License-Identifier: Apache-2.0
#include "render/captured_surfaces.h"

#include <utility>

#include "render/gbuffer_texels.h"
#include "render/pass_uses.h"

namespace lamp::app {

CapturedSurfaces::CapturedSurfaces(Context& context, const CapturedFrame& frame) {
  const GBufferTexels texels = encode(frame);
  const auto upload = [&](const char* name, std::span<const std::byte> bytes) {
    return upload_buffer(context, name, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  };
  depth_ = upload("captured depth", bytes_of(texels.depth));
  base_color_ = upload("captured base colour", bytes_of(texels.base_color));
  surface_ = upload("captured surface", bytes_of(texels.surface));
  emission_ = upload("captured emission", bytes_of(texels.emission));
}

void CapturedSurfaces::record(vulkan::Recorder& recorder, const Targets& targets) const {
  const std::pair<const vulkan::Buffer*, const GpuImage*> copies[] = {{&depth_, &targets.depth},
                                                                      {&base_color_, &targets.base_color},
                                                                      {&surface_, &targets.surface},
                                                                      {&emission_, &targets.emission}};
  std::vector<vulkan::Use> uses;
  for (const auto& [buffer, image] : copies) {
    uses.push_back(copies_from(vulkan::Resource::storage(buffer->handle())));
    uses.push_back(copies_to(image->transfer_target()));
  }
  recorder.begin_pass("captured surfaces", uses);
  for (const auto& [buffer, image] : copies) {
    const VkBufferImageCopy whole{.imageSubresource = {image->aspect(), 0, 0, 1},
                                  .imageExtent = {targets.width, targets.height, 1}};
    vkCmdCopyBufferToImage(recorder.commands(), buffer->handle(), image->handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           1, &whole);
  }
  recorder.end_pass();
}

}  // namespace lamp::app
