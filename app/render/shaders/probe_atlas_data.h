// How captures of reflection probes lie in their atlas. A probe has a block of PROBE_BLOCK texels: an octahedral square
// for each level of roughness, each with a border of one texel that holds what lies across its edges.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_ATLAS_DATA_H
#define LAMP_PROBE_ATLAS_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST PROBE_FACES = 6u;
LAMP_CONST PROBE_SIDE = 128u;         // texels, of level 0 and of a face
LAMP_CONST PROBE_SOURCE_SIDE = 64u;   // texels, of what all further levels are filtered from
LAMP_CONST PROBE_LEVELS = 6u;         // of sides 128, 64, 32, 16, 16, 16
LAMP_CONST PROBE_BLOCK_WIDTH = 196u;  // texels
LAMP_CONST PROBE_BLOCK_HEIGHT = 130u;
LAMP_CONST PROBE_BORDER = 1u;

// Roughness of a level: PROBE_SHARP + level * PROBE_STEP. A lobe of the first is narrower than a texel of level 0.
LAMP_CONST_FLOAT PROBE_SHARP = 0.1f;
LAMP_CONST_FLOAT PROBE_STEP = 0.18f;

LAMP_CONST_FLOAT PROBE_SKY_M = 1e6f;          // distance of what is no surface
LAMP_CONST_FLOAT PROBE_BRIGHTEST = 65504.0f;  // the greatest half float; what is brighter is counted

// A texel of what levels are filtered from.
struct ProbeSource {
  vec3 direction;  // unit, of its centre
  float weight;    // its solid angle, up to a factor
  vec3 radiance;   // its mean
};

#ifdef __cplusplus
#define LAMP_CONSTANT constexpr
#else
#define LAMP_CONSTANT
#endif
LAMP_CONSTANT uint probe_level_side(uint level) { return PROBE_SIDE >> (level < 3u ? level : 3u); }
// Where a level's square lies in the block, without its border.
LAMP_CONSTANT uint probe_level_x(uint level) { return level == 0u ? 1u : level == 3u || level == 4u ? 165u : 131u; }
LAMP_CONSTANT uint probe_level_y(uint level) { return level < 2u ? 1u : level < 4u ? 67u : level == 4u ? 85u : 101u; }

// What a pass over a capture is told.
struct ProbePush {
  uint origin_x;  // texels, of the probe's block
  uint origin_y;
  uint level;  // that is filtered; of face passes the face
};

// A picture of all directions, twice as wide as high.
struct ProbePanorama {
  uint slot;
  uint height;  // pixels
  float roughness;
};

#ifdef __cplusplus
}  // namespace lamp::app::gpu
#endif

#endif
