// Finds an embedded shader by name.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shader_code.h"

#include <algorithm>

namespace lamp {

const ShaderCode* find_shader(std::span<const ShaderCode> table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &ShaderCode::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace lamp
