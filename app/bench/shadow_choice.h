// Shadows as a user asks for them, on the command line or in a suite: words, which are read where shadows are made
// (`requested_shadows`).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace lamp::app {

struct ShadowChoice {
  std::string filter = "off";    ///< or one of shadow_names()
  std::string points = "faces";  ///< a point light's map: or octahedron
  std::string raster = "auto";   ///< what draws maps
  std::string blur = "fused";    ///< how vsm and evsm are blurred
  std::string lights = "all";    ///< how many of the first lights cast shadows
  std::string budget = "all";    ///< texels drawn in a frame
  std::uint32_t atlas = 4096;    ///< texels a side
  bool operator==(const ShadowChoice&) const = default;
};

}  // namespace lamp::app
