// One dispatch.
// SPDX-License-Identifier: Apache-2.0
#include "render/light_outlines.h"

#include "gpu/transfer.h"
#include "lamplight/shared/light_mesh.h"
#include "lamplight/shared/proxy.h"
#include "render/answers.h"

namespace lamp::app {

static_assert(gpu::OUTLINE_TRIANGLES >= shared::MESH_TRIANGLES);
static_assert(gpu::OUTLINE_VERTICES >= shared::PROXY_VERTICES);

std::vector<Outline> outlines(Renderer& renderer, const ShaderLibrary& shaders, VkBuffer proxies,
                              std::span<const gpu::OutlineJob> jobs) {
  if (jobs.empty()) return {};
  constexpr std::uint32_t GROUP = 64;
  const vulkan::Buffer asked =
      upload_buffer(renderer.context(), "outline jobs", std::as_bytes(jobs), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const vulkan::Resource meshes = renderer.light_meshes();
  const Shadows* shadows = renderer.shadows();
  const vulkan::Buffer* radial = shadows == nullptr ? nullptr : shadows->reach(ShadowReach::Kind::radial);
  const auto all = answers_of<gpu::OutlineCorner>(
      renderer, shaders,
      {.shader = "light_outlines",
       .bound = {{0, renderer.data().frame()},
                 {1, proxies == VK_NULL_HANDLE ? meshes : vulkan::Resource::storage(proxies)},
                 {2, meshes},
                 {3, radial == nullptr ? meshes : vulkan::Resource::storage(radial->handle())},
                 {4, vulkan::Resource::storage(asked.handle())}},
       .answers_at = 5,
       .groups = {(gpu::OUTLINE_TRIANGLES + GROUP - 1) / GROUP, static_cast<std::uint32_t>(jobs.size())}},
      jobs.size() * gpu::OUTLINE_VERTICES);
  renderer.forget(asked);
  std::vector<Outline> found(jobs.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].is_there != 0) found[i / gpu::OUTLINE_VERTICES].push_back(glm::vec3(Vec3(all[i].position)));
  return found;
}

}  // namespace lamp::app
