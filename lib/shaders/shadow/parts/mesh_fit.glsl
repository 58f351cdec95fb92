// Points of a light's mesh, each as near to the light as the limits around it and its neighbours let it.
// Needs: COLOURS, SWEEPS; `s_inverse`; shadow/parts/mesh_limits.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_MESH_FIT
#define LAMP_SHADOW_MESH_FIT

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

#endif
