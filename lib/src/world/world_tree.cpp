// Builds a tree, light by light on all cores, and changes it.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/world_tree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>

#include "../light_faults.h"
#include "lamplight/light.h"
#include "lamplight/method.h"
#include "tree_grid.h"
#include "tree_words.h"

namespace lamp {
namespace {

using world::BrickTree;
using world::Entry;
using world::LightCells;
using world::LitBrick;
using world::Pruned;
using world::TreeGrid;
using world::TreeWords;

constexpr std::size_t LIGHTS_AT_ONCE = 64;      // that a thread takes
constexpr std::uint64_t ROOM_WORDS = 1U << 14;  // for changes, at least
constexpr float MOST_EYES_M = 1e15F;
constexpr std::size_t SURFACE_POINTS = 1U << 18;  // that stand for all surfaces

std::string in_range(std::uint64_t least, std::uint64_t most, std::uint64_t got) {
  return "expected " + std::to_string(least) + " to " + std::to_string(most) + ", got " + std::to_string(got);
}

std::optional<Error> check(std::uint32_t id, const shared::Light& light) {
  std::string fault = fault_of_packed(light);
  if (fault.empty()) return std::nullopt;
  return Error{"light " + std::to_string(id), std::move(fault)};
}

std::optional<Error> check(const WorldTreeInfo& info) {
  if (info.lights.size() > MAX_LIGHTS) return Error{"lights", in_range(0, MAX_LIGHTS, info.lights.size())};
  if (info.detail < 1 || info.detail > 64) return Error{"detail", in_range(1, 64, info.detail)};
  if (info.texels < 1 || info.texels > 1024) return Error{"texels", in_range(1, 1024, info.texels)};
  if (!(info.eyes_m >= 0.0F) || !(info.eyes_m <= MOST_EYES_M))
    return Error{"eyes_m", "expected a distance from 0 to 1e15 m, got " + std::to_string(info.eyes_m)};
  for (std::size_t i = 0; i < info.lights.size(); ++i)
    if (auto error = check(static_cast<std::uint32_t>(i), info.lights[i])) return error;
  return std::nullopt;
}

/// All that lights light, in the order that a tree is made in.
std::vector<LitBrick> lit_bricks(const WorldTreeInfo& info, const TreeGrid& grid, const world::BrickLevels& levels) {
  const std::uint32_t wanted = info.threads != 0 ? info.threads : std::max(1U, std::thread::hardware_concurrency());
  const std::size_t busy = (info.lights.size() + LIGHTS_AT_ONCE - 1) / LIGHTS_AT_ONCE;
  const auto threads = static_cast<std::uint32_t>(std::clamp<std::size_t>(busy, 1, wanted));
  std::vector<std::vector<LitBrick>> found(threads);
  const auto place_of = [](const LitBrick& b) { return std::tuple(b.place, b.level, b.light); };
  std::atomic<std::size_t> next{0};
  const auto work = [&](std::uint32_t thread) {
    LightCells cells(info.texels);
    for (std::size_t first = 0; (first = next.fetch_add(LIGHTS_AT_ONCE)) < info.lights.size();)
      for (std::size_t i = first; i < std::min(first + LIGHTS_AT_ONCE, info.lights.size()); ++i) {
        cells.look(info.lights[i], grid, info.occluders.get());
        cells.add_bricks(levels.of(info.lights[i]), static_cast<std::uint32_t>(i), found[thread]);
      }
    std::ranges::sort(found[thread], {}, place_of);
  };
  std::vector<std::future<void>> others;  // no std::jthread: clang's C++ library has none before LLVM 20
  for (std::uint32_t thread = 1; thread < threads; ++thread)
    others.push_back(std::async(std::launch::async, work, thread));
  work(0);
  for (std::future<void>& other : others) other.get();
  std::vector<LitBrick> all = std::move(found[0]);
  for (std::uint32_t thread = 1; thread < threads; ++thread) {
    std::vector<LitBrick> both;
    both.reserve(all.size() + found[thread].size());
    std::ranges::merge(all, found[thread], std::back_inserter(both), {}, place_of, place_of);
    all = std::move(both);
    found[thread] = {};
  }
  return all;
}

/// Where points lie that are spread evenly over the surfaces in the root, ascending.
std::vector<std::uint64_t> surface_places(const StillOccluders& occluders, const TreeGrid& grid) {
  std::vector<std::uint64_t> places;
  const glm::dvec3 low = grid.corner(0, glm::uvec3(0));
  const double bricks = std::ldexp(1.0, static_cast<int>(grid.levels));
  for (const DVec3& point : occluders.points_on(DVec3(low), DVec3(low + grid.side_m()), SURFACE_POINTS)) {
    const glm::dvec3 at = glm::floor((glm::dvec3(point) - low) / grid.brick_m(grid.levels));
    if (at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < bricks && at.y < bricks && at.z < bricks)
      places.push_back(world::morton(glm::uvec3(at)));
  }
  std::ranges::sort(places);
  return places;
}

}  // namespace

struct WorldTree::State {
  WorldTreeInfo info;  ///< its lights are `lights`
  std::vector<shared::Light> lights;
  TreeGrid grid;
  std::optional<world::BrickLevels> levels;  ///< as built
  TreeWords words;
  std::uint64_t capacity = 0;
  WorldTreeCounts counts;

  void build();
  void change_leaves(std::uint32_t id, const shared::Light& now, std::vector<ChangedWords>& changed);
};

void WorldTree::State::build() {
  info.lights = lights;
  grid = world::grid_of(info);
  levels.emplace(info, grid);
  counts = {.cell_m = grid.cell_m, .detail = levels->detail()};
  std::vector<std::uint32_t> outside;
  LightCells reach(1);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    reach.look(lights[i], grid, nullptr);
    if (reach.leaves_root()) outside.push_back(static_cast<std::uint32_t>(i));
  }
  const std::vector<std::uint64_t> surfaces =
      info.occluders ? surface_places(*info.occluders, grid) : std::vector<std::uint64_t>{};
  const BrickTree tree = world::make_tree(lit_bricks(info, grid, *levels), grid.levels, surfaces);
  const std::uint64_t fixed = shared::TREE_HEADER + 1 + world::leaf_words(outside.size(), true);
  const std::uint64_t most = std::min<std::uint64_t>(info.budget / 4, shared::TREE_PLACE);
  const Pruned whole = world::prune(tree, ~0ULL);
  const Pruned pruned = most > fixed ? world::prune(tree, most - fixed) : Pruned{};
  counts.every_light = most <= fixed || pruned.words > most - fixed;
  counts.outside = outside.size();
  counts.peak_entries = tree.peak_entries;
  if (counts.every_light) {
    words = TreeWords::of_every_light(grid);
  } else {
    words = TreeWords(grid, tree, pruned, outside);
    counts.coarser = whole.walked > 0.0 ? pruned.walked / whole.walked : 1.0;
  }
  words.set_lights(static_cast<std::uint32_t>(lights.size()));
  words.leaves([](std::uint32_t, const glm::uvec3&) { return true; },
               [&](std::uint64_t node, std::uint32_t level, const glm::uvec3&) {
                 const std::uint64_t lights_of_leaf = counts.every_light ? 0 : words.count(node);
                 counts.leaves += lights_of_leaf != 0 ? 1 : 0;
                 counts.entries += lights_of_leaf;
                 if (lights_of_leaf != 0) counts.levels = std::max(counts.levels, level);
               });
  capacity = words.words().size() + words.words().size() / 8 + ROOM_WORDS;
  words.reserve(capacity + ROOM_WORDS);
}

/// Of leaves that the light was in or is in.
void WorldTree::State::change_leaves(std::uint32_t id, const shared::Light& now, std::vector<ChangedWords>& changed) {
  LightCells before(1);
  LightCells after(info.texels);
  before.look(lights[id], grid, nullptr);
  after.look(now, grid, info.occluders.get());
  struct Leaf {
    std::uint64_t node;
    std::uint32_t level;
    glm::uvec3 brick;
  };
  std::vector<Leaf> leaves;
  // Below the cells of its bricks the light is wherever the cell around is.
  const std::uint32_t cells_at = levels->of(lights[id]) + 2;
  words.leaves(
      [&](std::uint32_t level, const glm::uvec3& brick) {
        const std::uint32_t below = level > cells_at ? level - cells_at : 0;
        return before.reaches_brick(level - below, brick >> below) || after.reaches_brick(level, brick);
      },
      [&](std::uint64_t node, std::uint32_t level, const glm::uvec3& brick) {
        leaves.push_back({node, level, brick});
      });
  const auto put = [&](std::uint64_t node, std::uint64_t cells) {
    std::vector<Entry> entries = words.entries(node);
    const auto at = std::ranges::lower_bound(entries, id, {}, &Entry::light);
    const bool has = at != entries.end() && at->light == id;
    if ((has ? at->cells : 0) == cells) return;
    if (cells == 0)
      entries.erase(at);
    else if (has)
      at->cells = cells;
    else
      entries.insert(at, {.light = id, .cells = cells});
    words.replace(node, entries, changed);
  };
  for (const Leaf& leaf : leaves) put(leaf.node, after.cells(leaf.level, leaf.brick));
  put(shared::TREE_OUTSIDE, after.leaves_root() ? world::ALL_CELLS : 0);
}

WorldTree::WorldTree(std::unique_ptr<State> state) : state_(std::move(state)) {}
WorldTree::WorldTree(WorldTree&&) noexcept = default;
WorldTree& WorldTree::operator=(WorldTree&&) noexcept = default;
WorldTree::~WorldTree() = default;

Result<WorldTree> WorldTree::build(const WorldTreeInfo& info) {
  if (auto error = check(info)) return *error;
  auto state = std::make_unique<State>();
  state->info = info;
  state->lights.assign(info.lights.begin(), info.lights.end());
  state->build();
  return WorldTree(std::move(state));
}

Result<std::vector<ChangedWords>> WorldTree::change(std::uint32_t id, const shared::Light& light) {
  State& state = *state_;
  if (id > state.lights.size() || id >= MAX_LIGHTS)
    return Error{"light " + std::to_string(id), "expected an id up to " + std::to_string(state.lights.size())};
  if (auto error = check(id, light)) return *error;
  std::vector<ChangedWords> changed;
  if (id == state.lights.size()) {
    state.lights.push_back({});  // it reaches nothing
    state.words.set_lights(id + 1);
    changed.push_back({.first = shared::TREE_LIGHTS, .count = 1});
  }
  if (!state.counts.every_light) state.change_leaves(id, light, changed);
  state.lights[id] = light;
  if (state.words.words().size() <= state.capacity) return changed;
  state.build();
  return std::vector<ChangedWords>{{.first = 0, .count = state.words.words().size()}};
}

std::span<const std::uint32_t> WorldTree::words() const { return state_->words.words(); }
std::uint64_t WorldTree::capacity() const { return state_->capacity; }
const WorldTreeCounts& WorldTree::counts() const { return state_->counts; }
std::span<const shared::Light> WorldTree::lights() const { return state_->lights; }

std::vector<std::uint32_t> WorldTree::lights_at(const Vec3& position) const {
  return state_->words.lights_at(position, static_cast<std::uint32_t>(state_->lights.size()));
}

}  // namespace lamp
