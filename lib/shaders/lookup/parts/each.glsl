// LOOKUP_EACH(light, pixel, z_view) statement: runs the statement for each light of a pixel, by the look-up's own way of
// walking, or else by the plain one. `light` is a uint that the shader has declared. Include it behind the look-up.
// LOOKUP_EACH_IN(id, pixel, z_view, first, end) does so for the entities first .. end - 1 alone, which is how kinds of
// entities are told apart. A look-up that says LOOKUP_RANGED can skip to them: its walk_begin_in holds all of them, and
// others only where it cannot know.
// LOOKUP_FEW_IN is for kinds of which a pixel has few: each thread walks cells by itself. A fragment shader that walks in
// turns twice lost lights of its second walk on Mesa 22.3's lavapipe.
// SPDX-License-Identifier: Apache-2.0
#ifndef LOOKUP_EACH
#define LOOKUP_EACH(light, pixel, z_view) \
  for (Walk lookup_walk = walk_begin(pixel, z_view); walk_next(lookup_walk, light);)
#ifdef LOOKUP_RANGED
#define LOOKUP_EACH_RANGED(id, pixel, z_view, first, end) \
  for (Walk lookup_walk = walk_begin_in(pixel, z_view, first, end); walk_next(lookup_walk, id);)
#endif
#endif

#ifdef LOOKUP_EACH_RANGED
#define LOOKUP_EACH_IN(id, pixel, z_view, first, end) \
  LOOKUP_EACH_RANGED(id, pixel, z_view, first, end) if (id >= (first) && id < (end))
#else
#define LOOKUP_EACH_IN(id, pixel, z_view, first, end) \
  LOOKUP_EACH(id, pixel, z_view) if (id >= (first) && id < (end))
#endif

#ifdef LOOKUP_IN_TURNS
#define LOOKUP_FEW_IN(id, pixel, z_view, first, end)                                              \
  for (Walk lookup_walk = walk_begin_in(pixel, z_view, first, end); walk_next(lookup_walk, id);) \
    if (id >= (first) && id < (end))
#else
#define LOOKUP_FEW_IN(id, pixel, z_view, first, end) LOOKUP_EACH_IN(id, pixel, z_view, first, end)
#endif
