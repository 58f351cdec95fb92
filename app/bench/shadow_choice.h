// Shadows as a user asks for them, on the command line or in a suite: words, which are read where shadows are made
// (`requested_shadows`).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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
};

/// What files call the words: suites, results, states of the window.
struct ShadowWord {
  const char* name;
  std::string ShadowChoice::* value;
};
inline constexpr std::array<ShadowWord, 6> SHADOW_WORDS{{{"shadows", &ShadowChoice::filter},
                                                         {"point_shadows", &ShadowChoice::points},
                                                         {"shadow_raster", &ShadowChoice::raster},
                                                         {"shadow_blur", &ShadowChoice::blur},
                                                         {"shadow_lights", &ShadowChoice::lights},
                                                         {"shadow_budget", &ShadowChoice::budget}}};

}  // namespace lamp::app
