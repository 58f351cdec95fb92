// Makes a buffer, with memory of its own or from the host.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/buffer.h"

#include "null_handles.h"

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
    case MemoryUse::counts:
    case MemoryUse::records:
      return {HOST, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryUse::device:
      break;
  }
  return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
}

VkResult allocate_from(const Device& device, std::uint32_t type, VkDeviceSize bytes, VkBufferUsageFlags usage,
                       VkDeviceMemory& memory) {
  const VkMemoryAllocateFlagsInfo addressable{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                              .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
  const bool has_address = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
  const VkMemoryAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                      .pNext = has_address ? &addressable : nullptr,
                                      .allocationSize = bytes,
                                      .memoryTypeIndex = type};
  return device.vk.vkAllocateMemory(device.handle, &allocate, nullptr, &memory);
}

Error failed(const BufferInfo& info, VkResult result) {
  return {"buffer " + info.name, std::to_string(info.bytes) + " bytes: " + result_text(result)};
}

}  // namespace

Result<Allocation> Buffer::allocate(const Device& device, const BufferInfo& info) {
  VkMemoryRequirements needs{};
  device.vk.vkGetBufferMemoryRequirements(device.handle, buffer_.get(), &needs);
  Allocation made;
  if (const MemoryCallbacks& host = device.memory_callbacks; host.allocate != nullptr) {
    if (const VkResult r = host.allocate(host.user, buffer_.get(), needs, info.memory, made); r != VK_SUCCESS)
      return failed(info, r);
    host_memory_ = {new Allocation(made), [host](const Allocation* allocation) {
                      host.release(host.user, *allocation);
                      delete allocation;
                    }};
    if (made.memory == VK_NULL_HANDLE)
      return Error{"buffer " + info.name, "expected memory from MemoryCallbacks::allocate, got null"};
    if (info.memory == MemoryUse::device || made.mapped != nullptr) return made;
    return Error{"buffer " + info.name, "expected mapped memory from MemoryCallbacks::allocate, got none"};
  }
  const MemoryFlags flags = flags_of(info.memory);
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  // What is preferred may be used up: of the device's memory that can be mapped there is often little.
  for (const VkMemoryPropertyFlags preferred : {flags.preferred, VkMemoryPropertyFlags{0}}) {
    const Result<std::uint32_t> type = find_memory_type(device, needs.memoryTypeBits, flags.wanted, preferred);
    if (!type) return type.error();
    result = allocate_from(device, type.value(), needs.size, info.usage, made.memory);
    if (result == VK_SUCCESS || preferred == 0) break;
  }
  if (result != VK_SUCCESS) return failed(info, result);
  memory_ = OwnedMemory(device.handle, made.memory, device.vk.vkFreeMemory);
  if (info.memory == MemoryUse::device) return made;
  if (const VkResult r = device.vk.vkMapMemory(device.handle, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped);
      r != VK_SUCCESS)
    return failed(info, r);
  return made;
}

Result<Buffer> Buffer::create(const Device& device, const BufferInfo& info) {
  if (auto error = check_made(device)) return *error;
  if (info.bytes == 0) return Error{"buffer " + info.name, "expected at least 1 byte, got 0"};
  Buffer buffer;
  buffer.bytes_ = info.bytes;
  const VkBufferCreateInfo create{
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = info.bytes, .usage = info.usage};
  VkBuffer handle = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreateBuffer(device.handle, &create, nullptr, &handle); r != VK_SUCCESS)
    return failed(info, r);
  buffer.buffer_ = OwnedBuffer(device.handle, handle, device.vk.vkDestroyBuffer);
  device.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), info.name);

  const Result<Allocation> memory = buffer.allocate(device, info);
  if (!memory) return memory.error();
  if (const VkResult r =
          device.vk.vkBindBufferMemory(device.handle, handle, memory.value().memory, memory.value().offset);
      r != VK_SUCCESS)
    return failed(info, r);
  if (info.memory != MemoryUse::device) buffer.mapped_ = static_cast<std::byte*>(memory.value().mapped);
  return buffer;
}

}  // namespace lamp::vulkan
