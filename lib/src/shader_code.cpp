// Finds an embedded shader by name, and what it asks of a device. Source: SPIR-V specification, 2.3 and 3.31.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shader_code.h"

#include <algorithm>

#include "spirv.h"

namespace lamp {

const ShaderCode* find_shader(std::span<const ShaderCode> table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &ShaderCode::name);
  return found == table.end() ? nullptr : &*found;
}

SubgroupOperations subgroup_operations(std::span<const std::uint32_t> spirv) {
  constexpr std::uint32_t OP_CAPABILITY = 17;  // all capabilities come first
  enum : std::uint32_t { VOTE = 62, ARITHMETIC = 63, BALLOT = 64, SHUFFLE = 65, SHUFFLE_RELATIVE = 66 };
  SubgroupOperations operations;
  each_instruction(spirv, [&](std::uint32_t op, std::span<const std::uint32_t> words) {
    if (op != OP_CAPABILITY || words.size() < 2) return false;
    operations.vote = operations.vote || words[1] == VOTE;
    operations.ballot = operations.ballot || words[1] == BALLOT;
    operations.arithmetic = operations.arithmetic || words[1] == ARITHMETIC;
    operations.shuffle = operations.shuffle || words[1] == SHUFFLE;
    operations.shuffle_relative = operations.shuffle_relative || words[1] == SHUFFLE_RELATIVE;
    return true;
  });
  return operations;
}

}  // namespace lamp
