// A file appears whole or not at all.
// Promise: after an Error the folder is as it was before the call, an older file of that name included.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace lamp::app {

/// Writes `bytes` under a temporary name in the folder of `file`, then renames. A link is followed. What exists and
/// is no regular file (a pipe, /dev/stdout) is written to directly. Throws Error: the file, what the system says, and
/// what was expected.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Where a link leads, through all links, whether anything is there or not; what is no link leads to itself. Throws
/// Error for links that lead in a circle.
[[nodiscard]] std::filesystem::path followed(std::filesystem::path file);

}  // namespace lamp::app
