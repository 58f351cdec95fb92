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

uint g_kind;
uint g_lattice;  // steps along a face's side
float g_half_width;
float g_range_m;

uint lattice_point(uint face, uvec2 at) {
  if (g_kind == MESH_CUBE) return cube_point(cube_face_place(face, at, CUBE_LATTICE), CUBE_LATTICE);
  return at.x + (SPOT_LATTICE + 1u) * at.y;
}

uint lattice_points() {
  return g_kind == MESH_CUBE ? cube_points(CUBE_LATTICE) : (SPOT_LATTICE + 1u) * (SPOT_LATTICE + 1u);
}

// All points of a box over depths of 1 up to a depth are lit, as far as one face can see them: limits of all lattice
// points around cells that their directions touch. Corners of the box are in the face's axes.
void limit_face(uint face, vec3 low, vec3 high, float farthest) {
  const vec2 least = max(max(low.xy, -high.xy), 0.0) / g_half_width;  // aside
  const float nearest = max(max(least.x, least.y), low.z);
  if (high.z <= 0.0 || nearest > high.z * (1.0 + ROUNDING)) return;
  vec2 first = vec2(-g_half_width);
  vec2 last = vec2(g_half_width);
  if (nearest > 0.0) {
    first = min(low.xy / nearest, low.xy / high.z);
    last = max(high.xy / nearest, high.xy / high.z);
  }
  const float per_width = 0.5 * float(g_lattice);
  const float end = float(g_lattice) - 0.5;
  const uvec2 from = uvec2(clamp((first / g_half_width + 1.0) * per_width - ROUNDING, 0.0, end));
  const uvec2 to = uvec2(clamp((last / g_half_width + 1.0) * per_width + ROUNDING, 0.0, end)) + 1u;
  const uint limit = farthest < RADIAL_UNBOUNDED ? floatBitsToUint(1.0 / (farthest * high.z)) : 0u;
  for (uint y = from.y; y <= to.y; ++y)
    for (uint x = from.x; x <= to.x; ++x) atomicMin(s_limits[lattice_point(face, uvec2(x, y))], limit);
}

void limit_block(uint light, uint square, uvec2 first, uint size) {
  const RadialBox box = radial_box(light, square, vec2(first), float(size));
  const float w = radial_farthest_lit(light, radial_farthest_of_block(light, square, first, size));
  const float spread = 1.001 * MESH_SPREAD * length(max(abs(box.low), abs(box.high)));
  const vec3 low = box.low - spread;
  const vec3 high = box.high + spread;
  if (g_kind == MESH_SPOT) limit_face(0u, low, high, w);
  for (uint face = 0u; g_kind == MESH_CUBE && face < 6u; ++face) {
    const vec3 a = cube_face_axes(face, low);
    const vec3 b = cube_face_axes(face, high);
    limit_face(face, min(a, b), max(a, b), w);
  }
}

// The least inverse depth at which the light's range ends in the cells around a lattice point; where a spot's circle
// touches none of them, nothing limits it.
float limit_of_shape(uint point) {
  if (g_kind == MESH_CUBE) {
    const float step = 2.0 / float(CUBE_LATTICE);
    const vec3 aside = max(abs(vec3(cube_place(point, CUBE_LATTICE)) * step - 1.0) - step, 0.0);
    return sqrt(1.0 + dot(aside, aside) - (1.0 - step) * (1.0 - step)) / g_range_m;
  }
  const float step = 2.0 * g_half_width / float(SPOT_LATTICE);
  const vec2 at = vec2(point % (SPOT_LATTICE + 1u), point / (SPOT_LATTICE + 1u));
  const vec2 aside = max(abs(at * step - g_half_width) - step, 0.0);
  if (length(aside) > g_half_width * (1.0 + ROUNDING)) return FREE / g_range_m;
  return sqrt(1.0 + dot(aside, aside)) / g_range_m;
}

// What the lattice points of a quad leave a corner of it, given the other corners. At first: what they all have at least.
float room_in_quad(uint face, uvec2 quad, uvec2 corner, bool first) {
  vec4 others;
  vec4 own;
  for (uint i = 0u; i < 4u; ++i) {
    own[i] = MESH_QUAD[i] == corner ? 1.0 : 0.0;
    others[i] = own[i] != 0.0 || first ? 0.0 : s_inverse[mesh_point(g_kind, face, quad + MESH_QUAD[i])];
  }
  float room = FREE / g_range_m;
  for (uint i = 0u; i < (STEPS + 1u) * (STEPS + 1u); ++i) {
    const uvec2 at = uvec2(i % (STEPS + 1u), i / (STEPS + 1u));
    const vec4 shares = mesh_shares(vec2(at) / float(STEPS));
    const float share = dot(shares, own);
    if (share <= 0.0) continue;
    const float limit = uintBitsToFloat(s_limits[lattice_point(face, quad * STEPS + at)]);
    room = min(room, first ? limit : (limit - dot(shares, others)) / share);
  }
  return room;
}

// Of a point of the grid, in all quads around it on all faces that hold it.
float room_of(uint point, bool first) {
  const uint n = mesh_quads(g_kind);
  const uint faces = g_kind == MESH_CUBE ? 6u : 1u;
  float room = FREE / g_range_m;
  for (uint face = 0u; face < faces; ++face) {
    uvec2 at = uvec2(point % (n + 1u), point / (n + 1u));
    if (g_kind == MESH_CUBE) {
      const uvec3 turned = uvec3(cube_turned(face, vec3(cube_place(point, n))));
      if (turned.z != ((face & 1u) == 0u ? n : 0u)) continue;
      at = turned.xy;
    }
    for (uint i = 0u; i < 4u; ++i) {
      const uvec2 corner = MESH_QUAD[i];
      if (any(lessThan(at, corner)) || any(greaterThanEqual(at - corner, uvec2(n)))) continue;
      room = min(room, room_in_quad(face, at - corner, corner, first));
    }
  }
  return room;
}

uint colour_of(uint point) {
  const uint n = mesh_quads(g_kind);
  const uvec3 at = g_kind == MESH_CUBE ? cube_place(point, n) : uvec3(point % (n + 1u), point / (n + 1u), 0u);
  return (at.x & 1u) | (at.y & 1u) << 1u | (at.z & 1u) << 2u;
}

void fit(uint point, bool moves) {
  if (moves) s_inverse[point] = room_of(point, true);
  const uint colour = colour_of(point);
  for (uint i = 0u; i < SWEEPS * COLOURS; ++i) {
    barrier();  // neighbours of another colour before those of this one
    if (!moves || i % COLOURS != colour) continue;
    const float share = i / COLOURS + 1u == SWEEPS ? 1.0 : 0.5;
    s_inverse[point] += share * (room_of(point, false) - s_inverse[point]);
  }
}

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
  const uint blocks = min(side, kind == SHADOW_OCTAHEDRON ? OCTAHEDRON_BLOCKS : BLOCKS);
  const uint squares = kind == SHADOW_FACES ? SQUARES_A_LIGHT : 1u;
  for (uint i = thread; i < squares * blocks * blocks; i += gl_WorkGroupSize.x) {
    const uint block = i % (blocks * blocks);
    const uint size = side / blocks;
    limit_block(light, i / (blocks * blocks), uvec2(block % blocks, block / blocks) * size, size);
  }
  barrier();  // all blocks before the light's own shape
  for (uint i = thread; i < lattice_points(); i += gl_WorkGroupSize.x)
    s_limits[i] = max(s_limits[i], floatBitsToUint(limit_of_shape(i)));
  barrier();  // limits before points
  const bool in_grid = thread < (g_kind == MESH_CUBE ? MESH_POINTS : MESH_SPOT_FRONT);
  fit(min(thread, MESH_POINTS - 1u), in_grid);
  if (thread >= MESH_POINTS) return;
  const float far = in_grid ? length(mesh_way(g_kind, g_half_width, thread)) : 0.0;
  meshes[light].reach[thread / 4u][thread % 4u] = in_grid ? far * (1.0 + ROUNDING) / s_inverse[thread] : 0.0;
}
