// The clusters of one tile, by one work group: batches of lights against the tile's sides, then one thread a slice walks
// the survivors in order. Count and fill visit exactly the same pairs.
// Needs: RADIAL_BINDING; TILE_PX, SLICES, SLICE_SCALE, NEAR_MM, FAR_M; `frame`, `bounds`; the macros VISIT(light) and, after each 32
// lights, END_OF_WORD(word), used by the thread of a slice; and SURVIVORS(word, bits): lights 32 word + i that are between
// the tile's sides, by the thread that has them.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_CLUSTER_CULL
#define LAMP_METHODS_CLUSTER_CULL
#include "common/frame.glsl"
#include "common/slices.glsl"
#include "common/tile_volume.glsl"
#include "common/volume_tests.glsl"

layout(constant_id = 6) const uint FURTHER = 0;  // FURTHER_*
layout(set = 0, binding = RADIAL_BINDING + 1, scalar) readonly buffer RecordBuffer { Light records[]; };  // SHAPES
#define RECORD_OF(id) records[id]
#include "common/further_tests.glsl"

const uint BATCH = 256u;  // the largest work group
shared uint s_survivors[BATCH / 32u];
shared LightBounds s_bounds[BATCH];

// The view-space box around the part of a tile between two depths.
void cluster_box(uvec2 tile, float z_begin, float z_end, out vec3 box_min, out vec3 box_max) {
  z_begin = from_eye(frame, z_begin);
  box_min = vec3(3e38);
  box_max = vec3(-3e38);
  for (uint i = 0u; i < 8u; ++i) {
    const vec2 corner = vec2((tile + uvec2(i & 1u, i >> 1 & 1u)) * TILE_PX);
    const vec3 p = view_position(frame, corner, (i & 4u) == 0u ? z_begin : z_end);
    box_min = min(box_min, p);
    box_max = max(box_max, p);
  }
}

// The further tests of a cluster.
bool passes_in_cluster(uint light, LightBounds sphere, uvec2 tile, float z_begin, float z_end) {
  if (FURTHER == 0u) return true;
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  return passes_further_tests(frame, light, sphere, x_edges, y_edges, vec2(from_eye(frame, z_begin), z_end));
}

uint cluster_index(uvec2 tile, uint slice) {
  return tile.x + gl_NumWorkGroups.x * (tile.y + gl_NumWorkGroups.y * slice);
}

void visit_clusters(uvec2 tile) {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint slice = min(thread, SLICES - 1u);
  const float z_begin = slice_begin(slice);
  const float z_end = slice_end(slice);
  vec3 box_min;
  vec3 box_max;
  cluster_box(tile, z_begin, z_end, box_min, box_max);
  vec4 planes[4];
  side_planes(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), planes);

  for (uint first = 0u; first < light_count_of(frame); first += threads) {
    if (thread < threads / 32u) s_survivors[thread] = 0u;
    barrier();  // cleared bits before they are set
    if (first + thread < light_count_of(frame)) {
      const LightBounds sphere = bounds[first + thread];
      s_bounds[thread] = sphere;
      if (sphere_touches_sides(sphere, planes)) atomicOr(s_survivors[thread / 32u], 1u << (thread % 32u));
    }
    barrier();  // bits and bounds before the slices read them
    if (thread < threads / 32u) SURVIVORS(first / 32u + thread, s_survivors[thread]);
    if (thread < SLICES) {
      for (uint word = 0u; word < threads / 32u; ++word) {
        for (uint bits = s_survivors[word]; bits != 0u; bits &= bits - 1u) {
          const uint i = word * 32u + uint(findLSB(bits));
          if (sphere_touches_depths(s_bounds[i], z_begin, z_end) &&
              sphere_touches_box(s_bounds[i], box_min, box_max) &&
              passes_in_cluster(first + i, s_bounds[i], tile, z_begin, z_end))
            VISIT(first + i);
        }
        END_OF_WORD(first / 32u + word);
      }
    }
    barrier();  // slices done before the next batch overwrites
  }
}

#endif
