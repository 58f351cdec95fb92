// LOOKUP_EACH for devices that end a thread's loops after some number of rounds: several steps of a walk a round, each
// with a light or none. A loop in a loop takes two rounds or three for each light.
// Needs: LOOKUP_STEPS; walk_left(walk), whether there are steps left; walk_step(walk, light), which gives the next light,
// or moves on.
// SPDX-License-Identifier: Apache-2.0
#define LOOKUP_EACH(light, pixel, z_view)                                              \
  for (Walk lookup_walk = walk_begin(pixel, z_view); walk_left(lookup_walk);)          \
    LAMP_UNROLL for (uint lookup_step = 0u; lookup_step < LOOKUP_STEPS; ++lookup_step) \
      if (walk_step(lookup_walk, light))
