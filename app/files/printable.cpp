// Escapes and shortens text.
// SPDX-License-Identifier: Apache-2.0
#include "files/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace lamp::app {
namespace {

constexpr std::size_t LONGEST = 600;  // bytes of a message
constexpr std::size_t KEPT_END = 200;

std::uint32_t byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

bool continues(std::string_view text, std::size_t i) { return (byte_at(text, i) & 0xC0U) == 0x80U; }

/// Bytes of the character that `text` begins with; 0 if it is a control character or no UTF-8.
std::size_t shown_bytes(std::string_view text) {
  const std::uint32_t first = byte_at(text, 0);
  if (first < 0x80U) return first < 0x20U || first == 0x7FU ? 0 : 1;
  const std::size_t bytes = first >= 0xF5U ? 0 : first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : first >= 0xC2U ? 2 : 0;
  for (std::size_t i = 1; i < bytes; ++i)
    if (!continues(text, i)) return 0;
  const bool control = first == 0xC2U && byte_at(text, 1) < 0xA0U;  // the second set, U+0080 .. U+009F
  return control ? 0 : bytes;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    if (bytes != 0)
      line += text.substr(0, bytes);
    else if (text.front() == '\n')
      line += "\\n";
    else
      line += fmt::format("\\x{:02x}", byte_at(text, 0));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return line;
}

std::string one_line(std::string_view text) {
  std::string line = printable(text);
  if (line.size() <= LONGEST) return line;
  std::size_t begin = LONGEST - KEPT_END;
  std::size_t end = line.size() - KEPT_END;
  while (continues(line, begin)) --begin;  // never within a character
  while (continues(line, end)) ++end;
  return line.replace(begin, end - begin, " ... ");
}

}  // namespace lamp::app
