// The shared memory that a compute shader declares: the sizes of its variables, of which specialization constants make
// lengths. Source: SPIR-V specification, 2.3, 3.7, 3.20, 3.49; the layout is std430's, in the order of the variables.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "lamplight/shader_code.h"
#include "spirv.h"

namespace lamp {
namespace {

enum Op : std::uint32_t {
  TYPE_BOOL = 20,
  TYPE_INT = 21,
  TYPE_FLOAT = 22,
  TYPE_VECTOR = 23,
  TYPE_MATRIX = 24,
  TYPE_ARRAY = 28,
  TYPE_STRUCT = 30,
  TYPE_POINTER = 32,
  CONSTANT_TRUE = 41,
  CONSTANT = 43,
  SPEC_CONSTANT_TRUE = 48,
  SPEC_CONSTANT = 50,
  SPEC_CONSTANT_OP = 52,
  FUNCTION = 54,
  VARIABLE = 59,
  DECORATE = 71,
  COMPOSITE_EXTRACT = 81
};
constexpr std::uint32_t WORKGROUP = 4;
constexpr std::uint32_t SPEC_ID = 1;

using Words = std::span<const std::uint32_t>;

struct Layout {
  std::uint64_t bytes = 0;
  std::uint64_t alignment = 4;

  void add(const Layout& member) {
    bytes = (bytes + member.alignment - 1) / member.alignment * member.alignment + member.bytes;
    alignment = std::max(alignment, member.alignment);
  }
};

struct Instruction {
  std::uint32_t op = 0;
  Words operands;  ///< without its type and its result
};

class Module {
 public:
  Module(Words spirv, Words constants) : constants_(constants) {
    if (spirv.size() < SPIRV_HEADER_WORDS) return;
    defined_.resize(spirv[SPIRV_BOUND]);
    each_instruction(spirv, [&](std::uint32_t op, Words words) {
      if (op != FUNCTION) read(op, words);
      return op != FUNCTION;
    });
  }

  [[nodiscard]] std::uint64_t shared_bytes() const { return is_known_ ? shared_.bytes : ~0ULL; }

 private:
  void read(std::uint32_t op, Words words) {
    const Words x = words.subspan(1);
    if (op == DECORATE && x[1] == SPEC_ID) spec_ids_.emplace_back(x[0], x[2]);
    if (op >= TYPE_BOOL && op <= TYPE_POINTER) defined_[x[0]] = {op, x.subspan(1)};
    if (op >= CONSTANT_TRUE && op <= SPEC_CONSTANT_OP) defined_[x[1]] = {op, x.subspan(2)};
    if (op == VARIABLE && x[2] == WORKGROUP) shared_.add(layout(defined_[x[0]].operands[1]));
  }

  Layout layout(std::uint32_t type) {
    const auto [op, x] = defined_[type];
    switch (op) {
      case TYPE_BOOL:
        return {4, 4};
      case TYPE_INT:
      case TYPE_FLOAT:
        return {x[0] / 8, x[0] / 8};
      case TYPE_VECTOR: {
        const Layout part = layout(x[0]);
        return {part.bytes * x[1], part.bytes * (x[1] == 3 ? 4 : x[1])};
      }
      case TYPE_MATRIX:
      case TYPE_ARRAY: {
        const Layout part = layout(x[0]);
        const std::uint64_t stride = (part.bytes + part.alignment - 1) / part.alignment * part.alignment;
        return {stride * (op == TYPE_ARRAY ? value(x[1]) : x[1]), part.alignment};
      }
      case TYPE_STRUCT: {
        Layout all;
        for (const std::uint32_t member : x) all.add(layout(member));
        return all;
      }
      default:
        is_known_ = false;
        return {};
    }
  }

  /// A length, or what it is computed from.
  std::uint32_t value(std::uint32_t id) {
    const auto [op, x] = defined_[id];
    const auto given = std::ranges::find(spec_ids_, id, &std::pair<std::uint32_t, std::uint32_t>::first);
    if (given != spec_ids_.end() && given->second < constants_.size()) return constants_[given->second];
    if (op == CONSTANT || op == SPEC_CONSTANT) return x[0];
    if (op < CONSTANT || (op >= SPEC_CONSTANT_TRUE && op < SPEC_CONSTANT))
      return op == CONSTANT_TRUE || op == SPEC_CONSTANT_TRUE ? 1 : 0;
    if (op != SPEC_CONSTANT_OP) return unknown();
    if (x[0] == COMPOSITE_EXTRACT) return value(defined_[x[1]].operands[x[2]]);  // of gl_WorkGroupSize
    std::array<std::uint32_t, 3> of{};
    for (std::size_t i = 0; i < std::min(of.size(), x.size() - 1); ++i) of[i] = value(x[i + 1]);
    return computed(x[0], of);
  }

  std::uint32_t computed(std::uint32_t op, const std::array<std::uint32_t, 3>& x) {
    switch (op) {
      case 128:
        return x[0] + x[1];  // OpIAdd
      case 130:
        return x[0] - x[1];  // OpISub
      case 132:
        return x[0] * x[1];  // OpIMul
      case 134:
        return x[1] == 0 ? 0 : x[0] / x[1];  // OpUDiv
      case 137:
        return x[1] == 0 ? 0 : x[0] % x[1];  // OpUMod
      case 168:
        return 1 - x[0];  // OpLogicalNot
      case 169:
        return x[0] != 0 ? x[1] : x[2];  // OpSelect
      case 170:
        return x[0] == x[1] ? 1 : 0;  // OpIEqual
      case 171:
        return x[0] != x[1] ? 1 : 0;  // OpINotEqual
      case 172:
        return x[0] > x[1] ? 1 : 0;  // OpUGreaterThan
      case 174:
        return x[0] >= x[1] ? 1 : 0;  // OpUGreaterThanEqual
      case 176:
        return x[0] < x[1] ? 1 : 0;  // OpULessThan
      case 178:
        return x[0] <= x[1] ? 1 : 0;  // OpULessThanEqual
      case 194:
        return x[1] > 31 ? 0 : x[0] >> x[1];  // OpShiftRightLogical
      case 196:
        return x[1] > 31 ? 0 : x[0] << x[1];  // OpShiftLeftLogical
      case 166:
      case 197:
        return x[0] | x[1];  // OpLogicalOr, OpBitwiseOr
      case 167:
      case 199:
        return x[0] & x[1];  // OpLogicalAnd, OpBitwiseAnd
      default:
        return unknown();
    }
  }

  std::uint32_t unknown() {
    is_known_ = false;
    return 0;
  }

  Words constants_;
  std::vector<Instruction> defined_;                               ///< types and constants, by id
  std::vector<std::pair<std::uint32_t, std::uint32_t>> spec_ids_;  ///< an id, and the number of its constant
  Layout shared_;
  bool is_known_ = true;
};

}  // namespace

std::uint64_t shared_bytes(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants) {
  return Module(spirv, constants).shared_bytes();
}

}  // namespace lamp
