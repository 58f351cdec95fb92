// Lights look for the bricks that they reach: a few threads for each light, which share its box of bricks out.
// Needs: FOUND(light, i, code, bucket), run for each brick that the light reaches, the i-th of its box; MISSED(light, i),
// run for the others; SAW(level), run once for each light.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint LIGHT_THREADS = 8;
layout(constant_id = 2) const float BRICK_RATIO = 1.0;
layout(constant_id = 3) const uint BUCKETS = 1;
#include "common/world_spots.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };

// Of so few bricks floats give the quotients of whole numbers: no half of a brick lies near the next.
uvec3 brick_offset(uint i, uvec3 size) {
  const uint layer = size.x * size.y;
  const uint z = uint((float(i) + 0.5) * (1.0 / float(layer)));
  const uint of_layer = i - z * layer;
  const uint y = uint((float(of_layer) + 0.5) * (1.0 / float(size.x)));
  return uvec3(of_layer - y * size.x, y, z);
}

uint bricks_in(LightBricks b) { return b.size.x * b.size.y * b.size.z; }

bool meets_brick(LightBricks b, WorldSpot spot, vec3 brick) {
  if (b.level == WORLD_EVERYTHING) return true;
  const float side = brick_side(b.level);
  const vec3 low = brick * side;
  return sphere_touches_cube(b.center, b.radius, low, side) && (!spot.is_spot || spot_touches_cube(spot, low, side));
}

void find_bricks(uint light, uint first) {
  const LightBricks b = bricks_of(frame, spheres[light]);
  const uint bricks = bricks_in(b);
  if (first == 0u && bricks != 0u) SAW(b.level);
  const WorldSpot spot = world_spot(frame, lights[light]);
  for (uint i = first; i < bricks; i += LIGHT_THREADS) {
    const vec3 brick = b.first + vec3(brick_offset(i, b.size));
    if (meets_brick(b, spot, brick))
      FOUND(light, i, brick_code(brick), bucket_of(b.level, brick, BUCKETS));
    else
      MISSED(light, i);
  }
}

// Each thread has its share of a light's bricks.
uint light_of_thread() { return gl_GlobalInvocationID.x / LIGHT_THREADS; }
uint first_of_thread() { return gl_GlobalInvocationID.x % LIGHT_THREADS; }
