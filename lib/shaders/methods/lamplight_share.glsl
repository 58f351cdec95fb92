// How many lights in view a work group of the pass that finds cells takes: as many as it has threads, or, of few lights,
// four a subgroup, because there the longest walk over cells is what the pass waits for.
// Needs: gl_SubgroupSize.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_SHARE
#define LAMP_METHODS_LAMPLIGHT_SHARE

const uint FEW_LIGHTS = 32768u;
const uint FEW_OF_SUBGROUP = 4u;

uint lights_of_group(uint seen) {
  const uint few = gl_WorkGroupSize.x / gl_SubgroupSize * min(FEW_OF_SUBGROUP, gl_SubgroupSize);
  return seen > FEW_LIGHTS ? gl_WorkGroupSize.x : few;
}

// Enough for any part of that many lights too.
uint groups_for(uint seen) {
  const uint share = lights_of_group(seen);
  return (seen + share - 1u) / share;
}

#endif
