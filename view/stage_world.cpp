// Looks lights up by position, around what the picked pixel shows.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/check.h"
#include "lamplight/shared/world.h"
#include "render/point_walks.h"
#include "render/still_tree.h"
#include "view/stage_kept.h"
#include "view/world_leaves.h"

namespace lamp::app {
namespace {

/// Cells of one size, of which each has one list.
struct CellGrid {
  glm::vec3 origin{0.0F};
  float side = 0.0F;  ///< m; 0: no light is in any cell
};

PointList list_at(const PointLights& found, std::size_t point, const glm::vec3& position,
                  std::span<const shared::Light> lights) {
  const auto listed = found.of(point);
  const auto reaches = [&](std::uint32_t light) { return reach(lights[light], glm::dvec3(position)) == Reach::inside; };
  PointList list{.position = position,
                 .walked = listed.size(),
                 .reaching = static_cast<std::size_t>(std::ranges::count_if(listed, reaches)),
                 .ended = found.ended[point] != 0};
  std::size_t all = 0;
  for (std::uint32_t light = 0; light < lights.size(); ++light) all += reaches(light) ? 1 : 0;
  list.missed = all - list.reaching;
  return list;
}

std::string_view lists_name(const MirrorPass& mirror) {
  return mirror_list_names()[static_cast<std::size_t>(mirror.info().settings.lists)];
}

/// The finest level with lights; its cells lie in one cell of each coarser level. `across`: cells of a brick.
CellGrid grid_of_levels(std::uint32_t levels, std::uint32_t across) {
  const auto finest = static_cast<std::uint32_t>(std::countr_zero(levels));
  if (finest >= shared::WORLD_LEVELS) return {};
  return {.side = std::ldexp(1.0F / static_cast<float>(across),
                             static_cast<int>(finest) - static_cast<int>(shared::WORLD_LEAST))};
}

std::vector<WorldCell> cells_around(const CellGrid& grid, const glm::vec3& point) {
  std::vector<WorldCell> cells;
  if (grid.side == 0.0F) return cells;
  const glm::vec3 own = glm::floor((point - grid.origin) / grid.side);
  for (int z = -CELLS_AROUND; z <= CELLS_AROUND; ++z)
    for (int y = -CELLS_AROUND; y <= CELLS_AROUND; ++y)
      for (int x = -CELLS_AROUND; x <= CELLS_AROUND; ++x)
        cells.push_back({.low = grid.origin + (own + glm::vec3(x, y, z)) * grid.side, .side = grid.side});
  return cells;
}

}  // namespace

std::optional<glm::vec3> Stage::mirrored_point(glm::uvec2 pixel) {
  const MirrorPass* mirror = renderer_->mirrored();
  if (mirror == nullptr) return std::nullopt;
  const std::size_t number = pixel.x + std::size_t{renderer_->view().width()} * pixel.y;
  constexpr std::size_t HIT_WORDS = sizeof(gpu::MirrorHit) / sizeof(std::uint32_t);
  constexpr std::size_t SURFACE_WORDS = sizeof(gpu::MirrorSurface) / sizeof(std::uint32_t);
  const std::vector<std::uint32_t> hit = read_words(mirror->hits().handle(), HIT_WORDS, number * HIT_WORDS);
  if (hit.front() >= gpu::MIRROR_ENDED) return std::nullopt;
  const std::vector<std::uint32_t> surface =
      read_words(mirror->surfaces().handle(), SURFACE_WORDS, number * SURFACE_WORDS);
  return glm::vec3(std::bit_cast<float>(surface[0]), std::bit_cast<float>(surface[1]),
                   std::bit_cast<float>(surface[2]));
}

ShownWorld Stage::read_world(const Lighting& lighting, const Inspection& found) {
  const Method& method = *lighting.info().method;
  const Options& options = lighting.info().options;
  const MirrorPass* mirror = method.any_point ? nullptr : renderer_->mirrored();  // asks lists of its own
  ShownWorld read{.method = std::string(mirror == nullptr ? method.name : lists_name(*mirror))};
  const bool has_lists =
      mirror == nullptr ? method.any_point : mirror->info().settings.lists != MirrorLists::brute_force;
  if (!has_lists) {
    read.refused = fmt::format("{} has no lists in the world; world-cells and world-tree have", read.method);
    return read;
  }
  const std::span<const shared::Light> lights = listed_lights();
  Plan plan = mirror != nullptr ? mirror_plan(context_.device(), mirror->info())
                                : take(make_plan(method, {.width = renderer_->view().width(),
                                                          .height = renderer_->view().height(),
                                                          .light_capacity = static_cast<std::uint32_t>(lights.size()),
                                                          .options = options,
                                                          .traits = context_.device().traits}));
  const bool is_tree = plan.binds(INPUT_STILL);
  const bool has_cells = is_tree || std::ranges::find(plan.buffers, "levels", &BufferDesc::name) != plan.buffers.end();
  if (!has_cells)
    read.refused =
        fmt::format("{} has no cells with lists that could be drawn; world-cells and world-tree have", read.method);
  std::optional<WorldTree> tree;
  if (is_tree) tree = make_still_tree(lights, options, 0.0F);
  std::vector<glm::vec3> points{found.position};
  if (const auto mirrored = mirrored_point(found.pixel)) points.push_back(*mirrored);
  const std::uint32_t across = is_tree || !has_cells ? 0 : plan.lookup.constants[1];  // LOOKUP_CELLS
  PointWalks walks(context_, shaders_, std::move(plan), renderer_->view(), lights,
                   tree ? tree->words() : std::span<const std::uint32_t>());
  const PointLights at_points = walks.walk(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    read.points.push_back(list_at(at_points, i, points[i], lights));
    read.points.back().what = i == 0 ? "surface" : "mirrored";
  }
  if (!has_cells) return read;
  read.cells = tree ? leaves_around(tree->words(), found.position)
                    : cells_around(grid_of_levels(walks.word_of("levels"), across), found.position);
  std::vector<glm::vec3> middles;
  for (const WorldCell& cell : read.cells) middles.push_back(cell.low + 0.5F * cell.side);
  const PointLights in_cells = walks.walk(middles);
  for (std::size_t i = 0; i < read.cells.size(); ++i) {
    read.cells[i].lights = static_cast<std::uint32_t>(in_cells.of(i).size());
    read.longest = std::max(read.longest, read.cells[i].lights);
  }
  return read;
}

}  // namespace lamp::app
