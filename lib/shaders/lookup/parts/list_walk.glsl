// The walk of a tile's list, from place to place, or of every light where the list did not fit.
// SPDX-License-Identifier: Apache-2.0
struct Walk {
  uint at;
  uint end;
  bool overflowed;  // places are lights
};

Walk walk_from(uint first, uint end, bool overflowed) {
  Walk walk;
  walk.at = first;
  walk.end = end;
  walk.overflowed = overflowed;
  return walk;
}
