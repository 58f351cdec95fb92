// The passes of a radix sort of lights, for methods that want them in another order than their own.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/method.h"

namespace lamp::parts {

struct LightSort {
  ResourceId by = NO_RESOURCE;  ///< shared::LightBounds of each light, for its depth; with `keys` a number of each
  bool keys = false;
  std::uint32_t digits = 4;     ///< of SORT_DIGIT_BITS that a key has: 2 or 4
  std::uint64_t lights = 1;     ///< capacity
  std::uint32_t threads = 256;  ///< of a work group
};

/// The lights' order, one word a light, whole words of bits of them so that any bit has an entry.
[[nodiscard]] BufferDesc order_buffer(const char* name, std::uint64_t lights,
                                      BufferMemory memory = BufferMemory::device);

/// Three passes a digit, least digit first. Returns the final order; lights of equal keys keep theirs.
[[nodiscard]] ResourceId add_light_sort(Plan& plan, const LightSort& sort);

}  // namespace lamp::parts
