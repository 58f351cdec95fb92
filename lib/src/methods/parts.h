// What methods share as parts: counting cells, light bounds, counters.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "lamplight/method.h"
#include "lamplight/shared/counters.h"

namespace lamp::parts {

[[nodiscard]] constexpr std::uint32_t divide_up(std::uint32_t value, std::uint32_t by) {
  return value / by + (value % by == 0 ? 0U : 1U);
}

/// Tiles over the largest picture, the partial ones at the right and bottom included.
[[nodiscard]] inline std::uint64_t tile_count(const Problem& problem, std::uint32_t tile_px) {
  return CellGrid{.px = tile_px}.count(problem.width, problem.height);
}

/// Threads of a work group that culls: a power of two, at most 256 and what the device takes.
[[nodiscard]] inline std::uint32_t cull_threads(const Problem& problem, std::uint32_t wanted = 256) {
  std::uint32_t threads = 32;
  while (threads * 2 <= std::min({wanted, 256U, problem.traits.max_group_invocations})) threads *= 2;
  return threads;
}

/// The light buffer's capacity, at least 1 so that no buffer is empty.
[[nodiscard]] inline std::uint32_t capacity(const Problem& problem) { return std::max(1U, problem.light_capacity); }

/// Options of a preset: other values by default.
inline void set_fallbacks(std::vector<OptionSpec>& specs,
                          std::initializer_list<std::pair<std::string_view, std::string_view>> fallbacks) {
  for (const auto& [key, value] : fallbacks) {
    const auto spec = std::ranges::find(specs, key, &OptionSpec::key);
    assert(spec != specs.end() && "presets set options that exist");
    spec->fallback = value;
  }
}

/// A buffer of `cell_bytes` for each cell of the picture, zeroed every frame as far as that frame's picture reaches.
[[nodiscard]] BufferDesc zeroed_cells(std::string name, const Problem& problem, const CellGrid& cells,
                                      std::uint64_t cell_bytes);

/// Adds the buffer of shared::LightBounds.
[[nodiscard]] ResourceId add_light_bounds(Plan& plan, const Problem& problem);
/// The pass that fills it: one thread a light, view-space sphere (shaders/methods/light_bounds.comp).
[[nodiscard]] Pass light_bounds_pass(ResourceId bounds);

/// Adds shared::Counters, zeroed every frame, and makes it the plan's.
ResourceId add_counters(Plan& plan);

/// Entries of lists, 5 MiB, that a plan has room for by default if every light in every cell comes to no more: small
/// problems cannot overflow. Who sets a capacity below its default asks for less.
constexpr std::uint64_t SMALL_LISTS = 5U << 18;

/// Capacities whose need is in the counters: of one list shared by all cells, and of each cell's own.
[[nodiscard]] Capacity shared_list(std::string_view option, std::uint64_t entries, std::uint64_t per_option);
[[nodiscard]] Capacity own_lists(std::string_view option, std::uint64_t entries);

/// What a cell keeps: a list, or a bit for each light.
enum class Container : std::uint8_t { list, bits };

/// Whether lights are cut by how far their shadow maps let them reach (shared/radial.h).
[[nodiscard]] OptionSpec occlusion_option();
[[nodiscard]] bool is_radial(const Options& options);
/// Whether boxes are tested by the shape that their record tells (shared/entity.h), after their bounding sphere.
[[nodiscard]] OptionSpec boxes_option();
[[nodiscard]] bool has_shapes(const Options& options);
/// Both, as FURTHER_* bits, for the constant of that name.
[[nodiscard]] std::uint32_t further_tests(const Options& options);
/// What a pass binds for the first: the bounds, or another resource, which is not read. And for the second: records.
[[nodiscard]] Binding radial_binding(const Problem& problem, ResourceId other);
[[nodiscard]] Binding record_binding(const Problem& problem, ResourceId other);

/// How a look-up walks: each thread by itself (plain), or all threads of a subgroup one cell at a time (lists) or one
/// light at a time (bits).
[[nodiscard]] OptionSpec walk_option(std::string_view fallback = "plain");
/// Why the walk and the container do not go together, or nothing.
[[nodiscard]] std::optional<Error> check_walk(const Options& options, Container container);
/// The look-up's name, with "_scalar" for the two last walks. A device that lacks the operation gets the plain walk,
/// and the plan a note.
[[nodiscard]] std::string walk_lookup(Plan& plan, const Problem& problem, std::string_view plain);

/// How depth is cut into slices or bins: options and their values. `scale`: "log" or "linear"; the first slice ends at
/// `near_mm`, the last begins at `far_m` and reaches to infinity.
[[nodiscard]] OptionSpec slice_scale_option(std::string_view key, std::string_view fallback);
[[nodiscard]] OptionSpec slice_near_option(std::string_view help = "far end of the first slice, millimetres");
[[nodiscard]] OptionSpec slice_far_option(
    std::string_view help = "near end of the last slice, metres; it reaches to infinity");
/// shared::SLICES_LOG or SLICES_LINEAR.
[[nodiscard]] std::uint32_t slice_scale(std::string_view word);

}  // namespace lamp::parts
