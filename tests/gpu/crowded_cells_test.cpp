// Cells of `lamplight` with far more lights than a work group takes at once, kept as lists and as bits.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "lamplight/shared/lamplight.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 61;
constexpr std::uint32_t HEIGHT = 35;

class CrowdedCells : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

// On a device with eight threads a subgroup, more than 16 384 lights are more words of bits than a thread holds at
// once.
TEST_P(CrowdedCells, KeepTheirOrderAsListsAndAsBits) {
  const std::uint32_t count = GetParam();
  const TestScene& scene = builtin_test_scene("blocks");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, count);
  const LitCase lit = make_case(renderer, view, test_lights(scene.air, view, {.count = count}));
  for (const char* cells : {"list", "bits"})
    for (const char* container : {"list", "bits"}) {
      const Candidate candidate{.method = take(find_method("lamplight")),
                                .settings = {fmt::format("cells={}", cells), fmt::format("container={}", container),
                                             "mean_cells=8", "mean_capacity=4096"},
                                .light_capacity = count};
      SCOPED_TRACE(fmt::format("{}", fmt::join(candidate.settings, " ")));
      EXPECT_GT(check_method(renderer, lit, candidate, Check::separate).list_max, shared::PIECE);
      const Rendered rendered = renderer.render(kept_lighting(renderer, candidate, ShadingPath::deferred));
      EXPECT_EQ(rendered.counters.overflowed_cells, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, CrowdedCells, ::testing::Values(4097, 20011));

}  // namespace
}  // namespace lamp::app
