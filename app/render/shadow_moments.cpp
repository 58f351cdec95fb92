// Records the blur.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_moments.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cstring>

#include "gpu/check.h"
#include "render/shadow_squares.h"

namespace lamp::app {
namespace {

/// Texels that a work group blurs, at most (blur_strip.glsl, blur_listing.glsl).
glm::uvec2 most_of_group(ShadowBlur blur) {
  if (blur == ShadowBlur::listing) return {shared::LEAST_SQUARE, shared::LEAST_SQUARE};
  return {64, 128};
}

/// Of a square of that side.
std::uint32_t groups_of(std::uint32_t side, ShadowBlur blur) {
  const glm::uvec2 texels = glm::min(most_of_group(blur), glm::uvec2(side));
  return side * side / (texels.x * texels.y);
}

constexpr std::uint64_t LEAST_GROUP_TEXELS = std::uint64_t{shared::LEAST_SQUARE} * shared::LEAST_SQUARE;
constexpr std::uint32_t MOST_GROUPS_X = 32768;
constexpr std::uint32_t BINDING_DEPTHS = 1;
constexpr std::uint32_t BINDING_BETWEEN = 2;
constexpr std::uint32_t BINDING_BLOCKS = 3;
constexpr std::uint32_t BINDING_BLURRED = 4;

void check_storage(const Context& context, VkFormat format) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(context.device().physical, format, &properties);
  VkPhysicalDeviceFeatures features{};
  vkGetPhysicalDeviceFeatures(context.device().physical, &features);
  if ((properties.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) == 0 ||
      features.shaderStorageImageExtendedFormats == VK_FALSE)
    throw Error(fmt::format("--shadows: device {} cannot store images of moments", context.row().name),
                Exit::no_device);
}

}  // namespace

ShadowMoments::ShadowMoments(const Context& context, const ShaderLibrary& shaders, ShadowFilter filter, ShadowBlur blur,
                             std::uint32_t atlas_size)
    : blur_(blur) {
  const bool exponential = filter == ShadowFilter::evsm;
  const VkFormat format = exponential ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32_SFLOAT;
  check_storage(context, format);
  const vulkan::Device& device = context.device();
  const auto make = [&](const char* name) {
    return GpuImage(
        device, {.name = name,
                 .width = atlas_size,
                 .height = atlas_size,
                 .format = format,
                 .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  };
  blurred_ = make("shadow moments");
  blocks_ = take(vulkan::Buffer::create(
      device,
      {.name = "shadow blocks",
       .bytes = std::max<std::uint64_t>(1, std::uint64_t{atlas_size} * atlas_size / LEAST_GROUP_TEXELS) * sizeof(Block),
       .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
       .memory = vulkan::MemoryUse::records}));
  const auto pass = [&](const char* name, std::uint32_t source, const char* directions) {
    return take(vulkan::Pipeline::compute(
        device,
        {.name = name,
         .constants = {{0, static_cast<std::uint32_t>(filter)}},
         .bindings = {{0},
                      {source, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
                      {BINDING_BLOCKS},
                      {BINDING_BLURRED, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}},
         .push_constant_bytes = sizeof(std::uint32_t)},
        shaders.spirv(fmt::format("shadow/blur_{}{}{}", exponential ? "evsm" : "vsm",
                                  blur == ShadowBlur::listing ? "_listing" : "", directions))));
  };
  if (blur == ShadowBlur::fused) {
    from_depths_ = pass("shadow blur", BINDING_DEPTHS, "");
    return;
  }
  between_ = make("shadow moments, blurred along x");
  from_depths_ = pass("shadow blur along x", BINDING_DEPTHS, "_x");
  from_between_ = pass("shadow blur along y", BINDING_BETWEEN, "_y");
}

void ShadowMoments::set(std::span<const shared::ShadowMap> maps, std::span<const ShadowRedraw> redraws) {
  std::vector<Block> blocks;
  for (const ShadowRedraw& redraw : redraws) {
    const shared::ShadowMap& map = maps[redraw.light];
    const std::uint32_t of_square = squares_of(map) == 0 ? 0 : groups_of(map.side, blur_);
    for (std::uint32_t square = 0; square < squares_of(map); ++square)
      for (std::uint32_t i = 0; i < of_square; ++i)
        blocks.push_back({.light = redraw.light, .square = square, .block = i});
  }
  block_count_ = static_cast<std::uint32_t>(blocks.size());
  if (!blocks.empty()) std::memcpy(blocks_.mapped().data(), blocks.data(), blocks.size() * sizeof(Block));
}

void ShadowMoments::record_pass(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline,
                                std::vector<vulkan::Bound> bound) const {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  bound.push_back({BINDING_BLOCKS, vulkan::Resource::storage(blocks_.handle())});
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound)
    uses.push_back(
        b.binding == BINDING_BLURRED
            ? vulkan::Use{.resource = b.resource, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}
            : reads(b.resource, COMPUTE));
  recorder.barrier(uses);
  recorder.bind(pipeline, bound);
  vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(block_count_),
                     &block_count_);
  const std::uint32_t wide = std::min(block_count_, MOST_GROUPS_X);
  vkCmdDispatch(recorder.commands(), wide, (block_count_ + wide - 1) / wide, 1);
}

void ShadowMoments::record(vulkan::Recorder& recorder, const vulkan::Resource& maps, const GpuImage& atlas) const {
  if (block_count_ == 0) return;
  recorder.begin_pass("shadow blur", {});
  const GpuImage& first = blur_ == ShadowBlur::fused ? blurred_ : between_;
  record_pass(recorder, from_depths_,
              {{0, maps}, {BINDING_DEPTHS, atlas.sampled()}, {BINDING_BLURRED, first.storage()}});
  if (blur_ != ShadowBlur::fused)
    record_pass(recorder, from_between_,
                {{0, maps}, {BINDING_BETWEEN, between_.sampled()}, {BINDING_BLURRED, blurred_.storage()}});
  recorder.end_pass();
}

}  // namespace lamp::app
