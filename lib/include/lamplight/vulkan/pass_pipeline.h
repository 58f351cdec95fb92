// The pipelines of a plan's passes, and what a shader that includes a look-up needs: known without a plan's buffers.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/plan.h"
#include "lamplight/vulkan/pipeline.h"

namespace lamp::vulkan {

/// SPIR-V by shader name; the library's embedded shaders by default (`embedded_shaders`).
using ShaderSource = std::function<Result<std::vector<std::uint32_t>>(std::string_view name)>;
[[nodiscard]] LAMPLIGHT_API Result<std::vector<std::uint32_t>> embedded_shaders(std::string_view name);

/// The pipeline of a pass; of a host pass, none.
[[nodiscard]] LAMPLIGHT_API Result<Pipeline> make_pipeline(const Device& device, const Pass& pass,
                                                           const ShaderSource& shaders = embedded_shaders);

/// The descriptor type of a plan's resource: everywhere, and in a pass of the plan.
[[nodiscard]] LAMPLIGHT_API VkDescriptorType descriptor_type(ResourceId id);
[[nodiscard]] LAMPLIGHT_API VkDescriptorType descriptor_type(ResourceId id, const Pass& pass);

/// The specialization constants and the bindings of a look-up, for the pipeline of a shader that includes it.
[[nodiscard]] LAMPLIGHT_API std::vector<Constant> lookup_constants(const LookUp& lookup);
[[nodiscard]] LAMPLIGHT_API std::vector<DescriptorBinding> lookup_bindings(const LookUp& lookup);

}  // namespace lamp::vulkan
