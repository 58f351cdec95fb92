// Meshes around what lights light (shared/light_mesh.h), from their shadow maps: a work group a light. Blocks of texels
// say how far points may be lit (radial_reach.glsl), which limits inverse depth, 1 / w, from above on a lattice. Points
// of the mesh begin at the least limit around them, then each in turn comes as near to the light as its triangles'
// lattice points let it: coordinate ascent of a linear program.
// Promise: no lattice point's limit is exceeded, and a triangle is linear in inverse depth, so each cell between four
// lattice points lies inside the mesh as far as anything in it is lit. docs/methods/light-proxies.md has the reasoning.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#include "common/light_mesh.glsl"
#include "lamplight/shared/radial.h"
#include "shadow/parts/radial_reach.glsl"

layout(local_size_x = 256) in;

layout(set = 0, binding = 3, scalar) readonly buffer JobBuffer { RadialJob jobs[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer MeshBuffer { LightMesh meshes[]; };
layout(push_constant) uniform Push { uint job_count; };

layout(constant_id = 1) const uint STEPS = 4;  // of the lattice, a quad: 6 where there are 24 KiB of shared memory
const uint CUBE_LATTICE = MESH_CUBE_QUADS * STEPS;
const uint SPOT_LATTICE = MESH_SPOT_QUADS * STEPS;
const uint MOST_LATTICE = 6u * CUBE_LATTICE * CUBE_LATTICE + 2u;  // a cube's points; a spot's are fewer
const uint BLOCKS = 64u;              // a side of a square, at most: finer than the lattice
const uint OCTAHEDRON_BLOCKS = 128u;  // which holds all directions
const float ROUNDING = 1e-4;
const float FREE = 1e4;   // over the range: the inverse depth that nothing limits
const uint COLOURS = 8u;  // of points, so that no two of one colour share a triangle
const uint SWEEPS = 4u;   // the last ones go all the way: what comes first would take all room
shared uint s_limits[MOST_LATTICE];  // bits of floats >= 0, which ascend as they do
shared float s_inverse[MESH_POINTS];
shared uint s_room[MESH_POINTS];
shared uint s_order[MESH_POINTS];  // points, colour by colour
shared uint s_first[COLOURS + 1u];

uint g_kind;
uint g_lattice;  // steps along a face's side
float g_half_width;
float g_range_m;

#include "shadow/parts/mesh_limits.glsl"
#include "shadow/parts/mesh_fit.glsl"

// Of the square that shows a spot, widened by the spread; 0: as good as half a sphere.
float spot_half_width(uint light) {
  const float edge = 0.5 * float(shadow_maps[light].side) / shadow_maps[light].scale;
  const float spread = 1.001 * MESH_SPREAD;
  return edge * spread < 0.2 ? (edge + spread) / (1.0 - edge * spread) : 0.0;
}

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= job_count) return;
  const uint thread = gl_LocalInvocationIndex;
  const uint light = jobs[number].light;
  const uint kind = shadow_maps[light].kind;
  g_kind = kind == SHADOW_SPOT ? MESH_SPOT : MESH_CUBE;
  g_lattice = g_kind == MESH_CUBE ? CUBE_LATTICE : SPOT_LATTICE;
  g_half_width = g_kind == MESH_CUBE ? 1.0 : spot_half_width(light);
  g_range_m = shadow_maps[light].range_m * (1.0 + ROUNDING);
  const bool known = jobs[number].shows_all != 0u && kind != SHADOW_NONE && radial_is_bounded(light) && g_half_width > 0.0;
  if (thread == 0u) {
    meshes[light].position = shadow_maps[light].position;
    meshes[light].kind = known ? g_kind : MESH_NONE;
    meshes[light].axis_x = shadow_maps[light].axis_x;
    meshes[light].axis_z = shadow_maps[light].axis_z;
    meshes[light].half_width = g_half_width;
  }
  if (!known) return;
  for (uint i = thread; i < lattice_points(); i += gl_WorkGroupSize.x) s_limits[i] = floatBitsToUint(FREE / g_range_m);
  barrier();  // nothing is known before blocks say more
  const uint side = shadow_maps[light].side;
  const uint size = block_size(light, max(1u, side / (kind == SHADOW_OCTAHEDRON ? OCTAHEDRON_BLOCKS : BLOCKS)));
  const uint blocks = side / size;
  const uint squares = kind == SHADOW_FACES ? SQUARES_A_LIGHT : 1u;
  for (uint i = thread; i < squares * blocks * blocks; i += gl_WorkGroupSize.x) {
    const uint block = i % (blocks * blocks);
    limit_block(light, i / (blocks * blocks), uvec2(block % blocks, block / blocks) * size, size);
  }
  barrier();  // all blocks before the light's own shape
  for (uint i = thread; i < lattice_points(); i += gl_WorkGroupSize.x)
    s_limits[i] = max(s_limits[i], floatBitsToUint(limit_of_shape(i)));
  barrier();  // limits before points
  const uint in_grid_points = g_kind == MESH_CUBE ? MESH_POINTS : MESH_SPOT_FRONT;
  fit(in_grid_points);
  if (thread >= MESH_POINTS) return;
  const bool in_grid = thread < in_grid_points;
  const float far = in_grid ? length(mesh_way(g_kind, g_half_width, thread)) : 0.0;
  meshes[light].reach[thread / 4u][thread % 4u] = in_grid ? far * (1.0 + ROUNDING) / s_inverse[thread] : 0.0;
}
