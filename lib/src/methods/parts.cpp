// Buffers and passes that several methods put into their plans.
// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

#include <cstddef>

#include "lamplight/shared/further_tests.h"
#include "lamplight/shared/slices.h"

namespace lamp::parts {

BufferDesc zeroed_cells(std::string name, const Problem& problem, const CellGrid& cells, std::uint64_t cell_bytes) {
  return {.name = std::move(name),
          .bytes = cells.count(problem.width, problem.height) * cell_bytes,
          .zeroed = true,
          .zeroed_cells = cells,
          .cell_bytes = cell_bytes};
}

ResourceId add_light_bounds(Plan& plan, const Problem& problem) {
  return plan.add({.name = "light bounds", .bytes = std::uint64_t{capacity(problem)} * sizeof(shared::LightBounds)});
}

Pass light_bounds_pass(ResourceId bounds) {
  return {.name = "light bounds",
          .shader = "methods/light_bounds",
          .bindings = {{INPUT_FRAME}, {INPUT_SPHERES}, {bounds, Access::write}},
          .extent = {.lights_per_group = 64}};
}

ResourceId add_counters(Plan& plan) {
  plan.counters =
      plan.add({.name = "counters", .bytes = sizeof(shared::Counters), .memory = BufferMemory::counts, .zeroed = true});
  return plan.counters;
}

Capacity shared_list(std::string_view option, std::uint64_t entries, std::uint64_t per_option) {
  return {.option = option,
          .entries = entries,
          .per_option = per_option,
          .needed_offset = offsetof(shared::Counters, entries_needed)};
}

Capacity own_lists(std::string_view option, std::uint64_t entries) {
  return {
      .option = option, .entries = entries, .per_option = 1, .needed_offset = offsetof(shared::Counters, longest_list)};
}

OptionSpec occlusion_option() {
  return {.key = "occlusion",
          .help = "radial: lights are cut to how far their shadow maps let them reach, by direction",
          .fallback = "none",
          .choices = {"none", "radial"}};
}

bool is_radial(const Options& options) { return options.word("occlusion") == "radial"; }

OptionSpec boxes_option() {
  return {.key = "boxes",
          .help = "decals and probes are culled by their bounding sphere; or also by their shape",
          .fallback = "sphere",
          .choices = {"sphere", "shape"}};
}

bool has_shapes(const Options& options) { return options.word("boxes") == "shape"; }

std::uint32_t further_tests(const Options& options) {
  return (is_radial(options) ? shared::FURTHER_RADIAL : 0) | (has_shapes(options) ? shared::FURTHER_SHAPES : 0);
}

Binding radial_binding(const Problem& problem, ResourceId other) {
  return {is_radial(problem.options) ? INPUT_RADIAL : other};
}

Binding record_binding(const Problem& problem, ResourceId other) {
  return {has_shapes(problem.options) ? INPUT_LIGHTS : other};
}

OptionSpec walk_option(std::string_view fallback) {
  return {.key = "walk",
          .help = "each thread by itself, or all threads of a subgroup one cell (lists) or one light (bits) at a time",
          .fallback = fallback,
          .choices = {"plain", "scalar-cell", "scalar-entity"}};
}

std::optional<Error> check_walk(const Options& options, Container container) {
  const std::string& walk = options.word("walk");
  if (container == Container::bits && walk == "scalar-cell")
    return Error{"option walk", "scalar-cell walks the list of one cell at a time; bits go with scalar-entity"};
  if (container == Container::list && walk == "scalar-entity")
    return Error{"option walk", "scalar-entity walks merged bits one light at a time; lists go with scalar-cell"};
  return std::nullopt;
}

std::string walk_lookup(Plan& plan, const Problem& problem, std::string_view plain) {
  const std::string& walk = problem.options.word("walk");
  std::string name(plain);
  if (walk == "plain") return name;
  const bool by_cell = walk == "scalar-cell";
  const auto walks = [&](const SubgroupOperations& has) { return has.ballot && (by_cell || has.arithmetic); };
  if (walks(problem.traits.compute_subgroups) && walks(problem.traits.fragment_subgroups)) return name += "_scalar";
  plan.notes.push_back("walk=plain instead of " + walk + ": the device has no subgroup " +
                       (by_cell ? "ballot" : "ballot and arithmetic") + " in compute and fragment shaders");
  return name;
}

OptionSpec slice_scale_option(std::string_view key, std::string_view fallback) {
  return {.key = key,
          .help = "slices of depth grow by a constant factor, or have the same length",
          .fallback = fallback,
          .choices = {"log", "linear"}};
}

OptionSpec slice_near_option(std::string_view help) {
  return {.key = "near_mm", .help = help, .fallback = "500", .min = 1, .max = 1000};
}

OptionSpec slice_far_option(std::string_view help) {
  return {.key = "far_m", .help = help, .fallback = "500", .min = 2, .max = 1000000};
}

std::uint32_t slice_scale(std::string_view word) {
  return word == "linear" ? shared::SLICES_LINEAR : shared::SLICES_LOG;
}

}  // namespace lamp::parts
