// Makes the image, and records the passes that fill a block.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP_PX = 8;  // threads along a side of all passes' groups
constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

/// Blocks along x and y.
std::pair<std::uint32_t, std::uint32_t> blocks_of(const vulkan::Device& device, std::uint32_t slots) {
  const std::uint32_t limit = device.traits.max_image_size;
  const std::uint32_t most_columns = limit / gpu::PROBE_BLOCK_WIDTH;
  const std::uint32_t most_rows = limit / gpu::PROBE_BLOCK_HEIGHT;
  if (slots > most_columns * most_rows)
    throw Error(
        fmt::format("probe atlas: {} captures, expected at most {} on this device", slots, most_columns * most_rows));
  const std::uint32_t columns = std::clamp(slots, 1U, most_columns);
  return {columns, std::max(1U, (slots + columns - 1) / columns)};
}

GpuImage make_image(const vulkan::Device& device, std::uint32_t slots) {
  const auto [columns, rows] = blocks_of(device, slots);
  return {device,
          {.name = "probe atlas",
           .width = columns * gpu::PROBE_BLOCK_WIDTH,
           .height = rows * gpu::PROBE_BLOCK_HEIGHT,
           .format = VK_FORMAT_R16G16B16A16_SFLOAT,
           .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                    VK_IMAGE_USAGE_TRANSFER_DST_BIT}};
}

vulkan::OwnedSampler make_sampler(const vulkan::Device& device) {
  const VkSamplerCreateInfo create{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = VK_FILTER_LINEAR,
                                   .minFilter = VK_FILTER_LINEAR,
                                   .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
  VkSampler handle = VK_NULL_HANDLE;
  check(vkCreateSampler(device.handle, &create, nullptr, &handle), "creating the probe atlas's sampler");
  return {device.handle, handle, vkDestroySampler};
}

vulkan::Buffer device_buffer(const vulkan::Device& device, const char* name, std::uint64_t bytes) {
  return take(
      vulkan::Buffer::create(device, {.name = name,
                                      .bytes = bytes,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT}));
}

void clear(Context& context, const GpuImage& image) {
  context.submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(context.device(), commands, tracker);
    recorder.barrier({{.resource = image.transfer_target(),
                       .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                       .access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       .discard = true}});
    const VkClearColorValue black{};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &all);
    recorder.barrier({reads(image.sampled(), COMPUTE | GRAPHICS_SHADERS)});
  });
}

}  // namespace

void add_probe_atlas(vulkan::PipelineInfo& pipeline) {
  pipeline.bindings.push_back({BINDING_PROBE_ATLAS, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER});
}

std::vector<vulkan::Pipeline> ProbeAtlas::pipelines(const vulkan::Device& device, const ShaderLibrary& shaders) {
  const auto make = [&](const char* shader, std::vector<vulkan::DescriptorBinding> bindings) {
    return take(vulkan::Pipeline::compute(
        device, {.name = shader, .bindings = std::move(bindings), .push_constant_bytes = sizeof(gpu::ProbePush)},
        shaders.spirv(shader)));
  };
  return {make("probe_fold", {{0}, {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}, {2}}), make("probe_source", {{0}, {1}}),
          make("probe_filter", {{0}, {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}})};
}

ProbeAtlas::ProbeAtlas(Context& context, const ShaderLibrary& shaders, std::uint32_t slots)
    : slots_(slots),
      columns_(blocks_of(context.device(), slots).first),
      image_(make_image(context.device(), slots)),
      sampler_(make_sampler(context.device())) {
  const vulkan::Device& device = context.device();
  constexpr std::uint64_t SOURCES = std::uint64_t{gpu::PROBE_SOURCE_SIDE} * gpu::PROBE_SOURCE_SIDE;
  constexpr std::uint64_t PIXELS = std::uint64_t{gpu::PROBE_FACES} * gpu::PROBE_SIDE * gpu::PROBE_SIDE;
  clear(context, image_);
  if (slots == 0) return;
  faces_ = device_buffer(device, "probe faces", PIXELS * sizeof(Vec4));
  sources_ = device_buffer(device, "probe sources", SOURCES * sizeof(gpu::ProbeSource));
  clipped_ = readback_buffer(device, "clipped probe texels", sizeof(std::uint32_t));
  std::ranges::fill(clipped_.mapped(), std::byte{0});
  std::vector<vulkan::Pipeline> made = pipelines(device, shaders);
  fold_ = std::move(made[0]);
  source_ = std::move(made[1]);
  filter_ = std::move(made[2]);
}

void ProbeAtlas::record_pass(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline, const vulkan::Buffer& from,
                             const gpu::ProbePush& push, std::uint32_t side) const {
  constexpr VkAccessFlags2 WRITES = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  const vulkan::Resource read = vulkan::Resource::storage(from.handle());
  const bool to_image = pipeline.name() != source_.name();
  const vulkan::Resource to = to_image ? image_.storage() : vulkan::Resource::storage(sources_.handle());
  std::vector<vulkan::Bound> bound{{0, read}, {1, to}};
  std::vector<vulkan::Use> uses{reads(read, COMPUTE), {.resource = to, .stages = COMPUTE, .access = WRITES}};
  if (pipeline.name() == fold_.name()) {
    const vulkan::Resource counter = vulkan::Resource::storage(clipped_.handle());
    bound.push_back({2, counter});
    uses.push_back({.resource = counter, .stages = COMPUTE, .access = WRITES | VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
  }
  recorder.begin_pass(pipeline.name(), uses);
  recorder.bind(pipeline, bound);
  vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), &push);
  const std::uint32_t groups = (side + GROUP_PX - 1) / GROUP_PX;
  vkCmdDispatch(recorder.commands(), groups, groups, 1);
  recorder.end_pass();
}

glm::uvec2 ProbeAtlas::origin_of(std::uint32_t slot) const {
  return glm::uvec2(slot % columns_, slot / columns_) * glm::uvec2(gpu::PROBE_BLOCK_WIDTH, gpu::PROBE_BLOCK_HEIGHT);
}

void ProbeAtlas::record(vulkan::Recorder& recorder, std::uint32_t slot) const {
  const glm::uvec2 origin = origin_of(slot);
  gpu::ProbePush push{.origin_x = origin.x, .origin_y = origin.y};
  record_pass(recorder, fold_, faces_, push, gpu::PROBE_SIDE + 2 * gpu::PROBE_BORDER);
  record_pass(recorder, source_, faces_, push, gpu::PROBE_SOURCE_SIDE);
  for (push.level = 1; push.level < gpu::PROBE_LEVELS; ++push.level)
    record_pass(recorder, filter_, sources_, push, gpu::probe_level_side(push.level) + 2 * gpu::PROBE_BORDER);
  recorder.barrier(
      {host_reads(vulkan::Resource::storage(clipped_.handle())), reads(image_.sampled(), COMPUTE | GRAPHICS_SHADERS)});
}

HdrImage ProbeAtlas::read_level(Context& context, std::uint32_t slot, std::uint32_t level) const {
  const std::uint32_t side = gpu::probe_level_side(level);
  const vulkan::Buffer texels =
      readback_buffer(context.device(), "probe level", std::uint64_t{side} * side * sizeof(glm::u16vec4));
  const glm::uvec2 at = origin_of(slot) + glm::uvec2(gpu::probe_level_x(level), gpu::probe_level_y(level));
  context.submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    tracker.assume(image_.sampled());
    vulkan::Recorder recorder(context.device(), commands, tracker);
    const vulkan::Resource to = vulkan::Resource::storage(texels.handle());
    recorder.barrier({copies_from(image_.transfer_source()), copies_to(to)});
    VkBufferImageCopy square = image_.whole();
    square.imageOffset = {static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y), 0};
    square.imageExtent = {side, side, 1};
    vkCmdCopyImageToBuffer(commands, image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, texels.handle(), 1,
                           &square);
    recorder.barrier({host_reads(to), reads(image_.sampled(), COMPUTE | GRAPHICS_SHADERS)});
  });
  HdrImage image{side, side, {}};
  for (const glm::u16vec4& texel : first_values<glm::u16vec4>(texels, std::size_t{side} * side))
    image.pixels.push_back(glm::unpackHalf(texel));
  return image;
}

std::uint32_t ProbeAtlas::clipped() const { return slots_ == 0 ? 0 : first_values<std::uint32_t>(clipped_, 1).front(); }

}  // namespace lamp::app
