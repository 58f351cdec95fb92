// Based on: Satish, Harris, Garland, Designing Efficient Sorting Algorithms for Manycore GPUs, IPDPS (2009).
// SPDX-License-Identifier: Apache-2.0
#include "light_sort.h"

#include <string>
#include <utility>

#include "lamplight/shared/slices.h"

namespace lamp::parts {
namespace {

using shared::SORT_BLOCK;
using shared::SORT_DIGITS;

}  // namespace

BufferDesc order_buffer(const char* name, std::uint64_t lights, BufferMemory memory) {
  return {.name = name, .bytes = (lights + 31) / 32 * 32 * 4, .memory = memory};
}

ResourceId add_light_sort(Plan& plan, const LightSort& sort) {
  const std::uint64_t blocks = (sort.lights + SORT_BLOCK - 1) / SORT_BLOCK;
  // The number of digits is even: the last one writes "light order".
  ResourceId to = plan.add(order_buffer("light order, other", sort.lights));
  ResourceId from = plan.add(order_buffer("light order", sort.lights));
  const ResourceId counts = plan.add({.name = "sort counts", .bytes = blocks * SORT_DIGITS * 4});
  const ResourceId totals = plan.add({.name = "sort totals", .bytes = SORT_DIGITS * 4});
  const std::string by = sort.keys ? "_keys" : "";
  for (std::uint32_t digit = 0; digit < sort.digits; ++digit) {
    const bool first = digit == 0;
    const ResourceId order = first ? sort.by : from;
    const std::string number = " " + std::to_string(digit);
    const std::vector<std::uint32_t> constants{sort.threads, digit * shared::SORT_DIGIT_BITS, first ? 1U : 0U};
    plan.passes.push_back({.name = "sort count" + number,
                           .shader = "methods/sort_count" + by,
                           .constants = constants,
                           .bindings = {{INPUT_FRAME}, {sort.by}, {order}, {counts, Access::write}},
                           .extent = {.lights_per_group = SORT_BLOCK}});
    plan.passes.push_back({.name = "sort scan" + number,
                           .shader = "methods/sort_scan",
                           .constants = {sort.threads},
                           .bindings = {{INPUT_FRAME}, {counts, Access::read_write}, {totals, Access::write}},
                           .extent = {.x = SORT_DIGITS}});
    plan.passes.push_back({.name = "sort scatter" + number,
                           .shader = "methods/sort_scatter" + by,
                           .constants = constants,
                           .bindings = {{INPUT_FRAME}, {sort.by}, {order}, {counts}, {totals}, {to, Access::write}},
                           .extent = {.lights_per_group = SORT_BLOCK}});
    std::swap(from, to);
  }
  return from;
}

}  // namespace lamp::parts
