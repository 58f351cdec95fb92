// Devices that plans are made for where no device is: from the least to the largest.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/plan.h"

namespace lamp::test {

/// The least that Vulkan 1.3 guarantees.
inline const DeviceTraits LEAST_DEVICE{.compute_subgroups = {}, .fragment_subgroups = {}};

/// Mesa's llvmpipe.
inline const DeviceTraits SOFTWARE_DEVICE{.max_group_invocations = 1024,
                                          .shared_memory_bytes = 32768,
                                          .max_image_size = 16384,
                                          .subgroup_size = 8,
                                          .max_subgroup_size = 8,
                                          .sub_pixel_bits = 8};

/// A large GPU: storage buffers of 4 GiB less a byte, as 32 bits can say.
inline const DeviceTraits LARGE_DEVICE{.max_storage_buffer_bytes = 0xffffffffU,
                                       .memory_bytes = 80ULL << 30,
                                       .max_groups = {0x7fffffffU, 65535, 65535},
                                       .max_group_invocations = 1024,
                                       .shared_memory_bytes = 49152,
                                       .max_image_size = 32768,
                                       .max_storage_buffers = 1024,
                                       .sub_pixel_bits = 8,
                                       .conservative_raster = true};

/// The same without subgroup operations.
inline const DeviceTraits LARGE_PLAIN_DEVICE = [] {
  DeviceTraits traits = LARGE_DEVICE;
  traits.compute_subgroups = traits.fragment_subgroups = {};
  return traits;
}();

}  // namespace lamp::test
