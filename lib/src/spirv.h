// A walk through the instructions of a SPIR-V module. Source: SPIR-V specification, 2.3.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lamp {

constexpr std::size_t SPIRV_HEADER_WORDS = 5;
constexpr std::size_t SPIRV_BOUND = 3;  ///< the word of the header that all ids are below

/// Calls visit(op, words) for each instruction, its first word among them, until one gives false or the module ends.
/// An instruction of no words, or of more than are left, ends it, too.
template <typename Visit>
void each_instruction(std::span<const std::uint32_t> spirv, const Visit& visit) {
  for (std::size_t at = SPIRV_HEADER_WORDS; at < spirv.size();) {
    const std::size_t words = spirv[at] >> 16U;
    if (words == 0 || words > spirv.size() - at) return;
    if (!visit(spirv[at] & 0xffffU, spirv.subspan(at, words))) return;
    at += words;
  }
}

}  // namespace lamp
