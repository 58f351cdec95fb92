// FNV-1a over texts and files.
// SPDX-License-Identifier: Apache-2.0
#include "files/content_hash.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "files/read_file.h"

namespace lamp::app {
namespace {

constexpr std::uint64_t HASH_TIMES = 0x100000001B3ULL;
constexpr std::uint64_t LARGEST = std::uint64_t{1} << 32;  // bytes; no reader takes more

}  // namespace

std::uint64_t hash_of(std::string_view text, std::uint64_t before) {
  std::uint64_t hash = before;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * HASH_TIMES;
  return hash;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string hash_of_files(std::span<const std::filesystem::path> files) {
  if (files.empty()) return {};
  std::uint64_t hash = HASH_FIRST;
  for (const std::filesystem::path& file : files) {
    const std::vector<std::byte> bytes =
        within_memory(file.string(), [&] { return read_file(file, {.most_bytes = LARGEST}); });
    hash = hash_of(text_of(bytes), hash);
    hash = hash_of(fmt::format("/{}/", bytes.size()), hash);  // where one ends and the next begins
  }
  return hash_text(hash);
}

}  // namespace lamp::app
