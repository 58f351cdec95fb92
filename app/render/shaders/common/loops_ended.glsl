// Whether the device has ended this thread's loops. Software devices do so after a number of rounds of all loops
// together (llvmpipe: 65 535); a loop that comes later then goes round once, whatever it was to do.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LOOPS_ENDED
#define LAMP_COMMON_LOOPS_ENDED

// `two` is 2, in a way that no compiler knows: a loop of a known number of rounds may become none.
bool loops_ended(uint two) {
  uint rounds = 0u;
  for (uint i = 0u; i < two; ++i) ++rounds;
  return rounds < two;
}

#endif
