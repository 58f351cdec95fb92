// More room for the next frame: larger values of the options that size what did not fit.
// Promise: a plan that is returned has more entries where they were missing, and has passed plan_check.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>

#include "complete_options.h"
#include "lamplight/method.h"

namespace lamp {
namespace {

/// More of an option.
struct Demand {
  std::string_view option;
  std::uint64_t now = 0;
  std::uint64_t more = 0;
};

/// Entries to make room for: a quarter more than were needed, since the next frame is another one; and by half more
/// than there are, in case that the count stopped short.
std::uint64_t wanted_entries(const Capacity& capacity, std::uint64_t needed) {
  return std::max(needed + needed / 4, capacity.entries + capacity.entries / 2);
}

std::vector<Demand> demands(const Method& method, const Options& options, const Plan& plan,
                            std::span<const std::uint32_t> needed) {
  std::vector<Demand> made;
  for (std::size_t i = 0; i < plan.capacities.size(); ++i) {
    const Capacity& capacity = plan.capacities[i];
    const std::uint64_t entries = std::uint64_t{needed[i]} * capacity.entries_per_count;
    if (entries <= capacity.entries) continue;
    const auto spec = std::ranges::find(method.options, capacity.option, &OptionSpec::key);
    assert(spec != method.options.end() && "a capacity names an option of its method");
    const std::uint64_t missing = wanted_entries(capacity, entries) - capacity.entries;
    const std::uint64_t now = options.integer(capacity.option);
    const std::uint64_t room = static_cast<std::uint64_t>(spec->max) - now;
    made.push_back({capacity.option, now, std::min(room, (missing - 1) / capacity.per_option + 1)});
  }
  return made;
}

Options with_demands(const Method& method, const Options& options, std::span<const Demand> demands) {
  auto values = options.all();
  for (const Demand& demand : demands) values[std::string(demand.option)] = std::to_string(demand.now + demand.more);
  return resolve_options(method, settings_of(values)).value();
}

bool has_more_room(const Plan& plan, const Plan& than) {
  for (std::size_t i = 0; i < plan.capacities.size(); ++i)
    if (plan.capacities[i].entries > than.capacities[i].entries) return true;
  return false;
}

}  // namespace

std::optional<GrownPlan> grow_plan(const Method& method, const Problem& problem, const Plan& plan,
                                   std::span<const std::uint32_t> needed) {
  assert(needed.size() == plan.capacities.size() && "one count for each capacity of the plan");
  const Result<Options> options = complete_options(method, problem.options);
  if (!options) return std::nullopt;
  std::vector<Demand> more = demands(method, options.value(), plan, needed);
  // What a device refuses is asked for by halves.
  while (std::ranges::any_of(more, [](const Demand& demand) { return demand.more != 0; })) {
    Problem larger = problem;
    larger.options = with_demands(method, options.value(), more);
    Result<Plan> grown = make_plan(method, larger);
    if (grown && has_more_room(grown.value(), plan))
      return GrownPlan{std::move(larger.options), std::move(grown.value())};
    if (grown) return std::nullopt;
    for (Demand& demand : more) demand.more /= 2;
  }
  return std::nullopt;
}

}  // namespace lamp
