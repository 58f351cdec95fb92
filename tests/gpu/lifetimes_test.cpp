// What docs/threads-and-lifetimes.md promises: Cullers on several threads at once, Cullers that are moved, and what
// must outlive them.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>
#include <thread>
#include <utility>

#include "gpu/commands.h"
#include "gpu/engine_frame.h"

namespace lamp::app {
namespace {

using Lifetimes = GpuTest;

vulkan::Culler culler_on(const vulkan::Device& device, std::string_view method) {
  return take(vulkan::Culler::create(device, {.width = ENGINE_WIDTH,
                                              .height = ENGINE_HEIGHT,
                                              .light_capacity = ENGINE_LIGHTS,
                                              .method = std::string(method)}));
}

// Validation, which watches for objects that two threads use at once, is silent, and each Culler is right.
TEST_F(Lifetimes, CullersAreMadeAndRecordedOnSeveralThreadsAtOnce) {
  const EngineFrame frame = engine_frame();
  vulkan::PipelineStore store;
  vulkan::Device device = test_context().device();
  device.pipelines = &store;
  constexpr std::array METHODS{"clustered", "tiled", "lamplight", "clustered"};
  std::array<vulkan::Culler, METHODS.size()> cullers;
  std::array<std::unique_ptr<Commands>, METHODS.size()> commands;
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < METHODS.size(); ++i)
    threads.emplace_back([&, i] {
      cullers[i] = culler_on(device, METHODS[i]);
      commands[i] = std::make_unique<Commands>(
          [&](VkCommandBuffer buffer) { static_cast<void>(take(cullers[i].record(buffer, culler_frame(frame)))); });
    });
  threads.clear();  // waits for them
  for (std::size_t i = 0; i < METHODS.size(); ++i) {
    SCOPED_TRACE(METHODS[i]);
    commands[i]->submit();
    commands[i]->wait();
    const MaskPass pass(cullers[i].lookup(), frame);
    test_context().submit([&](VkCommandBuffer buffer) {
      pass.record(buffer, cullers[i].lookup());
      MaskPass::record_to_host(buffer);
    });
    expect_no_miss(frame, pass.masks());
  }
}

TEST_F(Lifetimes, AMovedCullerGoesOnAndWhatItReplacesIsReleased) {
  const EngineFrame frame = engine_frame();
  vulkan::Culler first = culler_on(test_context().device(), "clustered");
  const Masks expected = cull_and_walk(first, frame);
  vulkan::Culler second = std::move(first);
  EXPECT_EQ(cull_and_walk(second, frame), expected);
  first = culler_on(test_context().device(), "tiled");  // one that was moved from may be assigned to
  expect_no_miss(frame, cull_and_walk(first, frame));
  first = std::move(second);  // both are done: nothing of theirs is under way
  EXPECT_EQ(cull_and_walk(first, frame), expected);
}

// A Culler keeps the pipelines that it found in a store, and copies of the host's plain structs; it reads a camera only
// while it records.
TEST_F(Lifetimes, ACullerOutlivesWhatItWasMadeWith) {
  const EngineFrame frame = engine_frame();
  auto store = std::make_unique<vulkan::PipelineStore>();
  auto device = std::make_unique<vulkan::Device>(test_context().device());
  device->pipelines = store.get();
  vulkan::Culler culler = culler_on(*device, "clustered");
  device.reset();
  const MaskPass pass(culler.lookup(), frame);
  auto view = std::make_unique<View>(frame.view);
  vulkan::CullerFrame told = culler_frame(frame);
  told.view = view.get();
  Commands commands([&](VkCommandBuffer buffer) {
    static_cast<void>(take(culler.record(buffer, told)));
    pass.record(buffer, culler.lookup());
    MaskPass::record_to_host(buffer);
  });
  view.reset();
  store.reset();
  commands.submit();
  commands.wait();
  expect_no_miss(frame, pass.masks());
}

}  // namespace
}  // namespace lamp::app
