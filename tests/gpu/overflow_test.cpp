// Lists that do not fit: counted, and the picture stays brute force's, because their cells walk something coarser:
// every light, or in clustered culling those between their tile's sides.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 97;
constexpr std::uint32_t HEIGHT = 61;
constexpr std::uint32_t COUNT = 300;

/// Rows whose lists have a fixed length ("capacity", "mean_capacity") that matters to them, set to 1.
struct ShortLists {
  const Method* method;
  std::string setting;
};

std::vector<ShortLists> all_short_lists() {
  std::vector<ShortLists> found;
  for (const Method& method : methods()) {
    const std::string_view shared_list =
        method.result == "tile_typed" || method.result == "cluster_lists" ? "mean_" : "";
    for (const OptionSpec& spec : method.options)
      if (spec.key == std::string(shared_list) + "capacity" && method.result != "tile_bits")
        found.push_back({&method, fmt::format("{}=1", spec.key)});
  }
  return found;
}

class LitCorridor : public GpuTest {
 protected:
  LitCorridor()
      : scene_(builtin_test_scene("corridor")),
        view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT),
        lit_(make_case(renderer_, view_, test_lights(scene_.air, view_, {.count = COUNT}))) {}

  shared::Counters counters(const Candidate& candidate) {
    renderer_.set_frame(view_, lit_.lights);
    return renderer_.render(kept_lighting(renderer_, candidate, ShadingPath::deferred)).counters;
  }

  /// Cells that some pixel sees and that hold every light.
  std::size_t full_cells(const Candidate& candidate) {
    Lighting& lighting = kept_lighting(renderer_, candidate, ShadingPath::deferred);
    std::set<std::uint32_t> cells;
    for (const Visit& visit : renderer_.visit(lighting, lit_.truth))
      if (visit.cell != ~0U && visit.visited == COUNT) cells.insert(visit.cell);
    return cells.size();
  }

  const TestScene& scene_;
  View view_;
  Renderer renderer_;
  LitCase lit_;
};

class Overflow : public LitCorridor, public ::testing::WithParamInterface<ShortLists> {};

TEST_P(Overflow, IsCountedAndTheListsStayComplete) {
  const Candidate long_lists{.method = GetParam().method, .light_capacity = COUNT};
  const Candidate short_lists{.method = GetParam().method, .settings = {GetParam().setting}, .light_capacity = COUNT};
  const Findings before = check_method(renderer_, lit_, long_lists, Check::separate);
  const shared::Counters enough = counters(long_lists);
  EXPECT_EQ(enough.overflowed_cells, 0);
  EXPECT_EQ(full_cells(long_lists), 0);

  const Findings after = check_method(renderer_, lit_, short_lists);
  const shared::Counters counted = counters(short_lists);
  EXPECT_GT(counted.overflowed_cells, 0);
  EXPECT_GT(after.evaluations, before.evaluations);
  if (GetParam().method->result == "cluster_lists") {
    const Candidate brute{.method = &brute_force(), .light_capacity = COUNT};
    EXPECT_GT(after.list_max, before.list_max);
    EXPECT_LT(after.evaluations, check_method(renderer_, lit_, brute, Check::separate).evaluations);
  } else {
    const std::size_t full = full_cells(short_lists);
    EXPECT_GT(full, 0);
    EXPECT_LE(full, counted.overflowed_cells);
    EXPECT_EQ(after.list_max, COUNT);
  }
  EXPECT_EQ(counted.entries_needed, enough.entries_needed);  // so a host knows how much to grow
}

/// Rows that scatter lights into cells: the cells' entries and the tiles' lists are two buffers, either may be short.
/// For each size of subgroups that plans know.
class ScatterOverflow : public LitCorridor, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(ScatterOverflow, OfEitherBufferIsCountedAndTheListsStayComplete) {
  std::vector<shared::Light> wide = lit_.lights;
  for (shared::Light& light : wide) light.range *= 30.0F;
  const LitCase lit = make_case(renderer_, view_, wide);
  const Method& method = *take(find_method("lamplight"));
  const auto overflowed = [&](const std::vector<std::string>& settings) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(settings, " ")));
    const Candidate candidate{
        .method = &method, .settings = settings, .light_capacity = COUNT, .subgroup_size = GetParam()};
    check_method(renderer_, lit, candidate, Check::separate);
    renderer_.set_frame(view_, lit.lights);
    return renderer_.render(kept_lighting(renderer_, candidate, ShadingPath::deferred)).counters.overflowed_cells;
  };
  for (const char* cells : {"cells=list", "cells=bits"}) {
    EXPECT_EQ(overflowed({cells, "mean_cells=8", "mean_capacity=300"}), 0);
    EXPECT_GT(overflowed({cells, "mean_cells=8", "mean_capacity=1"}), 0);
    EXPECT_GT(overflowed({cells, "mean_cells=0", "mean_capacity=300"}), 0);
    EXPECT_GT(overflowed({cells, "mean_cells=0", "mean_capacity=1"}), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Subgroups, ScatterOverflow, ::testing::ValuesIn(PLAN_SUBGROUPS),
                         [](const auto& test) { return fmt::format("of{}", test.param); });

/// A row with every option that sizes a list set to its least, and lights so wide that all of them are too small.
class Growing : public LitCorridor, public ::testing::WithParamInterface<const Method*> {};

TEST_P(Growing, TwoFramesMakeRoomForEverything) {
  const Method& method = *GetParam();
  std::vector<shared::Light> wide = lit_.lights;
  for (shared::Light& light : wide) light.range *= 30.0F;
  const LitCase lit = make_case(renderer_, view_, wide);
  renderer_.set_frame(view_, lit.lights);
  std::vector<std::string> settings;
  Problem problem{.width = WIDTH, .height = HEIGHT, .light_capacity = COUNT, .traits = renderer_.device().traits};
  problem.options = take(resolve_options(method, {}));
  for (const Capacity& capacity : take(make_plan(method, problem)).capacities) {
    settings.push_back(fmt::format("{}=1", capacity.option));
    problem.options = take(resolve_options(method, settings));
  }

  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(settings, " ")));
    const Candidate candidate{.method = &method, .settings = settings, .light_capacity = COUNT};
    check_method(renderer_, lit, candidate, Check::separate);
    const Rendered rendered = renderer_.render(kept_lighting(renderer_, candidate, ShadingPath::deferred));
    if (frame == 0) {
      EXPECT_GT(rendered.counters.overflowed_cells, 0);
    }
    const Plan plan = take(make_plan(method, problem));
    const std::optional<GrownPlan> grown = grow_plan(method, problem, plan, rendered.needed);
    EXPECT_EQ(grown.has_value(), rendered.counters.overflowed_cells != 0);
    if (!grown) return;
    for (std::size_t i = 0; i < plan.capacities.size(); ++i)
      if (grown->plan.capacities[i].entries != plan.capacities[i].entries) {
        EXPECT_GE(grown->plan.capacities[i].entries,
                  std::uint64_t{rendered.needed[i]} * plan.capacities[i].entries_per_count);
      }
    problem.options = grown->options;
    settings.clear();
    for (const auto& [key, value] : grown->options.all()) settings.push_back(fmt::format("{}={}", key, value));
  }
  FAIL() << "three frames, and lists still do not fit";
}

std::vector<const Method*> growing_methods() {
  std::vector<const Method*> found;
  for (const Method& method : methods()) {
    const Problem problem{
        .width = WIDTH, .height = HEIGHT, .light_capacity = COUNT, .options = take(resolve_options(method, {}))};
    if (!take(make_plan(method, problem)).capacities.empty()) found.push_back(&method);
  }
  return found;
}

INSTANTIATE_TEST_SUITE_P(Of, Growing, ::testing::ValuesIn(growing_methods()),
                         [](const auto& test) { return test_name(test.param->name); });

INSTANTIATE_TEST_SUITE_P(Of, Overflow, ::testing::ValuesIn(all_short_lists()),
                         [](const auto& test) { return test_name(test.param.method->name); });

// Where a few MiB hold every light in every cell.
TEST(SmallProblems, DoNotOverflow) {
  constexpr std::uint32_t SMALL_WIDTH = 320;
  constexpr std::uint32_t SMALL_HEIGHT = 180;
  constexpr std::uint32_t LIGHTS = 600;
  const TestScene& scene = builtin_test_scene("corridor");
  Renderer renderer(test_context(), shader_library(), scene.gpu, SMALL_WIDTH, SMALL_HEIGHT, LIGHTS);
  std::vector<Light> everywhere(LIGHTS);
  for (std::uint32_t i = 0; i < LIGHTS; ++i) everywhere[i].position = {static_cast<float>(i) / LIGHTS, 1.0F, 0.0F};
  renderer.set_frame(view_of(find_camera(scene.scene, ""), SMALL_WIDTH, SMALL_HEIGHT, "camera"), pack(everywhere));
  const std::pair<std::string_view, std::vector<std::string>> cases[] = {
      {"lamplight", {}}, {"lamplight", {"cells=list"}}, {"clustered", {}},
      {"tiled", {}},     {"stewart-half-z", {}},        {"primal", {}}};
  for (const auto& [name, settings] : cases) {
    SCOPED_TRACE(fmt::format("{} {}", name, fmt::join(settings, " ")));
    const Candidate candidate{.method = take(find_method(name)), .settings = settings, .light_capacity = LIGHTS};
    Lighting& lighting = kept_lighting(renderer, candidate, ShadingPath::deferred);
    EXPECT_EQ(renderer.cull(lighting).counters.overflowed_cells, 0);
    const std::vector<Visit> visits = renderer.visit_all(lighting);
    EXPECT_EQ(std::ranges::max(visits, {}, &Visit::visited).visited, LIGHTS);
  }
  for (const std::string& message : test_context().take_messages()) ADD_FAILURE() << message;
}

// With room for a million lights, a tile's bits in all tiles would be larger than a plan allows.
TEST_F(LitCorridor, ClustersThatOverflowWithoutBitsWalkEveryLight) {
  constexpr std::uint32_t LARGE_WIDTH = 480;
  constexpr std::uint32_t LARGE_HEIGHT = 300;
  constexpr std::uint32_t CAPACITY = 1U << 20;
  const View view = view_of(find_camera(scene_.scene, ""), LARGE_WIDTH, LARGE_HEIGHT, "camera");
  Renderer renderer(test_context(), shader_library(), scene_.gpu, LARGE_WIDTH, LARGE_HEIGHT, COUNT);
  const LitCase lit = make_case(renderer, view, test_lights(scene_.air, view, {.count = COUNT}));
  const Candidate short_lists{
      .method = take(find_method("clustered")), .settings = {"tile=16", "mean_capacity=1"}, .light_capacity = CAPACITY};
  Lighting& lighting = kept_lighting(renderer, short_lists, ShadingPath::deferred);
  const std::vector<BufferDesc>& buffers = lighting.runner().plan().buffers;
  ASSERT_EQ(std::ranges::find(buffers, "tile bits", &BufferDesc::name), buffers.end());
  EXPECT_EQ(check_method(renderer, lit, short_lists).list_max, COUNT);
}

}  // namespace
}  // namespace lamp::app
