// Letters of names that people type, whatever their case.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lamp::app {

/// Of ASCII's letters; anything else as it is.
[[nodiscard]] constexpr char small_letter(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

}  // namespace lamp::app
