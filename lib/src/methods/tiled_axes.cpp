// Words to axes, and the combinations that make no sense.
// SPDX-License-Identifier: Apache-2.0
#include "tiled_axes.h"

#include <algorithm>

#include "parts.h"

namespace lamp {
namespace {

using Words = std::vector<std::string_view>;

// In the order of the numbers in shared/tile.h.
const Words& bounds_words() {
  static const Words words{"minmax", "half", "modified-half", "mask", "none"};
  return words;
}
const Words& test_words() {
  static const Words words{"planes", "aabb", "planes+aabb", "cone-approximate", "cone", "exact"};
  return words;
}
const Words& spot_words() {
  static const Words words{"sphere", "cone-planes", "cone-sphere", "cone-segments"};
  return words;
}
const Words& order_words() {
  static const Words words{"index", "type", "append"};
  return words;
}
const Words& reduce_words() {
  static const Words words{"atomic", "subgroup", "parallel"};
  return words;
}

std::uint32_t index_of(const Words& words, const std::string& word) {
  return static_cast<std::uint32_t>(std::ranges::find(words, word) - words.begin());
}

}  // namespace

TiledAxes tiled_axes(const Options& options) {
  return {.tile_px = options.integer("tile"),
          .capacity = options.integer("capacity"),
          .mean_capacity = options.integer("mean_capacity"),
          .bounds = index_of(bounds_words(), options.word("bounds")),
          .test = index_of(test_words(), options.word("test")),
          .spot = index_of(spot_words(), options.word("spot")),
          .order = index_of(order_words(), options.word("order")),
          .reduce = static_cast<TiledAxes::Reduce>(index_of(reduce_words(), options.word("reduce"))),
          .bits = options.word("container") == "bits",
          .prune = options.word("prune") == "pixel",
          .aos = options.word("lights") == "aos",
          .radial = parts::is_radial(options),
          .shapes = parts::has_shapes(options),
          .cached_frusta = options.word("frusta") == "cached"};
}

std::vector<OptionSpec> tiled_options(std::initializer_list<std::pair<std::string_view, std::string_view>> fallbacks) {
  std::vector<OptionSpec> specs{
      {.key = "tile", .help = "tile size, pixels", .fallback = "16", .choices = {"8", "16", "32"}},
      {.key = "bounds",
       .help = "how a tile's depths are kept: one range, two halves, two tightened halves, a 32-bit mask, not at all",
       .fallback = "minmax",
       .choices = bounds_words()},
      {.key = "reduce",
       .help = "how they are found: shared atomics, subgroup operations, a pass of its own",
       .fallback = "atomic",
       .choices = reduce_words()},
      {.key = "test", .help = "a light's sphere against the tile", .fallback = "planes", .choices = test_words()},
      {.key = "spot", .help = "what a spot passes after its sphere", .fallback = "sphere", .choices = spot_words()},
      {.key = "lights",
       .help = "culling data: its own 16-byte buffer, or the light records",
       .fallback = "soa",
       .choices = {"soa", "aos"}},
      parts::occlusion_option(),
      parts::boxes_option(),
      {.key = "prune",
       .help = "drop lights that reach none of the tile's pixels",
       .fallback = "none",
       .choices = {"none", "pixel"}},
      {.key = "order",
       .help = "of a list: ascending, points before spots, or as appended",
       .fallback = "index",
       .choices = order_words()},
      {.key = "container", .help = "what a tile keeps", .fallback = "list", .choices = {"list", "bits"}},
      parts::walk_option(),
      {.key = "frusta",
       .help = "tile planes or cones: made anew each frame, or kept until size or projection changes",
       .fallback = "per-frame",
       .choices = {"per-frame", "cached"}},
      {.key = "capacity",
       .help = "lights a tile's list has room for; from 512 on, all lights where these are few",
       .fallback = "512",
       .min = 1,
       .max = MOST_TILE_CAPACITY},
      {.key = "mean_capacity",
       .help =
           "order=type: lights a tile, on average, that the shared list has room for; from 128 on, all lights where "
           "these are few",
       .fallback = "128",
       .min = 1,
       .max = 2048}};
  parts::set_fallbacks(specs, fallbacks);
  return specs;
}

namespace {

/// What cannot be done without depth bounds.
std::optional<Error> check_no_bounds(const TiledAxes& axes) {
  if (axes.bounds != shared::BOUNDS_NONE) return std::nullopt;
  if (!axes.cone() && axes.test != shared::TEST_PLANES)
    return Error{"option test",
                 "a box and a truncated frustum end at depth bounds; bounds=none goes with test=planes, cone or "
                 "cone-approximate"};
  if (axes.spot == shared::SPOT_CONE_SPHERE)
    return Error{"option spot",
                 "a sphere around a tile needs depth bounds; bounds=none goes with sphere or cone-planes"};
  if (axes.reduce != TiledAxes::Reduce::atomic)
    return Error{"option reduce", "bounds=none reduces nothing; leave it at atomic"};
  return std::nullopt;
}

}  // namespace

std::optional<Error> check_tiled(const Problem& problem) {
  const TiledAxes axes = tiled_axes(problem.options);
  if (axes.bits && axes.order != shared::ORDER_INDEX)
    return Error{"option order", "a bit array keeps the lights' own order; container=bits goes with order=index"};
  if (axes.spot == shared::SPOT_CONE_SEGMENTS && axes.bounds != shared::BOUNDS_MASK)
    return Error{"option spot", "cone-segments tests the occupied parts of a depth mask; it goes with bounds=mask"};
  const bool has_frusta = axes.cone() || axes.test == shared::TEST_PLANES || axes.test == shared::TEST_PLANES_AABB;
  if (axes.cached_frusta && !has_frusta)
    return Error{"option frusta",
                 "only planes and cones are kept; frusta=cached goes with test=planes, planes+aabb, "
                 "cone or cone-approximate"};
  if (std::optional<Error> error = check_no_bounds(axes)) return error;
  if (auto error = parts::check_walk(problem.options, axes.bits ? parts::Container::bits : parts::Container::list))
    return error;
  if (axes.order == shared::ORDER_TYPE && problem.options.word("walk") != "plain")
    return Error{"option walk", "lists by type are walked in two loops already; order=type goes with walk=plain"};
  const std::uint64_t cells = parts::tile_count(problem, axes.tile_px) * axes.ranges();
  if (axes.order == shared::ORDER_TYPE && cells * axes.capacity > 0xffffffffULL)
    return Error{"option capacity", "cells x capacity must stay below 2^32 for order=type; take a smaller capacity"};
  return std::nullopt;
}

}  // namespace lamp
