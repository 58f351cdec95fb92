// How the glTF loader reports bad input: one line, "FILE: ELEMENT: what is wrong, what was expected".
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_error.h"

#include <fmt/format.h>

#include "error.h"

namespace lamp::app {

void gltf_fail(std::string_view file, std::string_view element, std::string_view problem) {
  throw Error(fmt::format("{}: {}{}{}", file, element, element.empty() ? "" : ": ", problem));
}

}  // namespace lamp::app
