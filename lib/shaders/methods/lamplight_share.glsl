// How many lights in view a work group of the pass that finds cells takes: as many as it has threads, or, of few lights,
// GROUP_FEW, because there the longest walk over cells is what the pass waits for; of very few so many less, down to a
// quarter, that there are FEW_GROUPS. GROUP_FEW is a constant of the plan, not a share of the subgroups: two passes
// count by it, and their subgroups may differ in size.
// Needs: GROUP_FEW.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_SHARE
#define LAMP_METHODS_LAMPLIGHT_SHARE

const uint FEW_LIGHTS = 32768u;
const uint FEW_GROUPS = 256u;

uint lights_of_group(uint seen) {
  if (seen > FEW_LIGHTS) return gl_WorkGroupSize.x;
  return clamp((seen + FEW_GROUPS - 1u) / FEW_GROUPS, max(1u, GROUP_FEW / 4u), GROUP_FEW);
}

// Never too few; for a part of the lights it may be more than for all, and then some have nothing to do.
uint groups_for(uint seen) {
  const uint share = lights_of_group(seen);
  return (seen + share - 1u) / share;
}

#endif
