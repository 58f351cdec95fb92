// Walks the lights at places one behind the other, a list or all lights: one by one, or many at once.
// Needs: Walk with `at` and `end`; lookup_light_at(walk, place).
// SPDX-License-Identifier: Apache-2.0
bool walk_next(inout Walk walk, out uint light) {
  light = 0u;
  if (walk.at >= walk.end) return false;
  light = lookup_light_at(walk, walk.at);
  ++walk.at;
  return true;
}

uint walk_take(inout Walk walk, uint most, uint rank, out uint light) {
  const uint count = walk.at < walk.end ? min(walk.end - walk.at, most) : 0u;
  light = 0u;
  if (rank < count) light = lookup_light_at(walk, walk.at + rank);
  walk.at += count;
  return count;
}
