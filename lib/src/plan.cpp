// Plans: adding buffers, counting bytes.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/plan.h"

namespace lamp {

ResourceId Plan::add(BufferDesc buffer) {
  buffers.push_back(std::move(buffer));
  return PLAN_BUFFER + static_cast<ResourceId>(buffers.size() - 1);
}

std::uint64_t Plan::bytes() const {
  std::uint64_t sum = 0;
  for (const BufferDesc& buffer : buffers) sum += buffer.bytes;
  return sum;
}

}  // namespace lamp
