// Where in an ascending part of a list an id is or would be. Lists of lights alone cost one read, no search.
// Needs: `lookup_lists`.
// SPDX-License-Identifier: Apache-2.0

// The first place in begin .. end - 1 whose id is not less than `id`, or `end`.
uint lookup_lower_bound(uint begin, uint end, uint id) {
  if (begin >= end || id == 0u) return begin;
  if (lookup_lists[end - 1u] < id) return end;
  while (begin < end) {
    const uint middle = begin + (end - begin) / 2u;
    if (lookup_lists[middle] < id)
      begin = middle + 1u;
    else
      end = middle;
  }
  return begin;
}
