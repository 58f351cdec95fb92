// A tile with a mask of occupied depths, a pixel of it, and what the tests of a sphere say.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TEST_MASK_CASE_H
#define LAMP_TEST_MASK_CASE_H

#include "volume_case.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct MaskCase {
  VolumeCase volume;
  float depth;  // of the pixel, device depth
  uint others;  // parts that other pixels occupy
};

struct MaskAnswer {
  uint look;     // APART 0, TOUCHES 1, UNDECIDED 2
  uint touches;  // 0 or 1, exactly
  uint apart;    // parts that lie between those of a depth which is rounded in two ways, at most
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
