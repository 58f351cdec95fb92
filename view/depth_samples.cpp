// Tries each number.
// SPDX-License-Identifier: Apache-2.0
#include "view/depth_samples.h"

#include "error.h"
#include "render/sample_depth.h"

namespace lamp::app {
namespace {

bool has(const Context& context, std::uint32_t count) {
  try {
    check_depth_samples(context.device(), count);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::uint32_t> depth_sample_counts(const Context& context) {
  std::vector<std::uint32_t> counts;
  for (const std::uint32_t count : {1U, 2U, 4U, 8U})
    if (has(context, count)) counts.push_back(count);
  return counts;
}

}  // namespace lamp::app
