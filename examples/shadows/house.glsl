// A house without a roof: a floor, twelve rooms with doors, two boxes in each. The front wall is low, to look inside.
// SPDX-License-Identifier: Apache-2.0
#include "box.glsl"

const uint HOUSE_BOXES = 87;  // as in main.cpp
const vec2 ROOM = vec2(5.0, 4.5);
const vec2 CORNER = vec2(-10.0, -6.75);
const float WALL = 1.4;  // half its height
const float DOOR = 0.6;  // half its width

// A wall between two rooms has a door, and so it is two boxes, on either side of the door; an outer wall has none.
// `along`: the axis it runs along, 0 x, 1 z.
Box wall_of(vec2 middle, uint along, uint side, bool door, float height) {
  const float gap = door ? DOOR : 0.0;
  const float half_length = 0.5 * (0.5 * ROOM[along] - gap);
  vec2 at = middle;
  at[along] += (side == 0u ? -1.0 : 1.0) * (gap + half_length);
  vec2 half_extent = vec2(0.1);
  half_extent[along] = half_length + (door ? 0.0 : 0.1);
  return Box(vec3(at.x, height, at.y), vec3(half_extent.x, height, half_extent.y), 4u);
}

Box house_box(uint box) {
  if (box == 0u) return Box(vec3(0.0, -0.1, 0.0), vec3(10.1, 0.1, 6.85), 0u);
  uint i = box - 1u;
  if (i < 32u) {  // along x, four lines of four
    const uint line = i / 8u;
    const vec2 middle = CORNER + ROOM * vec2(float(i / 2u % 4u) + 0.5, float(line));
    return wall_of(middle, 0u, i % 2u, line % 3u != 0u && (line + i / 2u) % 2u == 0u, line == 3u ? 0.15 : WALL);
  }
  i -= 32u;
  if (i < 30u) {  // along z, five lines of three
    const uint line = i / 6u;
    const vec2 middle = CORNER + ROOM * vec2(float(line), float(i / 2u % 3u) + 0.5);
    return wall_of(middle, 1u, i % 2u, line % 4u != 0u && (line + i / 2u) % 2u == 0u, WALL);
  }
  i -= 30u;
  const uint room = i / 2u;
  const vec2 middle = CORNER + ROOM * (vec2(float(room % 4u), float(room / 4u)) + 0.5);
  const vec2 aside = i % 2u == 0u ? vec2(-1.3, -1.1) : vec2(1.2, 0.9);
  const float height = i % 2u == 0u ? 0.25 + 0.1 * float(room % 3u) : 0.5 + 0.15 * float(room % 2u);
  return Box(vec3(middle.x + aside.x, height, middle.y + aside.y), vec3(0.35, height, 0.3), 1u + (room + i) % 3u);
}
