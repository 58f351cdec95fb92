// One dispatch over the picture.
// SPDX-License-Identifier: Apache-2.0
#include "render/slice_walk.h"

#include <bit>
#include <cstring>

#include "gpu/transfer.h"
#include "render/shaders/scene_data.h"

namespace lamp::app {

std::vector<Visit> visit_at(Renderer& renderer, Lighting& lighting, float z_view) {
  const std::size_t pixels = std::size_t{renderer.targets().width} * renderer.targets().height;
  const vulkan::Buffer found = readback_buffer(renderer.device(), "met in a slice", pixels * sizeof(gpu::Met));
  const EntityRanges entities = renderer.entities();
  renderer.run({.shader = "visit_slice",
                .lighting = &lighting,
                .storage = {{2, vulkan::Resource::storage(found.handle()), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}},
                .push = {std::bit_cast<std::uint32_t>(z_view), entities.lights.first, entities.lights.end, /*two*/ 2}});
  renderer.forget(found);
  std::vector<Visit> visits;
  visits.reserve(pixels);
  for (const gpu::Met& met : first_values<gpu::Met>(found, pixels))
    visits.push_back({.visited = met.visited, .cell = met.cell, .hash = met.hash, .ended = met.ended != 0});
  return visits;
}

}  // namespace lamp::app
