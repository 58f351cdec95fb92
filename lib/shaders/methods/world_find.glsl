// Lights look for the bricks that they reach. A work group works out the boxes of bricks of its lights, a thread a light, and
// lists the bricks of all boxes; then its threads share the list out, and none waits for a light with a large box.
// Needs: the two functions that are declared here.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint LIGHTS = 32;  // of a group at a time, no more than it has threads
layout(constant_id = 2) const float BRICK_RATIO = 1.0;
layout(constant_id = 3) const uint BUCKETS = 1;
layout(constant_id = 4) const uint LISTED = 1;  // bricks of the list, at most
layout(constant_id = 5) const uint TURNS = 1;   // of a group, with LIGHTS lights each
#include "common/world_spots.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };

void saw_level(uint level);                            // of each light,
void found_brick(uint light, uint code, uint bucket);  // and of each brick that one reaches; `light` counts from the group's first

shared vec4 s_spheres[LIGHTS];  // centre and radius, widened
shared vec4 s_boxes[LIGHTS];    // first brick; level
shared uint s_listed[LISTED];   // a light's place among the group's, and behind that a brick's offset in its box
shared uint s_listed_count;
const uint LIGHT_BITS = 8u;
const uint OFFSET_BITS = 3u;  // along each axis

bool meets_brick(uint light, uint own, uint level, vec3 brick) {
  if (level == WORLD_EVERYTHING) return true;
  const float side = brick_side(level);
  const vec3 low = brick * side;
  if (!sphere_touches_cube(s_spheres[own].xyz, s_spheres[own].w, low, side)) return false;
  const WorldSpot spot = world_spot(frame, lights[light]);
  return !spot.is_spot || spot_touches_cube(spot, low, side);
}

uint first_light_of_group() { return gl_WorkGroupID.x * TURNS * LIGHTS; }

// `before`: lights of the group in the turns before.
void test_brick(uint listed, uint before) {
  const uint own = listed & (1u << LIGHT_BITS) - 1u;
  const uvec3 offset = uvec3(listed) >> LIGHT_BITS + OFFSET_BITS * uvec3(0u, 1u, 2u) & (1u << OFFSET_BITS) - 1u;
  const vec3 brick = s_boxes[own].xyz + vec3(offset);
  const uint level = uint(s_boxes[own].w);
  if (meets_brick(first_light_of_group() + before + own, own, level, brick))
    found_brick(before + own, brick_code(brick), bucket_of(level, brick, BUCKETS));
}

// What finds no room in the list is tested at once.
void list_bricks(uint before, uint own) {
  const LightBricks b = bricks_of(frame, spheres[first_light_of_group() + before + own]);
  const uint bricks = b.size.x * b.size.y * b.size.z;
  if (bricks == 0u) return;
  saw_level(b.level);
  s_spheres[own] = vec4(b.center, b.radius);
  s_boxes[own] = vec4(b.first, float(b.level));
  uint at = atomicAdd(s_listed_count, bricks);
  for (uint z = 0u; z < b.size.z; ++z)
    for (uint y = 0u; y < b.size.y; ++y)
      for (uint x = 0u; x < b.size.x; ++x, ++at) {
        const uint listed = own | (x | (y | z << OFFSET_BITS) << OFFSET_BITS) << LIGHT_BITS;
        if (at < LISTED)
          s_listed[at] = listed;
        else
          test_brick(listed, before);
      }
}

// By all threads of the group together.
void find_bricks() {
  const uint thread = gl_LocalInvocationIndex;
  for (uint before = 0u; before < TURNS * LIGHTS; before += LIGHTS) {
    barrier();  // the list is read before the next one is begun
    if (thread == 0u) s_listed_count = 0u;
    barrier();  // an empty list before lights are listed
    if (thread < LIGHTS && first_light_of_group() + before + thread < light_count_of(frame)) list_bricks(before, thread);
    barrier();  // the list before it is read
    for (uint i = thread; i < min(s_listed_count, LISTED); i += gl_WorkGroupSize.x) test_brick(s_listed[i], before);
  }
}
