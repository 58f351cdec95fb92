// What a host takes from a look-up to make its pipelines and sets.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/bound_lookup.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lamplight/light_layout.h"
#include "lamplight/method.h"

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

TEST(LightLayout, OfPlacesIsOfWholeUnitsAndHoldsTheRecord) {
  using lamp::LightForm;
  const auto error_of = [](const lamp::LightLayout& layout) {
    const auto error = layout.check();
    return error ? error->text() : "none";
  };
  EXPECT_EQ(error_of({.lights = {.offset = 32, .stride = 80}}), "none");
  EXPECT_EQ(error_of({.lights = {.offset = 8}}), "light offset: expected a multiple of 16 bytes, got 8");
  const std::string stride = " stride: expected a multiple of 16 bytes, at least ";
  EXPECT_EQ(error_of({.lights = {.stride = 72}}), "light" + stride + "64, got 72");
  EXPECT_EQ(error_of({.lights = {.stride = 48}}), "light" + stride + "64, got 48");
  EXPECT_EQ(error_of({.form = LightForm::points, .lights = {.stride = 48}}), "none");
  EXPECT_EQ(error_of({.form = LightForm::spots, .cones = {.offset = 4}}),
            "cone offset: expected a multiple of 16 bytes, got 4");
  EXPECT_EQ(error_of({.form = LightForm::spots, .cones = {.stride = 24}}), "cone" + stride + "16, got 24");
}

// What does not fit would else be cut to 32 bits, or read as another layout that is sound.
TEST(LightLayout, OfWhatIsNoRecordSaysWhatIsWrong) {
  const auto error_of = [](std::size_t bytes, std::size_t position, std::optional<std::size_t> direction = {}) {
    const auto layout = lamp::LightLayout::interleaved(bytes, position, direction);
    const auto error = layout.check();
    const lamp::Result<lamp::Plan> plan = lamp::make_plan(
        *lamp::find_method("all").value(), {.width = 64, .height = 64, .light_capacity = 10, .light_layout = layout});
    EXPECT_EQ(plan.ok(), !error);
    return error ? error->text() : "none";
  };
  const std::string record = "record of a light: expected a multiple of 16 bytes, 16 to 4294967280, got ";
  const std::string position = "position in the record of a light: expected ";
  const std::string direction = "direction in the record of a light: expected ";
  const std::string within = "a multiple of 16, at most 64 in a record of 80 bytes, got ";
  EXPECT_EQ(error_of(80, 64), "none");
  EXPECT_EQ(error_of(16, 0), "none");
  EXPECT_EQ(error_of(80, 16, 64), "none");
  EXPECT_EQ(error_of(80, 64, 0), "none");
  EXPECT_EQ(error_of(0, 0), record + "0");
  EXPECT_EQ(error_of(40, 0), record + "40");
  EXPECT_EQ(error_of((1ULL << 32) + 80, 16), record + "4294967295 or more");
  EXPECT_EQ(error_of(1ULL << 40, 16), record + "4294967295 or more");
  EXPECT_EQ(error_of(80, 20), position + within + "20");
  EXPECT_EQ(error_of(80, 80), position + within + "80");
  EXPECT_EQ(error_of(80, 1ULL << 33), position + within + "4294967295 or more");
  EXPECT_EQ(error_of(80, 16, 72), direction + within + "72");
  EXPECT_EQ(error_of(80, 16, (1ULL << 32) + 32), direction + within + "4294967295 or more");
  EXPECT_EQ(error_of(80, 16, 16), direction + "other 16 bytes than those of position and range, got 16");
}

}  // namespace
