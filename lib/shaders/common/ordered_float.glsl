// Floats as numbers whose unsigned order is theirs, and back. Neither a finite number nor its complement becomes 0.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_ORDERED_FLOAT
#define LAMP_COMMON_ORDERED_FLOAT

// Floats sort like their bits, once negative ones are turned over.
uint ordered_bits(float value) {
  const uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float float_of_ordered(uint ordered) {
  return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

#endif
