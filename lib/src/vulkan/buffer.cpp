// Makes a buffer with memory of its own.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/buffer.h"

namespace lamp::vulkan {
namespace {

struct MemoryFlags {
  VkMemoryPropertyFlags wanted, preferred;
};

MemoryFlags flags_of(MemoryUse use) {
  constexpr VkMemoryPropertyFlags HOST = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (use) {
    case MemoryUse::upload:
      return {HOST, 0};
    case MemoryUse::readback:
      return {HOST, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    case MemoryUse::device:
      break;
  }
  return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
}

}  // namespace

Result<Buffer> Buffer::create(const Device& device, const BufferInfo& info) {
  const auto failed = [&](VkResult result) {
    return Error{"buffer " + info.name, std::to_string(info.bytes) + " bytes: " + result_text(result)};
  };
  Buffer buffer;
  buffer.bytes_ = info.bytes;
  const VkBufferCreateInfo create{
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = info.bytes, .usage = info.usage};
  VkBuffer handle = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreateBuffer(device.handle, &create, nullptr, &handle); r != VK_SUCCESS)
    return failed(r);
  buffer.buffer_ = OwnedBuffer(device.handle, handle, device.vk.vkDestroyBuffer);
  device.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), info.name);

  VkMemoryRequirements needs{};
  device.vk.vkGetBufferMemoryRequirements(device.handle, handle, &needs);
  const MemoryFlags flags = flags_of(info.memory);
  const Result<std::uint32_t> type = find_memory_type(device, needs.memoryTypeBits, flags.wanted, flags.preferred);
  if (!type) return type.error();
  const VkMemoryAllocateInfo allocate{
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type.value()};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkAllocateMemory(device.handle, &allocate, nullptr, &memory); r != VK_SUCCESS)
    return failed(r);
  buffer.memory_ = OwnedMemory(device.handle, memory, device.vk.vkFreeMemory);
  if (const VkResult r = device.vk.vkBindBufferMemory(device.handle, handle, memory, 0); r != VK_SUCCESS)
    return failed(r);
  if (info.memory == MemoryUse::device) return buffer;
  void* mapped = nullptr;
  if (const VkResult r = device.vk.vkMapMemory(device.handle, memory, 0, VK_WHOLE_SIZE, 0, &mapped); r != VK_SUCCESS)
    return failed(r);
  buffer.mapped_ = static_cast<std::byte*>(mapped);
  return buffer;
}

}  // namespace lamp::vulkan
