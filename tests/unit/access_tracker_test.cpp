// Barriers of an AccessTracker, held against what each use needs: no device, and what would be recorded is read.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "lamplight/vulkan.h"

namespace lamp::vulkan {
namespace {

constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 FRAGMENT = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 COPY = VK_PIPELINE_STAGE_2_COPY_BIT;
constexpr VkAccessFlags2 READ = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 SAMPLED = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 WRITE = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 COPY_TO = VK_ACCESS_2_TRANSFER_WRITE_BIT;

struct Masks {
  VkPipelineStageFlags2 from = 0;
  VkAccessFlags2 written = 0;
  VkPipelineStageFlags2 to = 0;
  VkAccessFlags2 visible = 0;

  friend bool operator==(const Masks&, const Masks&) = default;
};

struct Barriers {
  std::optional<Masks> memory;
  std::vector<VkImageMemoryBarrier2> images;
};

Barriers last_recorded;

void VKAPI_PTR record(VkCommandBuffer, const VkDependencyInfo* info) {
  if (info->memoryBarrierCount != 0) {
    const VkMemoryBarrier2& b = *info->pMemoryBarriers;
    last_recorded.memory = {b.srcStageMask, b.srcAccessMask, b.dstStageMask, b.dstAccessMask};
  }
  last_recorded.images.assign(info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
}

Barriers barriers_before(AccessTracker& tracker, const std::vector<Use>& uses) {
  DeviceFunctions vk;
  vk.vkCmdPipelineBarrier2 = record;
  last_recorded = {};
  tracker.barrier(vk, VK_NULL_HANDLE, uses);
  return last_recorded;
}

/// Of nothing, which no test reads.
template <class Handle>
Handle numbered(std::size_t number) {
  static char objects[8] = {};
  return reinterpret_cast<Handle>(&objects[number]);
}

Use of_buffer(VkPipelineStageFlags2 stages, VkAccessFlags2 access, std::size_t number = 1) {
  return {.resource = {.buffer = numbered<VkBuffer>(number)}, .stages = stages, .access = access};
}

Use of_image(VkImageLayout layout, VkPipelineStageFlags2 stages, VkAccessFlags2 access, bool discard = false) {
  return {.resource = {.image = numbered<VkImage>(7), .layout = layout},
          .stages = stages,
          .access = access,
          .discard = discard};
}

TEST(AccessTracker, OrdersUsesOfABuffer) {
  struct Step {
    Use use;
    std::optional<Masks> expected;
  };
  const Use write = of_buffer(COMPUTE, WRITE);
  const Use read = of_buffer(COMPUTE, READ);
  const Use fragment_read = of_buffer(FRAGMENT, READ);
  const Use sampled = of_buffer(COMPUTE, SAMPLED);
  const Use copy = of_buffer(COPY, COPY_TO);
  const Masks seen{COMPUTE, WRITE, COMPUTE, READ};
  const struct {
    const char* name;
    std::vector<Step> steps;
  } cases[] = {
      {"reads wait for nobody", {{read, {}}, {fragment_read, {}}, {read, {}}}},
      {"a write waits for readers, and what they read needs not be made visible",
       {{read, {}}, {fragment_read, {}}, {copy, Masks{COMPUTE | FRAGMENT, 0, COPY, COPY_TO}}}},
      {"a write is seen once by each stage and access",
       {{write, {}},
        {read, seen},
        {read, {}},
        {fragment_read, Masks{COMPUTE, WRITE, COMPUTE | FRAGMENT, READ}},
        {read, {}},
        {sampled, Masks{COMPUTE, WRITE, COMPUTE | FRAGMENT, READ | SAMPLED}},
        {fragment_read, {}},
        {sampled, {}}}},
      {"a write waits for a write", {{write, {}}, {copy, Masks{COMPUTE, WRITE, COPY, COPY_TO}}}},
      {"a write waits for the one before and for its readers",
       {{write, {}},
        {fragment_read, Masks{COMPUTE, WRITE, FRAGMENT, READ}},
        {copy, Masks{COMPUTE | FRAGMENT, WRITE, COPY, COPY_TO}}}},
      {"readers of the old value are no readers of the new one",
       {{fragment_read, {}},
        {write, Masks{FRAGMENT, 0, COMPUTE, WRITE}},
        {copy, Masks{COMPUTE, WRITE, COPY, COPY_TO}},
        {write, Masks{COPY, COPY_TO, COMPUTE, WRITE}}}},
      {"what is read and written is written",
       {{of_buffer(COMPUTE, READ | WRITE), {}},
        {of_buffer(COMPUTE, READ | WRITE), Masks{COMPUTE, WRITE, COMPUTE, READ | WRITE}},
        {fragment_read, Masks{COMPUTE, WRITE, FRAGMENT, READ}}}},
      {"another buffer is another", {{write, {}}, {of_buffer(COMPUTE, READ, 2), {}}, {read, seen}}},
  };
  for (const auto& [name, steps] : cases) {
    AccessTracker tracker;
    for (std::size_t i = 0; i < steps.size(); ++i)
      EXPECT_TRUE(barriers_before(tracker, {steps[i].use}).memory == steps[i].expected) << name << ", step " << i;
  }
}

TEST(AccessTracker, OneBarrierServesAllUsesOfAPass) {
  AccessTracker tracker;
  static_cast<void>(barriers_before(tracker, {of_buffer(COMPUTE, WRITE, 1), of_buffer(COPY, COPY_TO, 2)}));
  const Barriers both = barriers_before(tracker, {of_buffer(FRAGMENT, READ, 1), of_buffer(COMPUTE, READ, 2)});
  EXPECT_EQ(both.memory, (Masks{COMPUTE | COPY, WRITE | COPY_TO, COMPUTE | FRAGMENT, READ}));
  tracker.forget(numbered<VkBuffer>(1));
  EXPECT_FALSE(barriers_before(tracker, {of_buffer(COMPUTE, WRITE, 1)}).memory);
}

TEST(AccessTracker, ImagesChangeTheirLayoutBehindReadersAndWriters) {
  constexpr VkImageLayout GENERAL = VK_IMAGE_LAYOUT_GENERAL;
  constexpr VkImageLayout READ_ONLY = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  AccessTracker tracker;
  const auto change = [&](const Use& use) {
    const Barriers recorded = barriers_before(tracker, {use});
    EXPECT_FALSE(recorded.memory);
    EXPECT_EQ(recorded.images.size(), 1U);
    return recorded.images.empty() ? VkImageMemoryBarrier2{} : recorded.images.front();
  };
  const auto masks = [](const VkImageMemoryBarrier2& b) {
    return Masks{b.srcStageMask, b.srcAccessMask, b.dstStageMask, b.dstAccessMask};
  };
  const VkImageMemoryBarrier2 first = change(of_image(GENERAL, COMPUTE, WRITE));
  EXPECT_EQ(first.oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(first.newLayout, GENERAL);
  const VkImageMemoryBarrier2 to_read = change(of_image(READ_ONLY, FRAGMENT, SAMPLED));
  EXPECT_EQ(masks(to_read), (Masks{COMPUTE, WRITE, FRAGMENT, SAMPLED}));
  EXPECT_EQ(to_read.oldLayout, GENERAL);
  // Another stage waits for the change, which is a write.
  EXPECT_EQ(barriers_before(tracker, {of_image(READ_ONLY, COMPUTE, SAMPLED)}).memory,
            (Masks{FRAGMENT, 0, COMPUTE | FRAGMENT, SAMPLED}));
  EXPECT_FALSE(barriers_before(tracker, {of_image(READ_ONLY, FRAGMENT, SAMPLED)}).memory);
  const VkImageMemoryBarrier2 back = change(of_image(GENERAL, COPY, COPY_TO));
  EXPECT_EQ(masks(back), (Masks{COMPUTE | FRAGMENT, 0, COPY, COPY_TO}));
  const VkImageMemoryBarrier2 lost = change(of_image(GENERAL, COMPUTE, WRITE, /*discard=*/true));
  EXPECT_EQ(masks(lost), (Masks{COPY, COPY_TO, COMPUTE, WRITE}));
  EXPECT_EQ(lost.oldLayout, VK_IMAGE_LAYOUT_UNDEFINED) << "in the same layout, what it held may be lost";
}

}  // namespace
}  // namespace lamp::vulkan
