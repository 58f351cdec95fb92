// The truth, one slice of lights a dispatch: how many surely reach each pixel, the hash of their indices, and of how many
// the pixel lies in the boundary band.
// A group keeps the lights whose spheres touch the box of its pixels' positions, and tests them for each pixel.
// Promise: no bounds, no cells, no code of any method; double precision throughout.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surely_reaches.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 5, scalar) buffer TruthBuffer { PixelTruth truth[]; };
layout(push_constant) uniform Push {
  uint first_row;  // rows to answer for
  uint rows;
  uint first_light;  // of the slice
  uint end_light;
};

const uint THREADS = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
const double FAR = 1e300lf;
shared dvec3 low[THREADS];
shared dvec3 high[THREADS];
shared uint kept[THREADS];
shared uint kept_count;

// Leaves the box of all positions in low[0], high[0].
void join_boxes() {
  for (uint half_count = THREADS / 2u; half_count > 0u; half_count /= 2u) {
    barrier();  // the boxes of the round before are written
    if (gl_LocalInvocationIndex < half_count) {
      low[gl_LocalInvocationIndex] = min(low[gl_LocalInvocationIndex], low[gl_LocalInvocationIndex + half_count]);
      high[gl_LocalInvocationIndex] = max(high[gl_LocalInvocationIndex], high[gl_LocalInvocationIndex + half_count]);
    }
  }
  barrier();  // low[0], high[0] are final
}

// A little more than the range and the boundary band behind it: the margin that makes rounding harmless.
bool touches_box(uint light) {
  const dvec3 center = dvec3(lights[light].position);
  const dvec3 gap = max(max(low[0] - center, center - high[0]), dvec3(0.0lf));
  const double range = double(lights[light].range) * 1.0001lf;
  return range > 0.0lf && (lights[light].range >= INFINITE_RADIUS || dot(gap, gap) <= range * range);
}

void main() {
  const uint index = gl_GlobalInvocationID.x + frame.size_px.x * gl_GlobalInvocationID.y;
  const uvec2 pixel = uvec2(gl_GlobalInvocationID.x, first_row + gl_GlobalInvocationID.y);
  const bool inside = pixel.x < frame.size_px.x && gl_GlobalInvocationID.y < rows;
  const float depth = inside ? texelFetch(depth_image, ivec2(pixel), 0).x : 0.0;
  const bool covered = inside && !is_sky(frame, depth);
  dvec3 position = dvec3(0.0lf);
  if (covered) position = exact_world_position(pixel, depth);
  low[gl_LocalInvocationIndex] = covered ? position : dvec3(FAR);
  high[gl_LocalInvocationIndex] = covered ? position : dvec3(-FAR);
  join_boxes();

  PixelTruth sum = PixelTruth(0u, 0u, uvec2(0u));
  const bool sky = low[0].x > high[0].x;
  for (uint base = first_light; base < (sky ? first_light : end_light); base += THREADS) {
    if (gl_LocalInvocationIndex == 0u) kept_count = 0u;
    barrier();  // the count is 0 before anybody adds
    const uint light = base + gl_LocalInvocationIndex;
    if (light < end_light && touches_box(light)) kept[atomicAdd(kept_count, 1u)] = light;
    barrier();  // all that are kept are there
    if (covered)
      for (uint i = 0u; i < kept_count; ++i) {
        const uint answer = reach(kept[i], position);
        if (answer == INSIDE) {
          ++sum.count;
          sum.hash += hash_of(kept[i]);
        } else if (answer == BOUNDARY) {
          ++sum.boundary;
        }
      }
    barrier();  // everybody has read them
  }
  if (!inside) return;
  if (first_light == 0u) {
    truth[index] = sum;
  } else {
    truth[index].count += sum.count;
    truth[index].boundary += sum.boundary;
    truth[index].hash += sum.hash;
  }
}
