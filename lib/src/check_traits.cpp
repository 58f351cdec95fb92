// Holds traits against what Vulkan guarantees of every device.
// SPDX-License-Identifier: Apache-2.0
#include "check_traits.h"

#include <bit>
#include <string>
#include <utility>

namespace lamp {
namespace {

constexpr std::uint32_t LEAST_GROUP = 128;         // maxComputeWorkGroupInvocations
constexpr std::uint32_t MOST_SUB_PIXEL_BITS = 31;  // steps of a pixel that 32 bits can count; devices have 4 to 8

Error wrong(const char* trait, const std::string& expected, std::uint32_t got) {
  return {"device trait " + std::string(trait), "expected " + expected + ", got " + std::to_string(got)};
}

}  // namespace

std::optional<Error> check_traits(const DeviceTraits& traits) {
  for (const auto& [name, value] : {std::pair("storage_offset_alignment", traits.storage_offset_alignment),
                                    {"subgroup_size", traits.subgroup_size},
                                    {"max_subgroup_size", traits.max_subgroup_size}})
    if (!std::has_single_bit(value)) return wrong(name, "a power of two", value);
  if (traits.max_group_invocations < LEAST_GROUP)
    return wrong("max_group_invocations", "at least 128, which Vulkan guarantees", traits.max_group_invocations);
  if (traits.max_loop_rounds == 0) return wrong("max_loop_rounds", "at least 1", 0);
  if (traits.sub_pixel_bits > MOST_SUB_PIXEL_BITS) return wrong("sub_pixel_bits", "at most 31", traits.sub_pixel_bits);
  return std::nullopt;
}

}  // namespace lamp
