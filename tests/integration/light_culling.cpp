// Everything of this engine that knows Lamplight, apart from the features of its device (engine.cpp).
// SPDX-License-Identifier: Apache-2.0
#include "light_culling.h"

#include <lamplight/value_of.h>

#include <stdexcept>

LightCulling::LightCulling(Engine& engine, const LightCullingInfo& info) : engine_(engine), info_(info) {
  const lamp::vulkan::Device device =
      value_of(lamp::vulkan::make_device(engine.instance(), engine.physical(), engine.device()));
  culler_ = value_of(lamp::vulkan::Culler::create(device, {.width = info.size.width,
                                                           .height = info.size.height,
                                                           .light_capacity = info.light_capacity,
                                                           .method = info.method,
                                                           .options = info.options}));
  const lamp::vulkan::BoundLookUp lookup = culler_.lookup();
  if (lookup.name != info.lookup) throw std::runtime_error("the shader was built for another look-up");
  make_pipeline();
}

void LightCulling::make_pipeline() {
  const lamp::vulkan::BoundLookUp lookup = culler_.lookup().moved_to(info_.first_binding, info_.first_constant);
  // The shader's own bindings, then the look-up's; the look-up's sizes are specialization constants.
  ComputePipelineInfo pipeline{.spirv = info_.spirv,
                               .set = info_.set,
                               .bindings = {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
                                            {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                            {2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}}};
  for (const lamp::vulkan::Bound& bound : lookup.resources)
    pipeline.bindings.push_back({bound.binding, bound.resource.type});
  for (const lamp::vulkan::Constant& constant : lookup.constants)
    pipeline.constants.push_back({constant.id, constant.value});
  count_ = engine_.make_compute_pipeline(pipeline);
}

void LightCulling::record(VkCommandBuffer commands, const Frame& frame) {
  frame_ = value_of(culler_.record(commands, {.view = &frame.view,
                                              .lights = frame.lights,
                                              .light_count = frame.light_count,
                                              .depth_image = frame.depth.image,
                                              .depth_view = frame.depth.view,
                                              .depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));

  // From here on any compute or fragment shader may read the look-up; no barrier is needed.
  std::vector<Descriptor> descriptors{{.binding = 0, .view = frame.depth.view},
                                      {.binding = 1, .buffer = frame.lights},
                                      {.binding = 2, .buffer = frame.counts}};
  for (const lamp::vulkan::Bound& bound : culler_.lookup().moved_to(info_.first_binding).resources)
    descriptors.push_back({.binding = bound.binding, .buffer = bound.resource.buffer});
  engine_.bind(commands, count_, descriptors);
  vkCmdDispatch(commands, (info_.size.width + 7) / 8, (info_.size.height + 7) / 8, 1);
}

bool LightCulling::finish() {
  const lamp::vulkan::Growth growth = value_of(culler_.finish(frame_));
  // The frame is done, so the old pipeline may go. Descriptors are pushed anew in every frame.
  if (growth == lamp::vulkan::Growth::constants) make_pipeline();
  return growth != lamp::vulkan::Growth::none;
}
