// Clustered culling: tiles cut into slices of depth, without reading the depth buffer; a cluster keeps a list of any
// length, or a bit for each light.
// Based on: Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, HPG (2012); Drobot, Improved Culling
// for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// Promise: right for any depth of a pixel; count, scan, fill, so lists are compact and ascend.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <initializer_list>

#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

/// The grid, and what all passes and the look-up are specialised with.
struct Clusters {
  std::uint64_t tiles;
  std::uint64_t count;
  std::uint32_t threads;
  std::vector<std::uint32_t> constants;  ///< of the look-up; passes have threads before them, `further` behind them
  std::uint32_t further;
  [[nodiscard]] Extent one_group_a_tile() const { return {.cells = {.px = constants[0]}}; }
  [[nodiscard]] std::vector<std::uint32_t> pass_constants(std::initializer_list<std::uint32_t> last) const {
    std::vector<std::uint32_t> all{threads};
    all.insert(all.end(), constants.begin(), constants.end());
    all.push_back(further);
    all.insert(all.end(), last);
    return all;
  }
};

Clusters clusters_of(const Problem& problem) {
  const Options& o = problem.options;
  const std::uint64_t tiles = parts::tile_count(problem, o.integer("tile"));
  return {.tiles = tiles,
          .count = tiles * o.integer("slices"),
          .threads = parts::cull_threads(problem),
          .constants = {o.integer("tile"), o.integer("slices"), parts::slice_scale(o.word("scale")),
                        o.integer("near_mm"), o.integer("far_m")},
          .further = parts::further_tests(o)};
}

/// Each cluster one flat bit array.
void add_bits(Plan& plan, const Problem& problem, const Clusters& c, ResourceId bounds) {
  const std::uint32_t words = parts::divide_up(parts::capacity(problem), 32);
  const ResourceId bits = plan.add({.name = "cluster bits", .bytes = c.count * words * 4});
  plan.passes.push_back({.name = "cluster bits",
                         .shader = "methods/clustered_bits",
                         .constants = c.pass_constants({words}),
                         .bindings = {{INPUT_FRAME},
                                      {bounds},
                                      {bits, Access::write},
                                      parts::radial_binding(problem, bounds),
                                      parts::record_binding(problem, bounds)},
                         .extent = c.one_group_a_tile()});
  plan.lookup = {.name = parts::walk_lookup(plan, problem, "cluster_bits"),
                 .constants = c.constants,
                 .bindings = {{INPUT_FRAME}, {bits}}};
  plan.lookup.constants.push_back(words);
}

/// A tile's bits serve where lists do not fit; beyond this size of them all, every light serves.
constexpr std::uint64_t MOST_BIT_BYTES = 1U << 26;  // a million lights at 1920x1080

/// Words of a tile's bits, 0 if there shall be none.
std::uint32_t words_of_a_tile(const Problem& problem, std::uint64_t tiles) {
  const std::uint32_t words = parts::divide_up(parts::capacity(problem), 32);
  const std::uint64_t bytes = tiles * words * 4;
  return bytes <= std::min(MOST_BIT_BYTES, problem.traits.max_storage_buffer_bytes) ? words : 0;
}

constexpr std::uint32_t MEAN_CAPACITY = 512;  // default of the option

/// Of the shared list: no cluster can list more than every light.
std::uint64_t list_entries(const Problem& problem, std::uint64_t clusters) {
  const std::uint64_t mean = problem.options.integer("mean_capacity");
  const std::uint64_t worst = clusters * parts::capacity(problem);
  return mean >= MEAN_CAPACITY && worst <= parts::SMALL_LISTS ? worst : std::min(clusters * mean, worst);
}

/// Each cluster a range of one shared list.
void add_lists(Plan& plan, const Problem& problem, const Clusters& c, ResourceId bounds) {
  const std::uint64_t wanted = list_entries(problem, c.count);
  const auto entries = static_cast<std::uint32_t>(wanted);  // beyond 32 bits, plan_check refuses the buffer
  const ResourceId counters = parts::add_counters(plan);
  plan.capacities = {parts::shared_list("mean_capacity", wanted, c.count)};
  const ResourceId ranges = plan.add({.name = "cluster ranges", .bytes = c.count * 8});
  const ResourceId lists = plan.add({.name = "cluster lists", .bytes = wanted * 4});
  const std::uint32_t words = words_of_a_tile(problem, c.tiles);
  // Bound to the list, and not used, where there are none.
  const ResourceId bits = words == 0 ? lists : plan.add({.name = "tile bits", .bytes = c.tiles * words * 4});
  plan.passes.push_back({.name = "cluster count",
                         .shader = "methods/clustered_count",
                         .constants = c.pass_constants({}),
                         .bindings = {{INPUT_FRAME},
                                      {bounds},
                                      {ranges, Access::write},
                                      parts::radial_binding(problem, bounds),
                                      parts::record_binding(problem, bounds)},
                         .extent = c.one_group_a_tile()});
  plan.passes.push_back({.name = "cluster scan",
                         .shader = "methods/clustered_scan",
                         .constants = {c.threads, c.constants[0], c.constants[1], entries},
                         .bindings = {{INPUT_FRAME}, {ranges, Access::read_write}, {counters, Access::read_write}}});
  plan.passes.push_back({.name = "cluster fill",
                         .shader = "methods/clustered_fill",
                         .constants = c.pass_constants({words}),
                         .bindings = {{INPUT_FRAME},
                                      {bounds},
                                      {ranges},
                                      {lists, Access::write},
                                      {bits, Access::write},
                                      parts::radial_binding(problem, bounds),
                                      parts::record_binding(problem, bounds)},
                         .extent = c.one_group_a_tile()});
  plan.lookup = {.name = parts::walk_lookup(plan, problem, "cluster_lists"),
                 .constants = c.constants,
                 .bindings = {{INPUT_FRAME}, {ranges}, {lists}, {bits}}};
  plan.lookup.constants.push_back(words);
}

Plan plan_clustered(const Problem& problem) {
  const Clusters clusters = clusters_of(problem);
  Plan plan;
  plan.cells = clusters.count;
  plan.any_depth = true;
  const ResourceId bounds = parts::add_light_bounds(plan, problem);
  plan.passes = {parts::light_bounds_pass(bounds)};
  const bool bits = problem.options.word("container") == "bits";
  (bits ? add_bits : add_lists)(plan, problem, clusters, bounds);
  return plan;
}

std::optional<Error> check_clustered(const Problem& problem) {
  const bool bits = problem.options.word("container") == "bits";
  return parts::check_walk(problem.options, bits ? parts::Container::bits : parts::Container::list);
}

std::vector<OptionSpec> clustered_options(
    std::initializer_list<std::pair<std::string_view, std::string_view>> fallbacks) {
  std::vector<OptionSpec> specs{
      {.key = "tile", .help = "tile size, pixels", .fallback = "64", .choices = {"16", "32", "64"}},
      {.key = "slices", .help = "slices of depth", .fallback = "24", .min = 1, .max = 32},
      parts::slice_scale_option("scale", "log"),
      parts::slice_near_option(),
      parts::slice_far_option(),
      {.key = "container", .help = "what a cluster keeps", .fallback = "list", .choices = {"list", "bits"}},
      parts::occlusion_option(),
      parts::boxes_option(),
      parts::walk_option(),
      {.key = "mean_capacity",
       .help = "container=list: lights a cluster, on average, that the shared list has room for; from 512 on, all "
               "lights where these are few",
       .fallback = "512",
       .min = 1,
       .max = MAX_LIGHTS}};
  parts::set_fallbacks(specs, fallbacks);
  return specs;
}

Method row(std::string_view name, std::string_view title, std::string_view source, std::string_view summary) {
  return {.name = name,
          .title = title,
          .source = source,
          .summary = summary,
          .result = "cluster_lists",
          .needs_depth = false,
          .any_depth = true,
          .options = clustered_options({}),
          .plan = plan_clustered,
          .check = check_clustered};
}

}  // namespace

std::vector<Method> clustered_methods() {
  const Method clustered =
      row("clustered", "Clustered culling", "Olsson et al., Clustered Deferred and Forward Shading, HPG (2012)",
          "Tiles cut into logarithmic slices of depth; every cluster gets a list, covered by pixels or not.");
  Method olsson = row(
      "olsson-clustered", "Olsson, clusters with lists",
      "Olsson et al., Clustered Deferred and Forward Shading, HPG (2012)",
      "Tiles of 32 pixels and 32 slices; a cluster points to a list, which a subgroup walks one cluster at a time.");
  olsson.options = clustered_options({{"tile", "32"}, {"slices", "32"}, {"walk", "scalar-cell"}});
  Method drobot = row("drobot-clustered", "Drobot, clusters with bits",
                      "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017)",
                      "Tiles of 32 pixels and 18 slices keep bits; a subgroup walks one light at a time.");
  drobot.result = "cluster_bits";
  drobot.options =
      clustered_options({{"tile", "32"}, {"slices", "18"}, {"container", "bits"}, {"walk", "scalar-entity"}});
  return {clustered, olsson, drobot};
}

}  // namespace lamp
