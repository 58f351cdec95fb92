// Recording a frame takes nothing from the heap, not even the first time: for every method, with one view and with two.
// Commands go nowhere here, so that no driver's or layer's own memory counts.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdlib>
#include <new>

#include "gpu/engine_frame.h"

namespace {

thread_local bool counts = false;
thread_local std::uint64_t taken = 0;

void* take_memory(std::size_t bytes, std::size_t alignment) {
  if (counts) ++taken;
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  void* memory = alignment <= alignof(std::max_align_t) ? std::malloc(bytes) : std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// A program's own allocation stands in for the library's; the forms for arrays call these. Not inlined, since g++ then
// takes malloc's memory for another kind than its own.
[[gnu::noinline]] void* operator new(std::size_t bytes) { return take_memory(bytes, 1); }
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return take_memory(bytes, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace lamp::app {
namespace {

template <class... Arguments>
void silence(void (*&function)(Arguments...)) {
  function = [](Arguments...) {};
}

/// Whatever records or writes descriptors does nothing.
vulkan::Device silent_device() {
  vulkan::Device device = test_context().device();
  vulkan::DeviceFunctions& vk = device.vk;
  silence(vk.vkCmdBeginDebugUtilsLabelEXT);
  silence(vk.vkCmdEndDebugUtilsLabelEXT);
  silence(vk.vkCmdBindPipeline);
  silence(vk.vkCmdBindDescriptorSets);
  silence(vk.vkCmdPushDescriptorSetKHR);
  silence(vk.vkUpdateDescriptorSets);
  silence(vk.vkCmdPipelineBarrier2);
  silence(vk.vkCmdUpdateBuffer);
  silence(vk.vkCmdCopyBuffer);
  silence(vk.vkCmdFillBuffer);
  silence(vk.vkCmdDispatch);
  silence(vk.vkCmdDispatchIndirect);
  silence(vk.vkCmdBeginRendering);
  silence(vk.vkCmdEndRendering);
  silence(vk.vkCmdSetViewport);
  silence(vk.vkCmdSetScissor);
  silence(vk.vkCmdDraw);
  silence(vk.vkCmdDrawIndirect);
  return device;
}

std::uint64_t taken_by(vulkan::Culler& culler, const vulkan::CullerFrame& frame) {
  // Any handle but null will do: nothing that would read it is called.
  static std::byte nowhere;
  taken = 0;
  counts = true;
  const Result<std::uint64_t> recorded = culler.record(reinterpret_cast<VkCommandBuffer>(&nowhere), frame);
  counts = false;
  EXPECT_TRUE(recorded.ok()) << recorded.error().text();
  return taken;
}

class RecordHeap : public GpuTest {};

TEST_F(RecordHeap, NothingIsTakenFromIt) {
  const vulkan::Device device = silent_device();
  const EngineFrame frame = engine_frame();
  const vulkan::CullerFrame one = culler_frame(frame);
  const vulkan::CullerView view{.view = one.view, .depth_image = one.depth_image, .depth_view = one.depth_view};
  const vulkan::CullerView views[] = {view, view};
  vulkan::CullerFrame two = one;
  two.views = views;
  counts = true;
  const std::vector<shared::Light> copy = frame.lights;
  counts = false;
  EXPECT_EQ(copy.size(), frame.lights.size());
  EXPECT_EQ(taken, 1U) << "what the test counts with";
  for (const Method& method : methods())
    for (const std::uint32_t count : {1U, 2U}) {
      SCOPED_TRACE(std::string(method.name) + ", views: " + std::to_string(count));
      vulkan::Culler culler = take(vulkan::Culler::create(device, {.width = ENGINE_WIDTH,
                                                                   .height = ENGINE_HEIGHT,
                                                                   .views = count,
                                                                   .light_capacity = ENGINE_LIGHTS,
                                                                   .method = std::string(method.name)}));
      EXPECT_EQ(taken_by(culler, count == 1 ? one : two), 0U);
      EXPECT_EQ(taken_by(culler, count == 1 ? one : two), 0U);
    }
}

}  // namespace
}  // namespace lamp::app
