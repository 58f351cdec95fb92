// How many lights in view a work group of the pass that finds cells takes: as many as it has threads, or, of few lights,
// GROUP_FEW, because there the longest walk over cells is what the pass waits for. A constant of the plan, not a share of
// the subgroups: two passes count by it, and their subgroups may differ in size.
// Needs: GROUP_FEW.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_SHARE
#define LAMP_METHODS_LAMPLIGHT_SHARE

const uint FEW_LIGHTS = 32768u;

uint lights_of_group(uint seen) { return seen > FEW_LIGHTS ? gl_WorkGroupSize.x : GROUP_FEW; }

// Enough for any part of that many lights too.
uint groups_for(uint seen) {
  const uint share = lights_of_group(seen);
  return (seen + share - 1u) / share;
}

#endif
