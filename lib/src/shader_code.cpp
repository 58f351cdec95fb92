// Finds an embedded shader by name, and what it asks of a device. Source: SPIR-V specification, 2.3 and 3.31.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shader_code.h"

#include <algorithm>

namespace lamp {

const ShaderCode* find_shader(std::span<const ShaderCode> table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &ShaderCode::name);
  return found == table.end() ? nullptr : &*found;
}

SubgroupOperations subgroup_operations(std::span<const std::uint32_t> spirv) {
  constexpr std::size_t HEADER_WORDS = 5;
  constexpr std::uint32_t OP_CAPABILITY = 2U << 16 | 17U;  // capabilities come first, two words each
  enum : std::uint32_t { VOTE = 62, ARITHMETIC = 63, BALLOT = 64, SHUFFLE = 65, SHUFFLE_RELATIVE = 66 };
  SubgroupOperations operations;
  for (std::size_t at = HEADER_WORDS; at + 1 < spirv.size() && spirv[at] == OP_CAPABILITY; at += 2) {
    const std::uint32_t capability = spirv[at + 1];
    operations.vote = operations.vote || capability == VOTE;
    operations.ballot = operations.ballot || capability == BALLOT;
    operations.arithmetic = operations.arithmetic || capability == ARITHMETIC;
    operations.shuffle = operations.shuffle || capability == SHUFFLE;
    operations.shuffle_relative = operations.shuffle_relative || capability == SHUFFLE_RELATIVE;
  }
  return operations;
}

}  // namespace lamp
