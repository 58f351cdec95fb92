// Whether a light may bring any light to a cell: its radial bound against the part of a tile between two depths.
// Promise: never no for a cell with a point that the shadow look-up finds lit at all; the same answer in every shader.
// Needs: RADIAL_BINDING.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_RADIAL_BOUNDS
#define LAMP_COMMON_RADIAL_BOUNDS
#include "common/light_bounds.glsl"
#include "common/radial_cells.glsl"

layout(set = 0, binding = RADIAL_BINDING, scalar) readonly buffer RadialBuffer { RadialBound radial_bounds[]; };

bool radial_cells_are_lit(uint light, RadialCells cells) {
  if (!cells.any) return false;
  precise const float least = cells.nearest_m / radial_bounds[light].unit_m;
  for (uint y = cells.first.y; y <= cells.last.y; ++y)
    for (uint x = cells.first.x; x <= cells.last.x; ++x) {
      const uint i = RADIAL_SIDE * y + x;
      const uint reach = radial_bounds[light].bytes[i / 16u][i / 4u % 4u] >> (8u * (i % 4u)) & 255u;
      if (reach == RADIAL_ANY || least <= float(reach)) return true;
    }
  return false;
}

// Of a box around the light: of a spot in its own axes.
bool radial_reaches_box(uint light, vec3 low, vec3 high) {
  if (radial_bounds[light].kind == RADIAL_SPOT)
    return radial_cells_are_lit(light, radial_cells_of_spot(radial_bounds[light].scale, low, high));
  for (uint octants = radial_octants(low, high); octants != 0u; octants &= octants - 1u)
    if (radial_cells_are_lit(light, radial_cells_of_octant(uint(findLSB(octants)), low, high))) return true;
  return false;
}

// From view space to a light's own.
struct RadialSpace {
  mat3 axes;
  vec3 origin;
};

RadialSpace radial_space(Frame frame, uint light) {
  precise RadialSpace space;
  space.axes = mat3(frame.world_from_view);
  space.origin = frame.world_from_view[3].xyz - radial_bounds[light].position;
  if (radial_bounds[light].kind != RADIAL_SPOT) return space;
  const vec3 x = radial_bounds[light].axis_x;
  const vec3 z = radial_bounds[light].axis_z;
  const mat3 turned = transpose(mat3(x, cross(z, x), z));
  space.axes = turned * space.axes;
  space.origin = turned * space.origin;
  return space;
}

// Depths between these at which a sphere may reach anything: never infinite for a light whose bound says something.
vec2 radial_depths(LightBounds sphere, float z_near, float z_far) {
  return vec2(max(z_near, -sphere.center.z - sphere.radius), min(z_far, -sphere.center.z + sphere.radius));
}

const uint RADIAL_MOST_PIECES = 8u;

// The way between two depths. A long one is cut in pieces of an eighth of the light's range, a cell's width at a third of
// it: the box around all of it would be wide where the tile is not.
struct RadialPieces {
  RadialSpace space;
  float slack;  // m
  vec2 depths;
  float step;
  uint count;
};

bool radial_cuts_nothing(uint light) {
  return light >= uint(radial_bounds.length()) || radial_bounds[light].kind == RADIAL_NONE;
}

// Of a light that something is known of. Rounding: where depths do not meet, another test has said that they do, and one
// piece has them both.
RadialPieces radial_pieces(Frame frame, uint light, vec2 depths) {
  RadialPieces pieces;
  pieces.space = radial_space(frame, light);
  precise const float slack =
      4.0 * ROUND_POSITION *
      (length(radial_bounds[light].position) + length(frame.eye_world) + abs(depths.x) + abs(depths.y));
  pieces.slack = slack;
  pieces.depths = vec2(min(depths.x, depths.y), max(depths.x, depths.y));
  const float length_m = pieces.depths.y - pieces.depths.x;
  const float piece_m = radial_bounds[light].unit_m * float(RADIAL_ANY) / float(RADIAL_MOST_PIECES);
  pieces.count = uint(clamp(ceil(length_m / piece_m), 1.0, float(RADIAL_MOST_PIECES)));
  precise const float step = length_m / float(pieces.count);
  pieces.step = step;
  return pieces;
}

// Its depths.
vec2 radial_piece(RadialPieces pieces, uint i) {
  precise const vec2 piece = pieces.depths.x + pieces.step * vec2(float(i), float(i + 1u));
  return i + 1u < pieces.count ? piece : vec2(piece.x, pieces.depths.y);
}

// By the box around the part of a tile between its edges (TileSides) and the depths of a piece, in the light's space.
bool radial_reaches_piece(uint light, RadialPieces pieces, uint number, vec4 x_edges, vec4 y_edges) {
  const RadialSpace space = pieces.space;
  const vec2 depths = radial_piece(pieces, number);
  const mat3 lengths = mat3(abs(space.axes[0]), abs(space.axes[1]), abs(space.axes[2]));
  vec3 low = vec3(3e38);
  vec3 high = vec3(-3e38);
  for (uint i = 0u; i < 2u; ++i) {
    const float z = depths[i];
    precise const vec2 x = x_edges.xz + x_edges.yw * z;
    precise const vec2 y = y_edges.xz + y_edges.yw * z;
    precise const vec3 middle = space.axes * vec3(0.5 * (x.x + x.y), 0.5 * (y.x + y.y), -z) + space.origin;
    precise const vec3 around = lengths * vec3(0.5 * abs(x.y - x.x), 0.5 * abs(y.y - y.x), 0.0);
    low = min(low, middle - around);
    high = max(high, middle + around);
  }
  return radial_reaches_box(light, low - pieces.slack, high + pieces.slack);
}

// The part of a tile between its edges and two depths.
bool radial_reaches(Frame frame, uint light, vec4 x_edges, vec4 y_edges, vec2 depths) {
  if (radial_cuts_nothing(light)) return true;
  const RadialPieces pieces = radial_pieces(frame, light, depths);
  for (uint i = 0u; i < pieces.count; ++i)
    if (radial_reaches_piece(light, pieces, i, x_edges, y_edges)) return true;
  return false;
}

#endif
