// Three dispatches over the picture.
// SPDX-License-Identifier: Apache-2.0
#include "render/cell_masks.h"

#include "gpu/transfer.h"

namespace lamp::app {

std::vector<gpu::CellMask> cell_masks(Renderer& renderer, std::span<const std::uint32_t> cell_of, std::uint32_t count) {
  const vulkan::Buffer cells =
      upload_buffer(renderer.context(), "cells of pixels", std::as_bytes(cell_of), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const vulkan::Buffer masks =
      readback_buffer(renderer.device(), "masks of cells", std::size_t{count} * sizeof(gpu::CellMask));
  PixelPass pass{.shader = "cell_masks",
                 .storage = {{2, vulkan::Resource::storage(cells.handle())},
                             {3, vulkan::Resource::storage(masks.handle()),
                              VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}},
                 .push = {0, count}};
  const vulkan::Pipeline pipeline = renderer.pixel_pipeline(pass);
  for (std::uint32_t step = 0; step < 3; ++step) {
    pass.push[0] = step;
    pass.prepares = step == 0;
    pass.storage[1].zeroed = step == 0;
    renderer.run(pass, pipeline);
  }
  for (const vulkan::Buffer* buffer : {&cells, &masks}) renderer.forget(*buffer);
  return first_values<gpu::CellMask>(masks, count);
}

}  // namespace lamp::app
