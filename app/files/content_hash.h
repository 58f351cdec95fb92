// Hashes that tell whether a text or a file is still what it was.
// Based on: Fowler, Noll, Vo, FNV-1a, 64 bits. It guards against mistakes, not against forgery.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lamp::app {

inline constexpr std::uint64_t HASH_FIRST = 0xCBF29CE484222325ULL;

/// Goes on from the hash of what stands before.
[[nodiscard]] std::uint64_t hash_of(std::string_view text, std::uint64_t before = HASH_FIRST);

/// A hash as names and files have it: 16 hexadecimal digits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

/// Of what files hold, in this order; their names do not matter. Empty without files. Throws Error for one that cannot
/// be read.
[[nodiscard]] std::string hash_of_files(std::span<const std::filesystem::path> files);

}  // namespace lamp::app
