// Properties of the tests of a sphere against a tile's mask of occupied depths: what a light reaches is never rejected,
// and the first look never says other than the exact test.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include "gpu/dispatch.h"
#include "gpu/random_volumes.h"
#include "gpu/shaders/mask_case.h"
#include "oracle/reference.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t BATCH = 1U << 16;
constexpr std::uint32_t BATCHES = 24;
constexpr std::uint32_t APART = 0;
constexpr std::uint32_t TOUCHES = 1;

/// Other pixels occupy a quarter of the parts, or in every fourth tile none.
std::vector<shared::MaskAnswer> ask(const RandomBatch& batch, std::uint32_t seed) {
  std::mt19937 bits(seed);
  std::vector<shared::MaskCase> cases;
  for (const RandomTile& tile : batch.tiles) {
    const auto others = static_cast<std::uint32_t>(bits() & bits());
    cases.push_back({.volume = tile.volume, .depth = tile.depth, .others = cases.size() % 4 == 0 ? 0 : others});
  }
  const vulkan::Buffer buffers[] = {host_buffer_of("frames", batch.frames), host_buffer_of("cases", cases),
                                    host_buffer_of("lights", batch.lights),
                                    host_buffer("answers", cases.size() * sizeof(shared::MaskAnswer))};
  Dispatch what{.shader = "mask_tests", .groups = {(BATCH + 63) / 64, 1, 1}};
  for (const vulkan::Buffer& buffer : buffers) what.resources.push_back(vulkan::Resource::storage(buffer.handle()));
  dispatch(what);
  return contents<shared::MaskAnswer>(buffers[3]);
}

bool agree(const shared::MaskAnswer& answer) {
  return (answer.look != APART || answer.touches == 0) && (answer.look != TOUCHES || answer.touches == 1);
}

class MaskTests : public GpuTest {};

TEST_F(MaskTests, WhatALightReachesIsNeverRejected) {
  std::uint64_t checked = 0;
  for (std::uint32_t seed = 1; seed <= BATCHES; ++seed) {
    const RandomBatch batch = draw_batch(seed, BATCH, Lights::reaching);
    const std::vector<shared::MaskAnswer> answers = ask(batch, seed);
    for (std::size_t i = 0; i < BATCH; ++i) {
      ASSERT_TRUE(agree(answers[i])) << "seed " << seed << " case " << i << ": look " << answers[i].look;
      ASSERT_LE(answers[i].apart, 1U) << "seed " << seed << " case " << i << ": a depth's last digit moves its part";
      if (reach(batch.lights[i], batch.tiles[i].position_world) != Reach::inside) continue;
      ++checked;
      ASSERT_TRUE(answers[i].look != APART && answers[i].touches == 1)
          << "seed " << seed << " case " << i << ": look " << answers[i].look << ", exactly " << answers[i].touches
          << ", range " << batch.lights[i].range << ", type " << batch.lights[i].type;
    }
  }
  EXPECT_GT(checked, std::uint64_t{BATCHES} * BATCH / 10 * 8);
}

TEST_F(MaskTests, TheFirstLookDecidesMostLightsAsTheExactTestDoes) {
  std::uint64_t decided = 0;
  std::uint64_t touching = 0;
  for (std::uint32_t seed = 1; seed <= BATCHES; ++seed) {
    const RandomBatch batch = draw_batch(seed, BATCH, Lights::around);
    const std::vector<shared::MaskAnswer> answers = ask(batch, seed);
    for (std::size_t i = 0; i < BATCH; ++i) {
      ASSERT_TRUE(agree(answers[i])) << "seed " << seed << " case " << i << ": look " << answers[i].look << ", exactly "
                                     << answers[i].touches;
      decided += answers[i].look <= TOUCHES ? 1 : 0;
      touching += answers[i].look == TOUCHES ? 1 : 0;
    }
  }
  EXPECT_GT(decided, std::uint64_t{BATCHES} * BATCH / 10 * 8);
  EXPECT_GT(touching, std::uint64_t{BATCHES} * BATCH / 50);
}

}  // namespace
}  // namespace lamp::app
