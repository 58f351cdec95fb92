// Adds the option by its name: methods without cells of the picture have none.
// SPDX-License-Identifier: Apache-2.0
#include "render/box_shapes.h"

#include <algorithm>

namespace lamp::app {

std::vector<std::string> with_box_shapes(const Method& method, std::vector<std::string> settings, bool boxes) {
  const bool has_option = std::ranges::find(method.options, "boxes", &OptionSpec::key) != method.options.end();
  const bool is_set = std::ranges::any_of(settings, [](const std::string& s) { return s.starts_with("boxes="); });
  if (boxes && has_option && !is_set) settings.emplace_back("boxes=shape");
  return settings;
}

bool culls_shapes(const Options& options) {
  const auto found = options.all().find("boxes");
  return found != options.all().end() && found->second == "shape";
}

}  // namespace lamp::app
