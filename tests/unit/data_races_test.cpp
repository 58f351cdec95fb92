// What invocations of a shader change with atomics none of them may read or write plainly: no barrier orders work
// groups, so that would be a data race. Looked for in the SPIR-V of every shader, of the library and of the tool.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lamplight/shader_code.h"
#include "render/shader_library.h"

namespace lamp {
namespace {

// The SPIR-V Specification, 3.49 (instructions) and 3.7 (storage classes).
enum Op : std::uint32_t {
  CONSTANT = 43,
  VARIABLE = 59,
  LOAD = 61,
  STORE = 62,
  ACCESS_CHAIN = 65,
  IN_BOUNDS_ACCESS_CHAIN = 66,
  FIRST_ATOMIC = 227,
  ATOMIC_STORE = 228,
  LAST_ATOMIC = 242
};
constexpr std::uint32_t STORAGE_BUFFER = 12;
constexpr std::uint32_t HEADER_WORDS = 5;
constexpr std::uint32_t ANY = ~0U;

/// A part of a storage buffer: the variable, then members and elements; ANY element where the index is computed.
using Path = std::vector<std::uint32_t>;

bool overlap(const Path& a, const Path& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (a[i] != b[i] && a[i] != ANY && b[i] != ANY) return false;
  return true;
}

/// Who touches storage buffers, and how.
class Accesses {
 public:
  explicit Accesses(std::span<const std::uint32_t> spirv) {
    for (std::size_t at = HEADER_WORDS; at < spirv.size();) {
      const std::uint32_t words = spirv[at] >> 16U;
      read(spirv[at] & 0xffffU, spirv.subspan(at + 1, words - 1));
      at += words;
    }
  }

  [[nodiscard]] bool has_atomics() const { return !atomic_.empty(); }
  [[nodiscard]] bool race() const {
    return std::ranges::any_of(plain_, [&](const Path& plain) {
      return std::ranges::any_of(atomic_, [&](const Path& atomic) { return overlap(plain, atomic); });
    });
  }

 private:
  void read(std::uint32_t op, std::span<const std::uint32_t> operands) {
    if (op == CONSTANT) constants_[operands[1]] = operands[2];
    if (op == VARIABLE && operands[2] == STORAGE_BUFFER) paths_[operands[1]] = {operands[1]};
    if (op == ACCESS_CHAIN || op == IN_BOUNDS_ACCESS_CHAIN) add_chain(operands);
    if (op == LOAD) add(plain_, operands[2]);
    if (op == STORE) add(plain_, operands[0]);
    if (op >= FIRST_ATOMIC && op <= LAST_ATOMIC) add(atomic_, operands[op == ATOMIC_STORE ? 0 : 2]);
  }

  void add_chain(std::span<const std::uint32_t> operands) {
    const auto base = paths_.find(operands[2]);
    if (base == paths_.end()) return;
    Path path = base->second;
    for (const std::uint32_t index : operands.subspan(3)) {
      const auto constant = constants_.find(index);
      path.push_back(constant == constants_.end() ? ANY : constant->second);
    }
    paths_[operands[1]] = path;
  }

  void add(std::vector<Path>& to, std::uint32_t pointer) const {
    const auto path = paths_.find(pointer);
    if (path != paths_.end()) to.push_back(path->second);
  }

  std::map<std::uint32_t, std::uint32_t> constants_;
  std::map<std::uint32_t, Path> paths_;  ///< of pointers into storage buffers
  std::vector<Path> plain_, atomic_;
};

TEST(DataRaces, NoShaderTouchesPlainlyWhatItChangesWithAtomics) {
  std::size_t with_atomics = 0;
  for (const std::span<const ShaderCode> table : {library_shaders(), render_shaders()})
    for (const ShaderCode& code : table) {
      const Accesses accesses(code.spirv);
      with_atomics += accesses.has_atomics() ? 1 : 0;
      EXPECT_FALSE(accesses.race()) << code.name;
    }
  EXPECT_GT(with_atomics, 20U);
}

}  // namespace
}  // namespace lamp
