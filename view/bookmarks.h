// A file of states by name: what a lecturer opens one after the other.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "commands/view_state.h"

namespace lamp::app {

struct Bookmark {
  std::string name;
  ViewState state;
};

/// Whether a JSON file has bookmarks, and not one state. False for what cannot be read.
[[nodiscard]] bool holds_bookmarks(const std::filesystem::path& file);
/// Throws Error: the file, the element, what was expected.
[[nodiscard]] std::vector<Bookmark> load_bookmarks(const std::filesystem::path& file);
void save_bookmarks(const std::filesystem::path& file, std::span<const Bookmark> bookmarks);

}  // namespace lamp::app
