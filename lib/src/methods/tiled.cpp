// Tiled culling: a tile's depth ranges, a volume test, a list (or bits) of the lights that pass. All axes, one plan.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016); Primal engine, Light Culling with Approximate
// Sphere-Cone Intersection; Harada, A 2.5D Culling for Forward+ (2012).
// Promise: a list that does not fit is counted and walked as all lights; no axis but cone-approximate loses a light.
// SPDX-License-Identifier: Apache-2.0
#include "methods.h"
#include "parts.h"
#include "tiled_axes.h"

namespace lamp {
namespace {

/// The buffers of one plan, and what its passes and look-ups bind.
struct Buffers {
  ResourceId bounds, frusta, ranges, lists, splits, counters, headers;
};

/// Constants of tile_inputs.glsl.
std::vector<std::uint32_t> tile_constants(const Problem& problem, const TiledAxes& axes) {
  return {axes.tile_px,
          axes.capacity,
          axes.bounds,
          axes.test,
          axes.spot,
          axes.order,
          axes.prune ? 1U : 0U,
          axes.aos ? 1U : 0U,
          axes.cached_frusta ? 1U : 0U,
          axes.reduce == TiledAxes::Reduce::parallel ? 1U : 0U,
          axes.ranges() * axes.capacity,
          axes.ranges(),
          parts::further_tests(problem.options)};
}

/// Bindings of tile_inputs.glsl. Where the axes do without a buffer, another one is bound, and not read.
std::vector<Binding> tile_bindings(const TiledAxes& axes, const Buffers& b) {
  const ResourceId lights = axes.reads_lights() ? INPUT_LIGHTS : b.bounds;
  const auto or_other = [&](ResourceId id) { return Binding{id == NO_RESOURCE ? lights : id}; };
  return {{INPUT_FRAME},
          {INPUT_DEPTH},
          {lights},
          or_other(b.bounds),
          or_other(b.frusta),
          or_other(b.ranges),
          {axes.radial ? INPUT_RADIAL : lights}};
}

/// What comes before the cull: light bounds, tile frusta, depth ranges, as far as the axes have them.
std::vector<Pass> passes_before(const TiledAxes& axes, const Buffers& b) {
  std::vector<Pass> passes;
  if (!axes.aos) passes.push_back(parts::light_bounds_pass(b.bounds));
  if (axes.cached_frusta)
    passes.push_back({.name = "tile frusta",
                      .shader = "methods/tile_frusta",
                      .constants = {axes.tile_px, axes.test},
                      .bindings = {{INPUT_FRAME}, {b.frusta, Access::write}},
                      .extent = {.x = 0, .cells = {.px = axes.tile_px}, .cells_per_group = 64},
                      .on_projection_change = true});
  if (axes.reduce == TiledAxes::Reduce::parallel)
    passes.push_back({.name = "tile depth",
                      .shader = "methods/tile_depth_pass",
                      .constants = {axes.tile_px / 2, axes.tile_px, axes.bounds},
                      .bindings = {{INPUT_FRAME}, {INPUT_DEPTH}, {b.ranges, Access::write}},
                      .extent = {.cells = {.px = axes.tile_px}}});
  return passes;
}

/// Shared memory of the cull: lists and their flags, or two batches of bits; and the reductions.
std::uint32_t cull_bytes(const TiledAxes& axes) {
  return axes.bits ? 256 : axes.ranges() * axes.capacity * 4 + 128 * 4 + 64;
}

Pass cull_pass(const Problem& problem, const TiledAxes& axes, const Buffers& b) {
  const char* container = axes.bits ? "bits" : axes.order == shared::ORDER_TYPE ? "typed" : "lists";
  const char* reduce = axes.reduce == TiledAxes::Reduce::subgroup ? "subgroup" : "atomic";
  Pass pass{.name = "tiled cull",
            .shader = std::string("methods/tile_") + container + "_" + reduce,
            .constants = {parts::cull_threads(problem, axes.tile_px * axes.tile_px)},
            .bindings = tile_bindings(axes, b),
            .extent = {.cells = {.px = axes.tile_px}}};
  const std::vector<std::uint32_t> constants = tile_constants(problem, axes);
  pass.constants.insert(pass.constants.end(), constants.begin(), constants.end());
  pass.bindings.push_back({b.lists, Access::write});
  pass.bindings.push_back({b.splits, Access::write});
  if (b.counters != NO_RESOURCE) pass.bindings.push_back({b.counters, Access::read_write});
  if (b.headers != NO_RESOURCE) pass.bindings.push_back({b.headers, Access::write});
  return pass;
}

/// Whether lists in shared memory can hold every light, and those of all cells take little.
bool is_small(const Problem& problem, std::uint64_t cells) {
  const std::uint32_t lights = parts::capacity(problem);
  return lights <= MOST_TILE_CAPACITY && cells * lights <= parts::SMALL_LISTS;
}

/// Of each list: for every light, in a small problem, if the device has the shared memory.
std::uint32_t list_capacity(const Problem& problem, TiledAxes axes, std::uint64_t cells) {
  const std::uint32_t given = axes.capacity;
  if (axes.bits || given < TILE_CAPACITY || !is_small(problem, cells)) return given;
  axes.capacity = std::max(given, parts::capacity(problem));
  return cull_bytes(axes) <= problem.traits.shared_memory_bytes ? axes.capacity : given;
}

/// Of the list that all cells share.
std::uint64_t shared_entries(const Problem& problem, const TiledAxes& axes, std::uint64_t cells) {
  const std::uint64_t worst = cells * parts::capacity(problem);
  if (axes.mean_capacity >= TILE_MEAN_CAPACITY && is_small(problem, cells)) return worst;
  return std::min(cells * axes.mean_capacity, worst);
}

Buffers add_buffers(Plan& plan, const Problem& problem, const TiledAxes& axes, std::uint64_t tiles) {
  Buffers b{};
  b.bounds = axes.aos ? NO_RESOURCE : parts::add_light_bounds(plan, problem);
  b.frusta = NO_RESOURCE;
  if (axes.cached_frusta)
    b.frusta = axes.cone() ? plan.add({.name = "tile cones", .bytes = tiles * sizeof(shared::TileCone)})
                           : plan.add({.name = "tile planes", .bytes = tiles * sizeof(shared::TilePlanes)});
  b.ranges = axes.reduce == TiledAxes::Reduce::parallel
                 ? plan.add({.name = "tile depth ranges", .bytes = tiles * sizeof(shared::TileRanges)})
                 : NO_RESOURCE;
  b.counters = axes.bits ? NO_RESOURCE : parts::add_counters(plan);
  const std::uint64_t cells = tiles * axes.ranges();
  const std::uint64_t words = parts::divide_up(parts::capacity(problem), 32);
  const bool typed = axes.order == shared::ORDER_TYPE;
  if (axes.bits)
    b.lists = plan.add({.name = "tile bits", .bytes = cells * words * 4});
  else
    b.lists = plan.add({.name = "tile lists",
                        .bytes = typed ? shared_entries(problem, axes, cells) * 4 : cells * (1 + axes.capacity) * 4});
  b.splits = plan.add({.name = "tile splits", .bytes = tiles * 4});
  b.headers = typed ? plan.add({.name = "tile headers", .bytes = cells * 8}) : NO_RESOURCE;
  return b;
}

LookUp look_up(Plan& plan, const Problem& problem, const TiledAxes& axes, const Buffers& b) {
  const std::vector<Binding> bindings{{INPUT_FRAME}, {b.lists}, {b.splits}};
  if (axes.bits)
    return {.name = parts::walk_lookup(plan, problem, "tile_bits"),
            .constants = {axes.tile_px, parts::divide_up(parts::capacity(problem), 32), axes.ranges()},
            .bindings = bindings};
  if (axes.order != shared::ORDER_TYPE)
    return {.name = parts::walk_lookup(plan, problem, "tile_lists"),
            .constants = {axes.tile_px, axes.capacity, axes.ranges(), plan.ordered ? 1U : 0U},
            .bindings = bindings};
  LookUp typed{.name = "tile_typed", .constants = {axes.tile_px, axes.ranges()}, .bindings = bindings};
  typed.bindings.push_back({b.headers});
  return typed;
}

/// As asked, as far as the device can.
TiledAxes possible_axes(Plan& plan, const Problem& problem) {
  TiledAxes axes = tiled_axes(problem.options);
  if (axes.reduce == TiledAxes::Reduce::subgroup && !problem.traits.compute_subgroups.arithmetic) {
    axes.reduce = TiledAxes::Reduce::atomic;
    plan.notes.emplace_back("reduce=atomic instead of subgroup: the device has no subgroup arithmetic");
  }
  return axes;
}

}  // namespace

Plan plan_tiled(const Problem& problem) {
  Plan plan;
  TiledAxes axes = possible_axes(plan, problem);
  const std::uint64_t tiles = parts::tile_count(problem, axes.tile_px);
  plan.cells = tiles * axes.ranges();
  axes.capacity = list_capacity(problem, axes, plan.cells);
  const std::uint64_t shared_list = shared_entries(problem, axes, plan.cells);
  plan.ordered = axes.order == shared::ORDER_INDEX;
  plan.approximate = axes.test == shared::TEST_CONE_APPROXIMATE;
  const Buffers buffers = add_buffers(plan, problem, axes, tiles);
  if (!axes.bits) plan.capacities = {parts::own_lists("capacity", axes.capacity)};
  if (axes.order == shared::ORDER_TYPE)
    plan.capacities.push_back(parts::shared_list("mean_capacity", shared_list, plan.cells));
  plan.passes = passes_before(axes, buffers);
  plan.passes.push_back(cull_pass(problem, axes, buffers));
  // Container bits: the last constant is the words of a cell; a shared list: its length.
  if (axes.bits)
    plan.passes.back().constants.push_back(parts::divide_up(parts::capacity(problem), 32));
  else if (axes.order == shared::ORDER_TYPE)
    plan.passes.back().constants.push_back(static_cast<std::uint32_t>(shared_list));
  plan.lookup = look_up(plan, problem, axes, buffers);
  if (axes.bits || axes.tile_px * axes.tile_px > problem.traits.max_group_invocations) return plan;
  std::vector<Binding> fused_bindings = tile_bindings(axes, buffers);
  fused_bindings.push_back({buffers.counters, Access::read_write});
  plan.fused =
      FusedLookUp{.lookup = {.name = axes.reduce == TiledAxes::Reduce::subgroup ? "tile_fused_subgroup" : "tile_fused",
                             .constants = tile_constants(problem, axes),
                             .bindings = std::move(fused_bindings)},
                  .passes = passes_before(axes, buffers),
                  .group_width = axes.tile_px,
                  .group_height = axes.tile_px,
                  .shared_bytes = cull_bytes(axes)};
  return plan;
}

}  // namespace lamp
