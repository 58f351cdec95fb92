// What shading binds of shadows.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/check.h"
#include "render/shadows.h"

namespace lamp::app {
namespace {

/// Filters without moments bind depths in their place.
ShadowBound bound_of(const vulkan::Buffer& maps, const GpuImage& atlas, const GpuImage& moments) {
  return {{{BINDING_SHADOW_MAPS, vulkan::Resource::storage(maps.handle())},
           {BINDING_SHADOW_ATLAS, atlas.sampled()},
           {BINDING_SHADOW_MOMENTS, moments.sampled()}}};
}

}  // namespace

vulkan::Constant shadow_constant(std::optional<ShadowFilter> filter) {
  return {CONSTANT_SHADOW_FILTER, filter ? static_cast<std::uint32_t>(*filter) : shared::SHADOW_OFF};
}

void add_shadows(vulkan::PipelineInfo& pipeline, std::optional<ShadowFilter> filter) {
  pipeline.constants.push_back(shadow_constant(filter));
  pipeline.bindings.push_back({BINDING_SHADOW_MAPS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  pipeline.bindings.push_back({BINDING_SHADOW_ATLAS, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE});
  pipeline.bindings.push_back({BINDING_SHADOW_MOMENTS, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE});
}

NoShadows::NoShadows(const vulkan::Device& device)
    : atlas_(device, {.name = "no shadow atlas",
                      .format = VK_FORMAT_D32_SFLOAT,
                      .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}),
      maps_(take(vulkan::Buffer::create(device, {.name = "no shadow maps",
                                                 .bytes = sizeof(shared::ShadowMap),
                                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}))) {}

ShadowBound NoShadows::bound() const { return bound_of(maps_, atlas_, atlas_); }

ShadowBound Shadows::bound() const { return bound_of(map_buffer_, atlas(), moments_ ? moments_->image() : atlas()); }

}  // namespace lamp::app
