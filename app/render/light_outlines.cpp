// One dispatch.
// SPDX-License-Identifier: Apache-2.0
#include "render/light_outlines.h"

#include <algorithm>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "lamplight/shared/light_mesh.h"
#include "lamplight/shared/proxy.h"
#include "render/pass_uses.h"

namespace lamp::app {

static_assert(gpu::OUTLINE_TRIANGLES >= shared::MESH_TRIANGLES);
static_assert(gpu::OUTLINE_VERTICES >= shared::PROXY_VERTICES);

std::vector<Outline> outlines(Renderer& renderer, const ShaderLibrary& shaders, VkBuffer proxies,
                              std::span<const gpu::OutlineJob> jobs) {
  if (jobs.empty()) return {};
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  constexpr std::uint32_t GROUP = 64;
  const vulkan::Buffer asked =
      upload_buffer(renderer.context(), "outline jobs", std::as_bytes(jobs), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const std::size_t count = jobs.size() * gpu::OUTLINE_VERTICES;
  const vulkan::Buffer corners =
      readback_buffer(renderer.device(), "outline corners", count * sizeof(gpu::OutlineCorner));
  const vulkan::Resource written = vulkan::Resource::storage(corners.handle());
  const vulkan::Resource meshes = renderer.light_meshes();
  const Shadows* shadows = renderer.shadows();
  const vulkan::Buffer* radial = shadows == nullptr ? nullptr : shadows->reach(ShadowReach::Kind::radial);
  std::vector<vulkan::Bound> bound{{0, renderer.data().frame()},
                                   {1, proxies == VK_NULL_HANDLE ? meshes : vulkan::Resource::storage(proxies)},
                                   {2, meshes},
                                   {3, radial == nullptr ? meshes : vulkan::Resource::storage(radial->handle())},
                                   {4, vulkan::Resource::storage(asked.handle())}};
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound)
    if (std::ranges::find(uses, b.resource.buffer, [](const vulkan::Use& use) { return use.resource.buffer; }) ==
        uses.end())
      uses.push_back(reads(b.resource, COMPUTE));
  uses.push_back({.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
  bound.push_back({5, written});
  vulkan::PipelineInfo info{.name = "light_outlines"};
  for (const vulkan::Bound& b : bound) info.bindings.push_back({b.binding, b.resource.type});
  const vulkan::Pipeline pipeline =
      take(vulkan::Pipeline::compute(renderer.device(), info, shaders.spirv("light_outlines")));
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.begin_pass("light outlines", uses);
    recorder.bind(pipeline, bound);
    vkCmdDispatch(recorder.commands(), (gpu::OUTLINE_TRIANGLES + GROUP - 1) / GROUP,
                  static_cast<std::uint32_t>(jobs.size()), 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  renderer.forget(asked);
  renderer.forget(corners);
  const auto all = first_values<gpu::OutlineCorner>(corners, count);
  std::vector<Outline> found(jobs.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].is_there != 0) found[i / gpu::OUTLINE_VERTICES].push_back(glm::vec3(Vec3(all[i].position)));
  return found;
}

}  // namespace lamp::app
