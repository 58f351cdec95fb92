// Boxes behind the lights, decals and then probes: their ids, and whether one holds a position.
// Promise: the same answer in every shader, whatever its look-up.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_BOX
#define LAMP_COMMON_BOX
#include "lamplight/shared/entity.h"
#include "lamplight/shared/frame.h"

// An id; those of boxes that there is no room for are never met.
uint first_box(Frame frame) { return frame.light_count - min(frame.box_count, frame.light_count); }
uint first_probe(Frame frame) { return frame.light_count - min(min(frame.probe_count, frame.box_count), frame.light_count); }

// Metres from the box's centre along its axes.
vec3 box_local(OrientedBox box, vec3 position) {
  precise const vec3 offset = position - box.center;
  precise const vec3 local = vec3(dot(offset, box.axis_x), dot(offset, box.axis_y), dot(offset, box.axis_z));
  return local;
}

bool box_holds(OrientedBox box, vec3 local) { return all(lessThan(abs(local), box.half_extents)); }

#endif
