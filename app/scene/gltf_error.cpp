// How the glTF loader reports bad input: one line, "FILE: ELEMENT: what is wrong, what was expected".
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_error.h"

#include "error.h"

namespace lamp::app {

std::string one_line(std::string_view text) {
  constexpr std::size_t LONGEST = 300;
  std::string line;
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    const bool blank = code <= ' ' || code == 0x7F;
    if (!blank) {
      line += character;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
    if (line.size() >= LONGEST) {
      // Never end inside a UTF-8 sequence.
      while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0x80U) != 0) line.pop_back();
      return line + "...";
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

void gltf_fail(std::string_view file, std::string_view element, std::string_view problem) {
  std::string line = one_line(file) + ": ";
  if (!element.empty()) line += one_line(element) + ": ";
  throw Error(line + one_line(problem));
}

}  // namespace lamp::app
