// Records draws of meshes; descriptors change with the material.
// SPDX-License-Identifier: Apache-2.0
#include "render/mesh_pass.h"

namespace lamp::app {

std::vector<vulkan::Use> attachment_uses(const Attachments& attachments) {
  std::vector<vulkan::Use> uses;
  for (const Attachments::Color& color : attachments.colors) uses.push_back(draws_color(*color.image, color.load));
  if (attachments.depth != nullptr)
    uses.push_back(attachments.depth_use == Attachments::Depth::clear ? draws_depth(*attachments.depth, Load::clear)
                                                                      : tests_depth(*attachments.depth));
  return uses;
}

void begin_rendering(VkCommandBuffer commands, const Attachments& attachments, const Targets& targets) {
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const Attachments::Color& color : attachments.colors)
    colors.push_back({.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                      .imageView = color.image->view(),
                      .imageLayout = color.image->attachment().layout,
                      .loadOp = color.load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
                      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                      .clearValue = {.color = {{color.clear.r, color.clear.g, color.clear.b, 0.0F}}}});
  VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  if (attachments.depth != nullptr) {
    const bool clear = attachments.depth_use == Attachments::Depth::clear;
    depth.imageView = attachments.depth->view();
    depth.imageLayout = clear ? attachments.depth->attachment().layout : attachments.depth->sampled().layout;
    depth.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    depth.storeOp = clear ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE;
    depth.clearValue.depthStencil.depth = attachments.sky;
  }
  const VkRect2D area{.extent = {targets.width, targets.height}};
  const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                             .renderArea = area,
                             .layerCount = 1,
                             .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                             .pColorAttachments = colors.data(),
                             .pDepthAttachment = attachments.depth == nullptr ? nullptr : &depth};
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{
      .width = static_cast<float>(targets.width), .height = static_cast<float>(targets.height), .maxDepth = 1.0F};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
}

std::vector<vulkan::DescriptorBinding> mesh_bindings() {
  std::vector<vulkan::DescriptorBinding> bindings;
  for (std::uint32_t i = 0; i < 5; ++i)
    bindings.push_back({i, i == 1 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  for (std::uint32_t i = 5; i < 10; ++i) bindings.push_back({i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER});
  return bindings;
}

vulkan::GraphicsState mesh_state(VkCompareOp compare, std::vector<VkFormat> colors) {
  return {.attributes = vertex_attributes(),
          .vertex_bytes = sizeof(Vertex),
          .dynamic_cull = true,
          .colors = std::move(colors),
          .depth = VK_FORMAT_D32_SFLOAT,
          .depth_write = compare != VK_COMPARE_OP_EQUAL,
          .depth_compare = compare};
}

void draw_meshes(vulkan::Recorder& recorder, const MeshDraws& what) {
  const VkCommandBuffer commands = recorder.commands();
  const GpuScene& scene = *what.scene;
  scene.bind_geometry(commands);
  std::vector<vulkan::Bound> shared_bound{
      {0, what.frame->frame()}, {2, scene.instances()}, {3, what.frame->lights()}, {4, scene.surroundings()}};
  shared_bound.insert(shared_bound.end(), what.more.begin(), what.more.end());

  const vulkan::Pipeline* bound_pipeline = nullptr;
  std::uint32_t bound_material = ~0U;
  for (const Draw& draw : what.draws) {
    const std::uint32_t material = scene.scene().meshes[draw.mesh].material;
    const bool opaque = scene.material_of(draw).alpha_mode == AlphaMode::opaque;
    const vulkan::Pipeline* pipeline = opaque && what.opaque_pipeline != nullptr ? what.opaque_pipeline : what.pipeline;
    if (material != bound_material || pipeline != bound_pipeline) {
      const auto of_material = scene.material_bound(material);
      if (pipeline == bound_pipeline) {
        recorder.push(*pipeline, of_material);
      } else {
        std::vector<vulkan::Bound> all = shared_bound;
        all.insert(all.end(), of_material.begin(), of_material.end());
        recorder.bind(*pipeline, all);
      }
      vkCmdSetCullMode(commands, scene.material_of(draw).double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
    }
    bound_pipeline = pipeline;
    bound_material = material;
    scene.draw(commands, draw);
  }
}

}  // namespace lamp::app
