// A path from a text. All texts are UTF-8; what std::filesystem takes a std::string for depends on the system, so
// whatever a user may have typed goes through here.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lamp::app {

[[nodiscard]] inline std::filesystem::path utf8_path(std::string_view text) {
  return {std::u8string(text.begin(), text.end())};
}

}  // namespace lamp::app
