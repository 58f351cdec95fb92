// The further tests of a fragment's light, whose depths its proxy has narrowed already.
// Needs: as common/further_tests.glsl but RECORD_OF; `lights`, in_light.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_RASTER_FURTHER
#define LAMP_METHODS_RASTER_FURTHER
#define RECORD_OF(id) lights[id]
#include "common/further_tests.glsl"

bool passes_in_proxy(vec4 x_edges, vec4 y_edges, vec2 depths) {
  if (SHAPES) {
    const LightBounds sphere = light_bounds(frame, lights[in_light]);
    if (!box_reaches(frame, in_light, lights[in_light], sphere, x_edges, y_edges, depths)) return false;
  }
  return !RADIAL || radial_reaches(frame, in_light, x_edges, y_edges, depths);
}

#endif
