// Fuzzes suites: any bytes give a suite or an Error; a suite multiplies out to no more configurations than are allowed,
// and each of them has a name.
// Seeds: corpus_suite/. Build with -DLAMPLIGHT_FUZZ=ON; no file is opened.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "bench/groups.h"
#include "error.h"

namespace {

void expect(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const lamp::app::Suite suite = lamp::app::parse_suite({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    const lamp::app::Expansion all = lamp::app::expand(suite, {});
    std::size_t count = 0;
    for (const lamp::app::Group& group : all.groups)
      for (const lamp::app::GroupEntry& entry : group.entries) {
        expect(!lamp::app::key_of(group, entry).empty());
        ++count;
      }
    expect(count <= lamp::app::MOST_CONFIGURATIONS && all.left_out == 0);
    const lamp::app::Expansion fewer = lamp::app::expand(suite, {.max_lights = 1000});
    std::size_t kept = fewer.left_out;
    for (const lamp::app::Group& group : fewer.groups) kept += group.entries.size();
    expect(kept == count);
  } catch (const lamp::app::Error&) {
    return 0;
  }
  return 0;
}
