// Points of a light's mesh, each as near to the light as the limits around it and its neighbours let it. Points of one
// colour move at once, and the threads share out the lattice around them, a row at a time.
// Needs: COLOURS, SWEEPS; `s_inverse`, `s_room`, `s_order`, `s_first`; shadow/parts/mesh_limits.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_MESH_FIT
#define LAMP_SHADOW_MESH_FIT

// What a row of a quad's lattice points leaves a corner of the quad, given the others. At first: what they all have at
// least.
float room_in_row(uint face, uvec2 quad, uvec2 corner, uint row, bool first) {
  vec4 others;
  vec4 own;
  for (uint i = 0u; i < 4u; ++i) {
    own[i] = MESH_QUAD[i] == corner ? 1.0 : 0.0;
    others[i] = own[i] != 0.0 || first ? 0.0 : s_inverse[mesh_point(g_kind, face, quad + MESH_QUAD[i])];
  }
  float room = FREE / g_range_m;
  for (uint x = 0u; x <= STEPS; ++x) {
    const uvec2 at = uvec2(x, row);
    const vec4 shares = mesh_shares(vec2(at) / float(STEPS));
    const float share = dot(shares, own);
    if (share <= 0.0) continue;
    const float limit = uintBitsToFloat(s_limits[lattice_point(face, quad * STEPS + at)]);
    room = min(room, first ? limit : (limit - dot(shares, others)) / share);
  }
  return room;
}

uint rows_around_point() { return (g_kind == MESH_CUBE ? 6u : 1u) * 4u * (STEPS + 1u); }

// Of the rows of all quads around a point of the grid, on all faces that may hold it, every so many.
float room_of(uint point, bool first, uint part, uint parts) {
  const uint n = mesh_quads(g_kind);
  float room = FREE / g_range_m;
  for (uint i = part; i < rows_around_point(); i += parts) {
    const uint face = i / (4u * (STEPS + 1u));
    uvec2 at = uvec2(point % (n + 1u), point / (n + 1u));
    if (g_kind == MESH_CUBE) {
      const uvec3 turned = uvec3(cube_turned(face, vec3(cube_place(point, n))));
      if (turned.z != ((face & 1u) == 0u ? n : 0u)) continue;
      at = turned.xy;
    }
    const uvec2 corner = MESH_QUAD[i / (STEPS + 1u) % 4u];
    if (any(lessThan(at, corner)) || any(greaterThanEqual(at - corner, uvec2(n)))) continue;
    room = min(room, room_in_row(face, at - corner, corner, i % (STEPS + 1u), first));
  }
  return room;
}

uint colour_of(uint point) {
  const uint n = mesh_quads(g_kind);
  const uvec3 at = g_kind == MESH_CUBE ? cube_place(point, n) : uvec3(point % (n + 1u), point / (n + 1u), 0u);
  return (at.x & 1u) | (at.y & 1u) << 1u | (at.z & 1u) << 2u;
}

uint sum_up_to(uint colour) {
  uint sum = 0u;
  for (uint i = 0u; i <= colour; ++i) sum += s_first[i];
  return sum;
}

// Colours one behind the other, points of one in any order; s_first says where each begins.
void sort_by_colour(uint points) {
  const uint thread = gl_LocalInvocationIndex;
  const uint colour = colour_of(min(thread, points - 1u));
  if (thread <= COLOURS) s_first[thread] = 0u;
  barrier();  // zeros before counts
  uint place = 0u;
  if (thread < points) place = atomicAdd(s_first[colour + 1u], 1u);
  barrier();  // all counts before sums
  place += sum_up_to(colour);
  const uint first = sum_up_to(min(thread, COLOURS));
  barrier();  // all sums before they take the counts' place
  if (thread <= COLOURS) s_first[thread] = first;
  if (thread < points) s_order[place] = thread;
}

void find_room(uint from, uint to, bool first) {
  const uint parts = max(gl_WorkGroupSize.x / max(to - from, 1u), 1u);
  const uint place = from + gl_LocalInvocationIndex / parts;
  if (place >= to) return;
  const float room = room_of(s_order[place], first, gl_LocalInvocationIndex % parts, parts);
  atomicMin(s_room[s_order[place]], floatBitsToUint(max(room, 0.0)));  // bits of floats >= 0 ascend as they do
}

void forget_room(uint from, uint to) {
  const uint place = from + gl_LocalInvocationIndex;
  if (place < to) s_room[s_order[place]] = floatBitsToUint(FREE / g_range_m);
}

void fit(uint points) {
  const uint thread = gl_LocalInvocationIndex;
  sort_by_colour(points);
  barrier();  // the order before its use
  forget_room(0u, points);
  barrier();  // all room before some of it is taken
  find_room(0u, points, true);
  barrier();  // the least room before points take it
  if (thread < points) s_inverse[thread] = uintBitsToFloat(s_room[thread]);
  barrier();  // all points before room is forgotten
  for (uint i = 0u; i < SWEEPS * COLOURS; ++i) {
    const uint from = s_first[i % COLOURS];
    const uint to = s_first[i % COLOURS + 1u];
    forget_room(from, to);
    barrier();  // neighbours of another colour, and all room, before this one's
    find_room(from, to, false);
    barrier();  // the least room before points take it
    const float share = i / COLOURS + 1u == SWEEPS ? 1.0 : 0.5;
    if (from + thread < to) {
      const uint point = s_order[from + thread];
      s_inverse[point] += share * (uintBitsToFloat(s_room[point]) - s_inverse[point]);
    }
  }
  barrier();  // all points before the mesh
}

#endif
