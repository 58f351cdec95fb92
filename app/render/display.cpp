// Two dispatches over the pixels.
// SPDX-License-Identifier: Apache-2.0
#include "render/display.h"

#include <array>
#include <bit>
#include <cmath>

#include "gpu/check.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP_PX = 16;
constexpr double MIDDLE_GREY = 0.18;  // as in image/tone_map.cpp
constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

std::uint32_t groups(std::uint32_t pixels) { return (pixels + GROUP_PX - 1) / GROUP_PX; }

vulkan::Pipeline pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const char* name,
                          const std::vector<vulkan::DescriptorBinding>& bindings, std::uint32_t push_bytes) {
  return take(vulkan::Pipeline::compute(device, {.name = name, .bindings = bindings, .push_constant_bytes = push_bytes},
                                        shaders.spirv(name)));
}

vulkan::Use radiance_of(const Targets& targets) {
  return {.resource = targets.hdr.storage(), .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
}

void dispatch(const vulkan::Recorder& recorder, const Targets& targets) {
  vkCmdDispatch(recorder.commands(), groups(targets.width), groups(targets.height), 1);
}

}  // namespace

Display::Display(const vulkan::Device& device, const ShaderLibrary& shaders, std::uint32_t width, std::uint32_t height)
    : image_(std::make_shared<GpuImage>(
          device, GpuImageInfo{.name = "shown",
                               .width = width,
                               .height = height,
                               .format = VK_FORMAT_R8G8B8A8_UNORM,
                               .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT})),
      sum_(pipeline(device, shaders, "exposure", {{0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}, {1}}, 0)),
      show_(pipeline(device, shaders, "display",
                     {{0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}, {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}, {2}},
                     4 * sizeof(std::uint32_t))) {
  const std::uint64_t sums = std::uint64_t{groups(width)} * groups(height);
  sums_ = take(vulkan::Buffer::create(device, {.name = "exposure sums",
                                               .bytes = sums * sizeof(glm::vec2),
                                               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                               .memory = vulkan::MemoryUse::readback}));
  overlay_ = take(vulkan::Buffer::create(device, {.name = "overlay",
                                                  .bytes = std::uint64_t{width} * height * sizeof(std::uint32_t),
                                                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                                  .memory = vulkan::MemoryUse::upload}));
}

void Display::record_sums(vulkan::Recorder& recorder, const Targets& targets) {
  const vulkan::Resource sums = vulkan::Resource::storage(sums_.handle());
  recorder.begin_pass("exposure",
                      {radiance_of(targets), {.resource = sums, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
  recorder.bind(sum_, std::to_array<vulkan::Bound>({{0, targets.hdr.storage()}, {1, sums}}));
  dispatch(recorder, targets);
  recorder.end_pass();
  recorder.barrier({host_reads(sums)});
}

float Display::exposure() const {
  glm::dvec2 total(0.0);
  const auto* sums = reinterpret_cast<const glm::vec2*>(sums_.mapped().data());
  for (std::size_t i = 0; i < sums_.bytes() / sizeof(glm::vec2); ++i) total += glm::dvec2(sums[i]);
  return total.y == 0.0 ? 1.0F : static_cast<float>(MIDDLE_GREY / std::exp(total.x / total.y));
}

std::span<std::uint32_t> Display::overlay() {
  const std::span<std::byte> bytes = overlay_.mapped();
  return {reinterpret_cast<std::uint32_t*>(bytes.data()), bytes.size() / sizeof(std::uint32_t)};
}

void Display::record(vulkan::Recorder& recorder, const Targets& targets, const Part& part) {
  const vulkan::Resource shown = image_->storage();
  const vulkan::Resource overlay = vulkan::Resource::storage(overlay_.handle());
  recorder.begin_pass("display", {radiance_of(targets),
                                  {.resource = shown, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                                  {.resource = overlay}});
  recorder.bind(show_, std::to_array<vulkan::Bound>({{0, targets.hdr.storage()}, {1, shown}, {2, overlay}}));
  const std::array<std::uint32_t, 4> push{std::bit_cast<std::uint32_t>(part.exposure), part.first_x, part.end_x,
                                          part.overlaid ? 1U : 0U};
  vkCmdPushConstants(recorder.commands(), show_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), push.data());
  dispatch(recorder, targets);
  recorder.end_pass();
  recorder.barrier({{.resource = image_->transfer_source(),
                     .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                     .access = VK_ACCESS_2_TRANSFER_READ_BIT}});
}

}  // namespace lamp::app
