// Asks the atlas for each pixel.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_panorama.h"

#include "gpu/check.h"
#include "gpu/transfer.h"

namespace lamp::app {

HdrImage probe_panorama(Context& context, const ShaderLibrary& shaders, const ProbeAtlas& atlas,
                        const gpu::ProbePanorama& what) {
  constexpr std::uint32_t GROUP_PX = 8;
  const vulkan::Device& device = context.device();
  const std::size_t pixels = std::size_t{what.height} * what.height * 2;
  const vulkan::Buffer picture = readback_buffer(device, "probe panorama", pixels * sizeof(glm::vec4));
  vulkan::PipelineInfo info{
      .name = "probe panorama", .bindings = {{0}}, .push_constant_bytes = sizeof(gpu::ProbePanorama)};
  add_probe_atlas(info);
  const vulkan::Pipeline pipeline = take(vulkan::Pipeline::compute(device, info, shaders.spirv("probe_panorama")));
  context.submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    tracker.assume(atlas.image().sampled());
    vulkan::Recorder recorder(device, commands, tracker);
    const vulkan::Resource to = vulkan::Resource::storage(picture.handle());
    recorder.begin_pass("probe panorama", {{.resource = to, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
    recorder.bind(pipeline, std::vector<vulkan::Bound>{{0, to}, atlas.bound().front()});
    vkCmdPushConstants(commands, pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(what), &what);
    vkCmdDispatch(commands, (2 * what.height + GROUP_PX - 1) / GROUP_PX, (what.height + GROUP_PX - 1) / GROUP_PX, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(to)});
  });
  return {2 * what.height, what.height, first_values<glm::vec4>(picture, pixels)};
}

}  // namespace lamp::app
