// Properties of tiled culling's sphere and spot tests, each specialised in turn: what a light reaches is never
// rejected; and every test does reject a good share of lights that are elsewhere. The approximate cone is left out: it
// may miss.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "gpu/dispatch.h"
#include "gpu/random_volumes.h"
#include "lamplight/shared/tile.h"
#include "oracle/reference.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t BATCH = 1U << 16;
constexpr std::uint32_t BATCHES = 24;  // a million and a half lights for each pair of tests
constexpr std::uint32_t SPHERE_TOUCHES = 1;
constexpr std::uint32_t SPOT_TOUCHES = 2;

std::vector<std::uint32_t> ask(const RandomBatch& batch, std::uint32_t test, std::uint32_t spot) {
  std::vector<shared::VolumeCase> cases;
  for (const RandomTile& tile : batch.tiles) cases.push_back(tile.volume);
  const vulkan::Buffer buffers[] = {host_buffer_of("frames", batch.frames), host_buffer_of("cases", cases),
                                    host_buffer_of("lights", batch.lights),
                                    host_buffer("answers", cases.size() * sizeof(std::uint32_t))};
  Dispatch what{.shader = "tile_tests", .constants = {test, spot}, .groups = {(BATCH + 63) / 64, 1, 1}};
  for (const vulkan::Buffer& buffer : buffers) what.resources.push_back(vulkan::Resource::storage(buffer.handle()));
  dispatch(what);
  return contents<std::uint32_t>(buffers[3]);
}

struct Pair {
  std::uint32_t test;
  std::uint32_t spot;
};

class TileTests : public GpuTest, public ::testing::WithParamInterface<Pair> {};

TEST_P(TileTests, WhatALightReachesIsNeverRejected) {
  std::uint64_t checked = 0;
  for (std::uint32_t seed = 1; seed <= BATCHES; ++seed) {
    const RandomBatch batch = draw_batch(seed, BATCH, Lights::reaching);
    const std::vector<std::uint32_t> answers = ask(batch, GetParam().test, GetParam().spot);
    for (std::size_t i = 0; i < BATCH; ++i) {
      if (reach(batch.lights[i], batch.tiles[i].position_world) != Reach::inside) continue;
      ++checked;
      ASSERT_EQ(answers[i], SPHERE_TOUCHES | SPOT_TOUCHES)
          << "seed " << seed << " case " << i << ": range " << batch.lights[i].range << ", outer angle "
          << batch.lights[i].outer_angle << ", type " << batch.lights[i].type;
    }
  }
  EXPECT_GT(checked, std::uint64_t{BATCHES} * BATCH / 10 * 8);
}

TEST_P(TileTests, LightsElsewhereAreOftenRejected) {
  const RandomBatch batch = draw_batch(77, BATCH, Lights::around);
  const std::vector<std::uint32_t> answers = ask(batch, GetParam().test, GetParam().spot);
  const auto rejected = std::ranges::count_if(answers, [](std::uint32_t a) { return (a & SPHERE_TOUCHES) == 0; });
  EXPECT_GT(rejected, BATCH / 2);
  if (GetParam().spot == shared::SPOT_SPHERE) return;
  std::uint32_t spots = 0;
  std::uint32_t spots_rejected = 0;
  for (std::size_t i = 0; i < BATCH; ++i) {
    if (batch.lights[i].type != shared::LIGHT_SPOT) continue;
    ++spots;
    if ((answers[i] & SPOT_TOUCHES) == 0) ++spots_rejected;
  }
  EXPECT_GT(spots_rejected, spots / 4);
}

INSTANTIATE_TEST_SUITE_P(Each, TileTests,
                         ::testing::Values(Pair{shared::TEST_PLANES, shared::SPOT_CONE_PLANES},
                                           Pair{shared::TEST_AABB, shared::SPOT_CONE_SPHERE},
                                           Pair{shared::TEST_PLANES_AABB, shared::SPOT_CONE_SEGMENTS},
                                           Pair{shared::TEST_CONE, shared::SPOT_CONE_SPHERE},
                                           Pair{shared::TEST_EXACT, shared::SPOT_CONE_SEGMENTS}));

}  // namespace
}  // namespace lamp::app
