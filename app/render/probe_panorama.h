// A capture as a picture of all directions, by the look-up that shading uses.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image/image.h"
#include "render/probe_atlas.h"

namespace lamp::app {

/// Twice as wide as high; the middle looks along -z, the right along +x, the top along +y.
[[nodiscard]] HdrImage probe_panorama(Context& context, const ShaderLibrary& shaders, const ProbeAtlas& atlas,
                                      const gpu::ProbePanorama& what);

}  // namespace lamp::app
