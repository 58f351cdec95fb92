// Uploads a captured frame once, or keeps what targets hold, and copies it into the targets every frame, as meshes are
// drawn every frame.
// SPDX-License-Identifier: Apache-2.0
#include "render/captured_surfaces.h"

#include "gpu/check.h"
#include "render/gbuffer_texels.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

/// In the order of CapturedSurfaces::buffers.
std::array<const GpuImage*, 4> images_of(const Targets& targets) {
  return {&targets.depth, &targets.base_color, &targets.surface, &targets.emission};
}

}  // namespace

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

CapturedSurfaces::CapturedSurfaces(const vulkan::Device& device, const Targets& targets) {
  const auto room = [&](const char* name, std::uint64_t texel_bytes) {
    return take(
        vulkan::Buffer::create(device, {.name = name,
                                        .bytes = texel_bytes * targets.width * targets.height,
                                        .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT}));
  };
  depth_ = room("kept depth", sizeof(GBufferTexels::depth[0]));
  base_color_ = room("kept base colour", sizeof(GBufferTexels::base_color[0]));
  surface_ = room("kept surface", sizeof(GBufferTexels::surface[0]));
  emission_ = room("kept emission", sizeof(GBufferTexels::emission[0]));
}

void CapturedSurfaces::record_keep(vulkan::Recorder& recorder, const Targets& targets) const {
  const auto images = images_of(targets);
  for (std::size_t i = 0; i < images.size(); ++i) record_copy(recorder, *images[i], *buffers()[i]);
}

void CapturedSurfaces::record(vulkan::Recorder& recorder, const Targets& targets) const {
  const auto images = images_of(targets);
  std::vector<vulkan::Use> uses;
  for (std::size_t i = 0; i < images.size(); ++i) {
    uses.push_back(copies_from(vulkan::Resource::storage(buffers()[i]->handle())));
    uses.push_back(copies_to(images[i]->transfer_target()));
  }
  recorder.begin_pass("captured surfaces", uses);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const VkBufferImageCopy whole = images[i]->whole();
    vkCmdCopyBufferToImage(recorder.commands(), buffers()[i]->handle(), images[i]->handle(),
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
  }
  recorder.end_pass();
}

}  // namespace lamp::app
