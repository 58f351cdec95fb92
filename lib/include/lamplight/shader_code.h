// The compiled shaders: SPIR-V embedded in the binary, found by name.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "lamplight/export.h"
#include "lamplight/plan.h"

namespace lamp {

/// One compiled shader. A name is the path below the shader root without its extension, and "@look-up" or
/// "@multisampled" for a variant.
struct ShaderCode {
  std::string_view name;
  std::span<const std::uint32_t> spirv;
  std::string_view source;  ///< file it was built from, below the shader root, for live recompilation
  std::string_view lookup;  ///< look-up it was built with, or empty
  bool multisampled;        ///< reads a depth image of several samples (compiled with -DMULTISAMPLED)
};

/// The shaders of the library.
[[nodiscard]] LAMPLIGHT_API std::span<const ShaderCode> library_shaders();

/// The subgroup operations that a module declares. Clustered and quad operations, which the library's shaders leave
/// alone, are not among them.
[[nodiscard]] LAMPLIGHT_API SubgroupOperations subgroup_operations(std::span<const std::uint32_t> spirv);

/// Bytes of shared memory that a work group of a compute shader takes, with the specialization constants 0, 1, ...; ~0
/// where a length is computed by an operation that this function does not know.
[[nodiscard]] LAMPLIGHT_API std::uint64_t shared_bytes(std::span<const std::uint32_t> spirv,
                                                       std::span<const std::uint32_t> constants);

/// The shader of that name in a table, or nullptr.
[[nodiscard]] LAMPLIGHT_API const ShaderCode* find_shader(std::span<const ShaderCode> table, std::string_view name);

}  // namespace lamp
