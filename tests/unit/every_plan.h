// Plans of every method with each of its settings, and what they run.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lamplight/method.h"

namespace lamp::test {

/// The defaults, and values of each option.
inline std::vector<std::vector<std::string>> settings_of(const Method& method) {
  std::vector<std::vector<std::string>> settings{{}};
  for (const OptionSpec& spec : method.options)
    for (const std::string& value : sample_values(spec)) settings.push_back({std::string(spec.key) + "=" + value});
  return settings;
}

/// The plans of every method with each of its settings, of few lights and of many, and the errors where there are none.
template <class Visit>
void every_plan(const DeviceTraits& traits, const Visit& visit) {
  for (const Method& method : methods())
    for (const std::vector<std::string>& settings : settings_of(method))
      for (const std::uint32_t lights : {100U, 4096U, 1U << 20}) {
        const Result<Plan> plan = make_plan(method, {.width = 640,
                                                     .height = 360,
                                                     .light_capacity = lights,
                                                     .options = resolve_options(method, settings).value(),
                                                     .traits = traits});
        SCOPED_TRACE(std::string(method.name) + " " + (settings.empty() ? "" : settings[0]));
        visit(plan);
        if (testing::Test::HasFailure()) return;
      }
}

inline std::vector<Pass> all_passes(const Plan& plan) {
  std::vector<Pass> passes = plan.passes;
  if (plan.fused) passes.insert(passes.end(), plan.fused->passes.begin(), plan.fused->passes.end());
  return passes;
}

}  // namespace lamp::test
