// The table of methods: one row each, in the order of the docs. A new method is one more row here.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "check_traits.h"
#include "complete_options.h"
#include "lamplight/method.h"
#include "methods/methods.h"
#include "own_inputs.h"

namespace lamp {

std::span<const Method> methods() {
  static const std::vector<Method> table = [] {
    std::vector<Method> rows{all_method()};
    std::ranges::copy(tiled_methods(), std::back_inserter(rows));
    std::ranges::copy(clustered_methods(), std::back_inserter(rows));
    rows.push_back(drobot_zbin_method());
    rows.push_back(drobot_raster_tile_method());
    rows.push_back(drobot_raster_cluster_method());
    rows.push_back(lamplight_method());
    rows.push_back(world_cells_method());
    rows.push_back(ikkala_grid_method());
    rows.push_back(world_tree_method());
    return rows;
  }();
  return table;
}

Result<const Method*> find_method(std::string_view name) {
  const auto found = std::ranges::find(methods(), name, &Method::name);
  if (found != methods().end()) return &*found;
  std::vector<std::string_view> names;
  for (const Method& method : methods()) names.push_back(method.name);
  std::string message = "there is no such method; the nearest are ";
  const std::vector<std::string> nearest = nearest_names(name, names);
  for (std::size_t i = 0; i < nearest.size(); ++i) message += (i == 0 ? "" : ", ") + nearest[i];
  return Error{"method '" + std::string(name) + "'", message};
}

namespace {

/// Brute force's shading takes lights in groups of 64, which cost two rounds each besides a round for every light.
/// Where a subgroup walks one cell at a time, a thread goes through the rounds of all cells of its subgroup. Where it
/// walks one light of its words at a time, finding that takes as many again.
std::uint64_t most_walked(std::string_view lookup, const DeviceTraits& traits) {
  const std::uint64_t rounds = traits.max_loop_rounds;
  if (lookup == "all") return rounds - rounds / 32 - 1;
  if (lookup.ends_with("_lists_scalar")) return rounds / WALK_ROUNDS / traits.subgroup_size;
  if (lookup.ends_with("_bits_scalar")) return rounds / WALK_ROUNDS / 2;
  return rounds / WALK_ROUNDS;
}

/// Methods plan for one view. Each gets its share of a buffer.
Problem of_a_view(Problem problem) {
  problem.traits.max_storage_buffer_bytes /= problem.views;
  problem.traits.memory_bytes /= problem.views;
  return problem;
}

/// Tells the look-up where the parts of its buffers lie. plan_check refuses what 32 bits cannot say.
void tell_views(Plan& plan) {
  if (plan.views == 1) return;
  for (const Binding& binding : plan.lookup.bindings) {
    const bool is_buffer = binding.resource >= PLAN_BUFFER && binding.resource != NO_RESOURCE;
    const std::uint64_t bytes = is_buffer ? plan.view_bytes(plan.buffers[binding.resource - PLAN_BUFFER]) : 0;
    plan.lookup.view_words.push_back(static_cast<std::uint32_t>(bytes / 4));
  }
}

/// A device that ends long loops cannot walk every light: an error where every pixel does, a note where one may.
std::optional<Error> check_walks(const Problem& problem, Plan& plan) {
  if (problem.traits.max_loop_rounds == ~0U) return std::nullopt;
  const std::string ends =
      "the device ends a thread's loops after " + std::to_string(problem.traits.max_loop_rounds) + " rounds";
  if (plan.lookup.most_walked == ~0ULL) plan.lookup.most_walked = most_walked(plan.lookup.name, problem.traits);
  if (problem.light_capacity <= plan.lookup.most_walked) return std::nullopt;
  if (plan.lookup.name == "all")
    return Error{"look-up all", "walks " + std::to_string(problem.light_capacity) + " lights, but " + ends};
  plan.notes.push_back("a pixel that walks more than " + std::to_string(plan.lookup.most_walked) +
                       " lights can lose some: " + ends);
  return std::nullopt;
}

constexpr std::uint32_t MAX_SAMPLES = 64;  // of VkSampleCountFlagBits

/// Shaders that read depth are those for several samples. A fused look-up shades one sample a pixel: there is none.
void read_many_samples(Plan& plan) {
  for (Pass& pass : plan.passes)
    if (std::ranges::find(pass.bindings, INPUT_DEPTH, &Binding::resource) != pass.bindings.end())
      pass.shader += "@multisampled";
  plan.fused.reset();
}

/// The device, sizes, capacities and counts, whatever the method.
std::optional<Error> check_problem(const Problem& problem) {
  if (auto error = check_traits(problem.traits)) return error;
  const std::uint32_t limit = std::min(problem.traits.max_image_size, MAX_IMAGE_SIZE);
  if (problem.width == 0 || problem.height == 0 || problem.width > limit || problem.height > limit)
    return Error{"size " + std::to_string(problem.width) + "x" + std::to_string(problem.height),
                 "expected 1 to " + std::to_string(limit) + " pixels a side on this device"};
  if (problem.light_capacity > MAX_LIGHTS)
    return Error{"light capacity",
                 "expected at most " + std::to_string(MAX_LIGHTS) + ", got " + std::to_string(problem.light_capacity)};
  if (!std::has_single_bit(problem.depth_samples) || problem.depth_samples > MAX_SAMPLES)
    return Error{"depth samples", "expected 1, 2, 4, 8, 16, 32 or 64, got " + std::to_string(problem.depth_samples)};
  if (problem.views == 0 || problem.views > MAX_VIEWS)
    return Error{"views", "expected 1 to " + std::to_string(MAX_VIEWS) + ", got " + std::to_string(problem.views)};
  if (problem.frames_in_flight == 0 || problem.frames_in_flight > MAX_FRAMES_IN_FLIGHT)
    return Error{"frames in flight", "expected 1 to " + std::to_string(MAX_FRAMES_IN_FLIGHT) + ", got " +
                                         std::to_string(problem.frames_in_flight)};
  return problem.light_layout.check();
}

}  // namespace

Result<Plan> make_plan(const Method& method, const Problem& asked) {
  if (auto error = check_problem(asked)) return *error;
  Result<Options> options = complete_options(method, asked.options);
  if (!options) return options.error();
  Problem problem = asked;
  problem.options = std::move(options.value());
  if (method.check != nullptr)
    if (auto error = method.check(problem)) return *error;
  Plan plan = method.plan(of_a_view(problem));
  plan.width = problem.width;
  plan.height = problem.height;
  plan.views = problem.views;
  plan.light_capacity = problem.light_capacity;
  plan.frames_in_flight = problem.frames_in_flight;
  plan.light_layout = problem.light_layout;
  plan.depth_samples = problem.depth_samples;
  if (problem.depth_samples > 1) read_many_samples(plan);
  make_own_inputs(plan, problem);
  tell_views(plan);
  std::optional<Error> error = plan_check(plan, problem.traits);
  if (!error) error = check_walks(problem, plan);
  if (error) {
    error->source = "method " + std::string(method.name) + ": " + error->source;
    return *error;
  }
  return plan;
}

}  // namespace lamp
