// Brute force: every light for every pixel. The reference that every other method's picture is compared with.
// SPDX-License-Identifier: Apache-2.0
#include "methods.h"

namespace lamp {

Method all_method() {
  return {.name = "all",
          .title = "Brute force",
          .source = "no culling; the baseline of every paper",
          .summary = "Every pixel walks every light.",
          .result = "all",
          .needs_depth = false,
          .any_depth = true,
          .plan = [](const Problem&) {
            Plan plan;
            plan.any_depth = true;
            plan.lookup = {.name = "all", .bindings = {{INPUT_FRAME}}};
            return plan;
          }};
}

}  // namespace lamp
