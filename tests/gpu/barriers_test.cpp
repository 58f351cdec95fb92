// "Who waits for what" of docs/integrating.md, with synchronization validation on: an engine that puts the barriers
// which the page asks for, and no others, around every method; and readers of other stages.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "gpu/flying.h"

namespace lamp::app {
namespace {

void record_barrier(VkCommandBuffer commands, std::span<const VkMemoryBarrier2> memory,
                    std::span<const VkImageMemoryBarrier2> images = {}) {
  const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .memoryBarrierCount = static_cast<std::uint32_t>(memory.size()),
                                    .pMemoryBarriers = memory.data(),
                                    .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
                                    .pImageMemoryBarriers = images.data()};
  vkCmdPipelineBarrier2(commands, &dependency);
}

/// Lights, their count, spheres and depth that every frame copies anew.
class CopiedInputs {
 public:
  CopiedInputs()
      : lights_(host_buffer("copied lights", ENGINE_LIGHTS * sizeof(shared::Light))),
        spheres_(host_buffer("copied spheres", ENGINE_LIGHTS * sizeof(shared::LightSphere))),
        count_(host_buffer_of<std::uint32_t>("light count", {ENGINE_LIGHTS})),
        copied_count_(host_buffer("copied light count", sizeof(std::uint32_t))),
        depth_(test_context().device(), {.name = "copied depth",
                                         .width = ENGINE_WIDTH,
                                         .height = ENGINE_HEIGHT,
                                         .format = VK_FORMAT_D32_SFLOAT,
                                         .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT}) {}

  /// After any reader: `stages` have read. Before the cull: visible to these. And what is ordered besides.
  void record_copies(VkCommandBuffer commands, const EngineFrame& frame, const vulkan::Buffer& depth_values,
                     VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                     const VkMemoryBarrier2& besides = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2}) {
    record_barrier(commands,
                   std::array{VkMemoryBarrier2{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                               .srcStageMask = stages,
                                               .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT}},
                   std::array{depth_barrier(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                                            VK_PIPELINE_STAGE_2_COPY_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL)});
    const auto copy = [&](const vulkan::Buffer& from, const vulkan::Buffer& to) {
      const VkBufferCopy whole{.size = to.bytes()};
      vkCmdCopyBuffer(commands, from.handle(), to.handle(), 1, &whole);
    };
    copy(frame.light_buffer, lights_);
    copy(frame.sphere_buffer, spheres_);
    copy(count_, copied_count_);
    const VkBufferImageCopy whole = depth_.whole();
    vkCmdCopyBufferToImage(commands, depth_values.handle(), depth_.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &whole);
    record_barrier(
        commands,
        std::array{VkMemoryBarrier2{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                    .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                    .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                    .dstStageMask = stages,
                                    .dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT},
                   besides},
        std::array{depth_barrier(VK_PIPELINE_STAGE_2_COPY_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                 VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)});
  }

  [[nodiscard]] vulkan::CullerFrame culler_frame(const EngineFrame& frame, bool gpu_counts) const {
    vulkan::CullerFrame copied = lamp::app::culler_frame(frame);
    copied.lights = lights_.handle();
    copied.spheres = spheres_.handle();
    if (gpu_counts) {
      copied.light_count = 0;
      copied.light_count_buffer = copied_count_.handle();
    }
    copied.depth_image = depth_.handle();
    copied.depth_view = depth_.view();
    copied.depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    return copied;
  }

 private:
  [[nodiscard]] VkImageMemoryBarrier2 depth_barrier(VkPipelineStageFlags2 from, VkImageLayout from_layout,
                                                    VkPipelineStageFlags2 to, VkImageLayout to_layout) const {
    const bool written = from == VK_PIPELINE_STAGE_2_COPY_BIT;
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = from,
            .srcAccessMask = written ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VkAccessFlags2{0},
            .dstStageMask = to,
            .dstAccessMask = written ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT : VK_ACCESS_2_TRANSFER_WRITE_BIT,
            .oldLayout = from_layout,
            .newLayout = to_layout,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = depth_.handle(),
            .subresourceRange = {depth_.aspect(), 0, 1, 0, 1}};
  }

  vulkan::Buffer lights_;
  vulkan::Buffer spheres_;
  vulkan::Buffer count_;
  vulkan::Buffer copied_count_;
  GpuImage depth_;
};

bool works_on_cpu(const CullerCandidate& candidate) {
  return std::ranges::find(candidate.options, "sort=cpu") != candidate.options.end();
}

class Barriers : public GpuTest {
 protected:
  const EngineFrame frames_[2] = {engine_frame(), engine_frame({.projection = "orthographic", .seed = 2})};
};

TEST_F(Barriers, OfThePageAreEnoughForEveryMethod) {
  const vulkan::Buffer depths[2] = {host_buffer_of("depth", frames_[0].depth),
                                    host_buffer_of("depth", frames_[1].depth)};
  CopiedInputs inputs;
  for (const CullerCandidate& candidate : culler_candidates()) {
    SCOPED_TRACE(candidate.method);
    vulkan::Culler culler = take(engine_culler(candidate.method, candidate.options, /* brings_spheres= */ true));
    std::vector<MaskPass> passes;
    for (const EngineFrame& frame : frames_) passes.emplace_back(culler.lookup(), frame);
    for (int round = 0; round < 2; ++round) {
      test_context().submit([&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < 2; ++i) {
          inputs.record_copies(commands, frames_[i], depths[i]);
          static_cast<void>(take(culler.record(commands, inputs.culler_frame(frames_[i], !works_on_cpu(candidate)))));
          passes[i].record(commands, culler.lookup());
        }
        MaskPass::record_to_host(commands);
      });
      for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(passes[i].masks(), masks_alone(candidate, frames_[i])) << i;
      for (const std::string& message : test_context().take_messages()) ADD_FAILURE() << message;
    }
  }
}

/// The same, with barriers of the engine's in place of the Culler's own.
std::vector<Masks> culled_between(const CullerCandidate& candidate, std::span<const EngineFrame> frames,
                                  std::span<const vulkan::Buffer> depths, CopiedInputs& inputs, bool gpu_counts,
                                  bool has_behind = true) {
  vulkan::CullerInfo info = engine_culler_info(candidate.method, candidate.options);
  info.brings_spheres = true;
  info.host_barriers = true;
  vulkan::Culler culler = take(vulkan::Culler::create(test_context().device(), info));
  const VkMemoryBarrier2 before = culler.barrier_before();
  std::vector<MaskPass> passes;
  for (const EngineFrame& frame : frames) passes.emplace_back(culler.lookup(), frame);
  test_context().submit([&](VkCommandBuffer commands) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      inputs.record_copies(commands, frames[i], depths[i], before.dstStageMask, before);
      static_cast<void>(take(culler.record(commands, inputs.culler_frame(frames[i], gpu_counts))));
      if (has_behind) record_barrier(commands, std::array{culler.barrier_behind()});
      passes[i].record(commands, culler.lookup());
    }
    MaskPass::record_to_host(commands);
  });
  std::vector<Masks> masks;
  for (const MaskPass& pass : passes) masks.push_back(pass.masks());
  return masks;
}

TEST_F(Barriers, OfTheHostMayStandForTheCullers) {
  const vulkan::Buffer depths[2] = {host_buffer_of("depth", frames_[0].depth),
                                    host_buffer_of("depth", frames_[1].depth)};
  CopiedInputs inputs;
  for (const CullerCandidate& candidate : culler_candidates()) {
    SCOPED_TRACE(candidate.method);
    for (const bool gpu_counts : {false, true}) {
      if (gpu_counts && works_on_cpu(candidate)) continue;
      const std::vector<Masks> masks = culled_between(candidate, frames_, depths, inputs, gpu_counts);
      for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(masks[i], masks_alone(candidate, frames_[i])) << i;
      for (const std::string& message : test_context().take_messages()) ADD_FAILURE() << message;
    }
  }
  static_cast<void>(culled_between({"tiled-bits", {}}, frames_, depths, inputs, /* gpu_counts= */ false,
                                   /* has_behind= */ false));
  std::string all;
  for (const std::string& message : test_context().take_messages()) all += message;
  EXPECT_NE(all.find("SYNC-HAZARD-READ-AFTER-WRITE"), std::string::npos);
}

/// Messages about a look-up that is copied without a barrier, by an engine that says who reads it.
std::string copied_by(VkPipelineStageFlags2 readers, const EngineFrame& frame) {
  vulkan::CullerInfo info = engine_culler_info("tiled-bits");
  info.readers = readers;
  vulkan::Culler culler = take(vulkan::Culler::create(test_context().device(), info));
  const VkBuffer bits = culler.lookup().resources[1].resource.buffer;
  const vulkan::Buffer copy = host_buffer("copy", 64);
  const vulkan::Buffer other = host_buffer("another copy", 64);
  test_context().submit([&](VkCommandBuffer commands) {
    for (const vulkan::Buffer* to : {&copy, &other}) {
      static_cast<void>(take(culler.record(commands, culler_frame(frame))));
      const VkBufferCopy some{.size = 64};
      vkCmdCopyBuffer(commands, bits, to->handle(), 1, &some);
    }
  });
  std::string all;
  for (const std::string& message : test_context().take_messages()) all += message;
  return all;
}

TEST_F(Barriers, ReadersAreWhoTheHostSays) {
  EXPECT_EQ(copied_by(VK_PIPELINE_STAGE_2_COPY_BIT, frames_[0]), "");
  EXPECT_EQ(copied_by(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT, frames_[0]), "");
  EXPECT_NE(copied_by(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, frames_[0]).find("SYNC-HAZARD-READ-AFTER-WRITE"),
            std::string::npos);
}

}  // namespace
}  // namespace lamp::app
