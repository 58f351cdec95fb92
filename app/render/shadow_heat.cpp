// Says of each light what its map comes to, and asks each pixel's look-up for the worst.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_heat.h"

#include <cassert>
#include <cstring>

#include "gpu/transfer.h"

namespace lamp::app {
namespace {

std::vector<std::uint32_t> words_of_lights(const Shadows& shadows, ShadowHeat of) {
  std::vector<std::uint32_t> words;
  words.reserve(shadows.maps().size() + 1);
  for (std::size_t i = 0; i < shadows.maps().size(); ++i) {
    const shared::ShadowMap& map = shadows.maps()[i];
    const bool none = map.kind == shared::SHADOW_NONE;
    words.push_back(none ? 0 : of == ShadowHeat::age ? shadows.ages()[i] : map.side);
  }
  for (const std::uint32_t light : shadows.waiting()) words[light] = gpu::WAITS_FOR_REDRAWING;
  for (const std::uint32_t light : shadows.without()) words[light] = gpu::WITHOUT_SHADOW;
  if (words.empty()) words.push_back(0);  // a buffer has something in it
  return words;
}

}  // namespace

std::vector<std::uint32_t> shadow_heat(Renderer& renderer, Lighting& lighting, ShadowHeat of) {
  assert(renderer.shadows() != nullptr);
  const vulkan::Buffer words =
      upload_buffer(renderer.context(), "words of shadow maps", bytes_of(words_of_lights(*renderer.shadows(), of)),
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  std::vector<std::uint32_t> worst(std::size_t{renderer.targets().width} * renderer.targets().height);
  const vulkan::Buffer found =
      readback_buffer(renderer.device(), "worst shadow maps", worst.size() * sizeof(std::uint32_t));
  renderer.run({.shader = "shadow_heat",
                .lighting = &lighting,
                .storage = {{2, vulkan::Resource::storage(words.handle())},
                            {3, renderer.data().lights()},
                            {4, vulkan::Resource::storage(found.handle()), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}},
                .push = {renderer.entities().lights.end, of == ShadowHeat::age ? 1U : 0U}});
  for (const vulkan::Buffer* buffer : {&words, &found}) renderer.forget(*buffer);
  std::memcpy(worst.data(), found.mapped().data(), worst.size() * sizeof(std::uint32_t));
  return worst;
}

}  // namespace lamp::app
