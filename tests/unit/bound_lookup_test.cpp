// What a host takes from a look-up to make its pipelines and sets.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/bound_lookup.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lamplight/light_layout.h"

namespace {

using lamp::vulkan::BoundLookUp;
using lamp::vulkan::Resource;

/// Of nothing, but each its own.
constexpr char OBJECTS[3] = {};
template <class Handle>
Handle handle(int number) {
  return reinterpret_cast<Handle>(const_cast<char*>(&OBJECTS[number]));
}

/// Two constants and two buffers, of which the second shows a part.
BoundLookUp some_lookup() {
  return {.name = "some",
          .constants = {{100, 16}, {103, 7}},
          .resources = {{16, Resource::storage({handle<VkBuffer>(1)})},
                        {17, Resource::storage({handle<VkBuffer>(2), 256, 1024})}}};
}

TEST(BoundLookUp, HasBindingsBehindThoseOfTheHost) {
  const auto bindings = some_lookup().layout_bindings(
      VK_SHADER_STAGE_FRAGMENT_BIT, {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_ALL, nullptr}});
  ASSERT_EQ(bindings.size(), 3);
  EXPECT_EQ(bindings[0].descriptorType, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
  EXPECT_EQ(bindings[2].binding, 17);
  EXPECT_EQ(bindings[2].descriptorType, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  EXPECT_EQ(bindings[2].descriptorCount, 1);
  EXPECT_EQ(bindings[2].stageFlags, VkShaderStageFlags{VK_SHADER_STAGE_FRAGMENT_BIT});
}

TEST(BoundLookUp, WritesItsBuffersAlsoWhereTheWritesAreMoved) {
  const auto set = handle<VkDescriptorSet>(0);
  lamp::vulkan::DescriptorWrites made = some_lookup().writes(set);
  const lamp::vulkan::DescriptorWrites moved = std::move(made);
  ASSERT_EQ(moved.writes.size(), 2);
  EXPECT_EQ(moved.writes[0].pBufferInfo->buffer, handle<VkBuffer>(1));
  EXPECT_EQ(moved.writes[0].pBufferInfo->range, VK_WHOLE_SIZE);
  EXPECT_EQ(moved.writes[1].dstSet, set);
  EXPECT_EQ(moved.writes[1].dstBinding, 17);
  EXPECT_EQ(moved.writes[1].pBufferInfo->offset, 256);
}

TEST(BoundLookUp, SpecializesAPipeline) {
  const lamp::vulkan::SpecializationConstants made = some_lookup().specialization({{3, 5}});
  const VkSpecializationInfo info = made.info();
  ASSERT_EQ(info.mapEntryCount, 3);
  constexpr std::pair<std::uint32_t, std::uint32_t> EXPECTED[] = {{3, 5}, {100, 16}, {103, 7}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const VkSpecializationMapEntry& entry = info.pMapEntries[i];
    ASSERT_LE(entry.offset + entry.size, info.dataSize);
    std::uint32_t value = 0;
    std::memcpy(&value, static_cast<const std::byte*>(info.pData) + entry.offset, sizeof(value));
    EXPECT_EQ(std::pair(entry.constantID, value), EXPECTED[i]);
  }
}

TEST(BoundLookUp, MovesToWhatAShaderSays) {
  const BoundLookUp moved = some_lookup().moved_to(3, 0);
  EXPECT_EQ(moved.resources[1].binding, 4);
  EXPECT_EQ(moved.constants[1].id, 3);
  EXPECT_EQ(some_lookup().moved_to(3).constants[1].id, 103);
}

struct HostLight {
  float position[3], range, color[4], direction[3], outer_angle;
};

TEST(LightLayout, IsThatOfAHostsRecord) {
  const auto spots =
      lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, position), offsetof(HostLight, direction));
  EXPECT_EQ(spots.form, lamp::LightForm::spots);
  EXPECT_EQ(spots.lights, (lamp::RecordPlaces{0, 48}));
  EXPECT_EQ(spots.cones, (lamp::RecordPlaces{32, 48}));
  EXPECT_FALSE(spots.check());
  const auto points = lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, color));
  EXPECT_EQ(points.form, lamp::LightForm::points);
  EXPECT_EQ(points.lights, (lamp::RecordPlaces{16, 48}));
}

}  // namespace
