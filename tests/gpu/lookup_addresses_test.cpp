// Look-ups whose buffers a shader reads by their addresses: each says what it says through descriptors, word by word.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/dispatch.h"
#include "gpu/lookup_cases.h"
#include "gpu/made_up_frame.h"
#include "gpu/test_scenes.h"
#include "lamplight/vulkan/culler.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WORDS = 11;  // of a pixel, in walks.comp
constexpr glm::uvec2 SIZE(85, 53);

class LookUpAddresses : public GpuTest, public ::testing::WithParamInterface<LookUpCase> {
 protected:
  void SetUp() override {
    if (!test_context().has_buffer_addresses()) GTEST_SKIP() << "the device lacks bufferDeviceAddress";
    device_.buffer_addresses = true;
    device_.traits.max_loop_rounds = GetParam().max_loop_rounds;
  }

  [[nodiscard]] vulkan::Pipeline pipeline(const std::string& shader, const vulkan::BoundLookUp& lookup) const {
    vulkan::PipelineInfo info{
        .name = shader, .constants = lookup.specialization({{0, 8}, {1, 8}}).constants, .bindings = {{0}, {1}, {2}}};
    for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
    return take(vulkan::Pipeline::compute(device_, info, test_shader(shader + "@" + std::string(lookup.name))));
  }

  vulkan::Device device_ = test_context().device();
};

TEST_P(LookUpAddresses, SayWhatDescriptorsSay) {
  const View view = made_up_view(SIZE, 0.2);
  const std::vector<shared::Light> lights = scattered_lights(view, LOOKUP_LIGHTS);
  const vulkan::Buffer light_buffer = host_buffer_of("lights", lights);
  const GpuImage depth = depth_image(SIZE.x, SIZE.y, made_up_depths(SIZE));
  vulkan::Culler culler = take(vulkan::Culler::create(device_, {.width = SIZE.x,
                                                                .height = SIZE.y,
                                                                .light_capacity = LOOKUP_LIGHTS,
                                                                .method = std::string(GetParam().method),
                                                                .options = GetParam().settings}));
  const vulkan::BoundLookUp lookup = culler.lookup();
  ASSERT_EQ(lookup.name, GetParam().lookup);
  const vulkan::Buffer addresses = host_buffer_of("addresses", take(lookup.addresses(device_)));
  const vulkan::Pipeline pipelines[] = {pipeline("walks", lookup), pipeline("walks_by_address", lookup)};
  const std::size_t bytes = std::size_t{SIZE.x} * SIZE.y * WORDS * sizeof(std::uint32_t);
  const vulkan::Buffer found[] = {host_buffer("words", bytes), host_buffer("words by address", bytes)};
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    tracker.assume(depth.sampled());
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    static_cast<void>(take(culler.record(commands, {.view = &view,
                                                    .lights = light_buffer.handle(),
                                                    .light_count = LOOKUP_LIGHTS,
                                                    .host_lights = lights,
                                                    .depth_image = depth.sampled().image,
                                                    .depth_view = depth.sampled().view,
                                                    .depth_layout = depth.sampled().layout})));
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<vulkan::Bound> bound = lookup.resources;
      bound.push_back({0, lookup.resources.front().resource});
      bound.push_back({1, vulkan::Resource::storage(found[i].handle())});
      bound.push_back({2, vulkan::Resource::storage(addresses.handle())});
      recorder.bind(pipelines[i], bound);
      vkCmdDispatch(commands, SIZE.x / 8 + 1, SIZE.y / 8 + 1, 1);
    }
    recorder.order(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_HOST_BIT);
  });
  const auto by_descriptors = contents<std::uint32_t>(found[0]);
  const auto by_addresses = contents<std::uint32_t>(found[1]);
  EXPECT_TRUE(std::ranges::any_of(by_descriptors, [](std::uint32_t word) { return word != 0; }));
  const std::size_t at = std::ranges::mismatch(by_descriptors, by_addresses).in1 - by_descriptors.begin();
  EXPECT_EQ(at, by_addresses.size()) << "pixel " << at / WORDS << ", word " << at % WORDS << " of walks.comp";
}

INSTANTIATE_TEST_SUITE_P(Of, LookUpAddresses, ::testing::ValuesIn(lookup_cases()), [](const auto& test) {
  return test_name(fmt::format("{}_{}", test.param.lookup, test.index));
});

class LookUpWithoutAddresses : public GpuTest {};

TEST_F(LookUpWithoutAddresses, SaysWhatTheDeviceMustHave) {
  const vulkan::Culler culler = take(vulkan::Culler::create(
      test_context().device(), {.width = SIZE.x, .height = SIZE.y, .light_capacity = 8, .method = "clustered"}));
  EXPECT_EQ(culler.lookup().addresses(test_context().device()).error().text(),
            "look-up cluster_lists: expected a device with the feature bufferDeviceAddress that says "
            "Device::buffer_addresses, got one without");
}

}  // namespace
}  // namespace lamp::app
