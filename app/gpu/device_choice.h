// Which device: the best that can run Lamplight, or the one that the user named.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "gpu/context.h"

namespace lamp::app {

inline constexpr std::uint32_t INSTANCE_VERSION = VK_API_VERSION_1_3;  ///< of every instance that the tool makes

[[nodiscard]] DeviceRow describe(const vulkan::Instance& instance, VkPhysicalDevice physical);

/// Throws Error (Exit::no_device) with the devices there are when none fits.
[[nodiscard]] VkPhysicalDevice choose_device(const vulkan::Instance& instance, std::string_view wanted);

[[nodiscard]] std::vector<VkPhysicalDevice> physical_devices(VkInstance instance);

}  // namespace lamp::app
