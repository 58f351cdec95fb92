// How the glTF loader reports bad input: one line, "FILE: ELEMENT: what is wrong, what was expected".
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace lamp::app {

/// Throws Error. `element` names the part of the file ("accessor 3"); empty: the file as a whole.
[[noreturn]] void gltf_fail(std::string_view file, std::string_view element, std::string_view problem);

}  // namespace lamp::app
