// Cells of `lamplight` with far more lights than a work group takes at once, kept as lists and as bits.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "lamplight/shared/lamplight.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 61;
constexpr std::uint32_t HEIGHT = 35;

class CrowdedCells : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

class CellsWithoutRoom : public GpuTest {};
class ManyPieces : public GpuTest {};
class LongWalks : public GpuTest {};

// On a device with eight threads a subgroup, more than 16 384 lights are more words of bits than a thread holds at
// once.
TEST_P(CrowdedCells, KeepTheirOrderAsListsAndAsBits) {
  const std::uint32_t count = GetParam();
  const TestScene& scene = builtin_test_scene("blocks");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, count);
  const LitCase lit = make_case(renderer, view, test_lights(scene.air, view, {.count = count}));
  for (const std::uint32_t subgroup : PLAN_SUBGROUPS)
    for (const char* cells : {"list", "bits"})
      for (const char* container : {"list", "bits"}) {
        const Candidate candidate{.method = take(find_method("lamplight")),
                                  .settings = {fmt::format("cells={}", cells), fmt::format("container={}", container),
                                               "mean_cells=8", "mean_capacity=4096"},
                                  .light_capacity = count,
                                  .subgroup_size = subgroup};
        SCOPED_TRACE(fmt::format("{}, {} a subgroup", fmt::join(candidate.settings, " "), subgroup));
        EXPECT_GT(check_method(renderer, lit, candidate, Check::separate).list_max, shared::PIECE);
        const Rendered rendered = renderer.render(kept_lighting(renderer, candidate, ShadingPath::deferred));
        EXPECT_EQ(rendered.counters.overflowed_cells, 0);
      }
}

INSTANTIATE_TEST_SUITE_P(Of, CrowdedCells, ::testing::Values(4097, 20011));

// A cell that has a piece of its own alone needs no room, whatever became of those before it.
TEST_F(CellsWithoutRoom, LeaveOthersTheirPieces) {
  constexpr std::uint32_t COUNT = 3000;
  constexpr glm::uvec2 SIZE{200, 113};
  const TestScene& scene = builtin_test_scene("posts");
  const View view = view_of(find_camera(scene.scene, ""), SIZE.x, SIZE.y, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, SIZE.x, SIZE.y, COUNT);
  const LitCase lit = make_case(renderer, view, pack(place_lights(scene.scene, {.count = COUNT})));
  for (const std::uint32_t subgroup : PLAN_SUBGROUPS) {
    SCOPED_TRACE(subgroup);
    const Candidate candidate{.method = take(find_method("lamplight")),
                              .settings = {"cells=bits", "mean_cells=0", "mean_capacity=1000"},
                              .light_capacity = COUNT,
                              .subgroup_size = subgroup};
    check_method(renderer, lit, candidate, Check::separate);
    const Rendered rendered = renderer.render(kept_lighting(renderer, candidate, ShadingPath::deferred));
    EXPECT_GT(rendered.counters.overflowed_cells, 0);
  }
}

// A cell with 2048 pieces, of which no work group may take so many that a software device ends its loops: it does so
// after 65535 rounds of a thread, and then lists lack lights.
TEST_F(ManyPieces, AllComeToTheirEnd) {
  constexpr std::uint32_t COUNT = 1U << 18;
  constexpr glm::uvec2 SIZE{96, 54};
  const TestScene& scene = builtin_test_scene("one-tile");
  Renderer renderer(test_context(), shader_library(), scene.gpu, SIZE.x, SIZE.y, COUNT);
  renderer.set_frame(view_of(find_camera(scene.scene, ""), SIZE.x, SIZE.y, "camera"),
                     pack(place_lights(scene.scene, {.count = COUNT})));
  const auto listed = [&](const char* cells, std::uint32_t subgroup) {
    const Candidate candidate{.method = take(find_method("lamplight")),
                              .settings = {fmt::format("cells={}", cells)},
                              .light_capacity = COUNT,
                              .subgroup_size = subgroup};
    const vulkan::FrameCounts counts = renderer.cull(kept_lighting(renderer, candidate, ShadingPath::deferred));
    EXPECT_EQ(counts.counters.overflowed_cells, 0);
    return counts.needed.back();
  };
  const std::uint32_t expected = listed("list", 8);
  EXPECT_GT(expected, COUNT / 2);
  for (const std::uint32_t subgroup : PLAN_SUBGROUPS) EXPECT_EQ(listed("bits", subgroup), expected);
}

// Pixels with more lights than a software device walks one by one.
TEST_F(LongWalks, BringTheirLastLights) {
  constexpr std::uint32_t COUNT = 40'000;
  constexpr glm::uvec2 SIZE{64, 36};
  const TestScene& scene = builtin_test_scene("one-tile");
  const View view = view_of(find_camera(scene.scene, ""), SIZE.x, SIZE.y, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, SIZE.x, SIZE.y, COUNT);
  const LitCase lit = make_case(renderer, view, pack(place_lights(scene.scene, {.count = COUNT})));
  const auto forward = [&](const Candidate& candidate) {
    return renderer.render(kept_lighting(renderer, candidate, ShadingPath::forward)).image;
  };
  const HdrImage reference = forward({.method = &brute_force()});
  std::size_t number = 0;
  for (const char* container : {"container=list", "container=bits"}) {
    std::size_t turn = number++;
    for (const char* room : {"mean_cells=8", "mean_cells=0"}) {
      if (!has_turn(turn++, 2)) continue;
      const Candidate candidate{.method = take(find_method("lamplight")),
                                .settings = {container, room, "cells=list", "mean_capacity=40000"},
                                .light_capacity = COUNT};
      SCOPED_TRACE(fmt::format("{}", fmt::join(candidate.settings, " ")));
      EXPECT_GT(check_method(renderer, lit, candidate, Check::separate).list_max, 32768);
      EXPECT_EQ(max_abs_difference(forward(candidate), reference), 0.0F);
    }
  }
}

}  // namespace
}  // namespace lamp::app
