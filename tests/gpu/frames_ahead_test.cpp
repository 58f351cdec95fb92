// Frames that overlap: several are recorded, each with its own camera, lights and depth, before any of them is
// submitted; and each gives what it gives alone.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/flying.h"

namespace lamp::app {
namespace {

class FramesAhead : public GpuTest {
 protected:
  /// Records them all, submits them all, then checks each against what it gave alone.
  void expect_as_alone(vulkan::Culler& culler, std::span<const std::size_t> order, std::span<const Masks> alone) {
    std::vector<std::unique_ptr<Flying>> flying;
    for (const std::size_t i : order) flying.push_back(std::make_unique<Flying>(culler, frames_[i]));
    for (const auto& one : flying) one->commands.submit();
    for (const auto& one : flying) one->commands.wait();
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(flying[i]->pass.masks(), alone[order[i]]) << "frame " << order[i];
      EXPECT_EQ(take(culler.finish(flying[i]->number)), vulkan::Growth::none);
    }
  }

  std::vector<Masks> alone(const CullerCandidate& candidate) {
    std::vector<Masks> masks;
    for (const EngineFrame& frame : frames_) masks.push_back(masks_alone(candidate, frame));
    return masks;
  }

  const EngineFrame frames_[4] = {engine_frame(), engine_frame({.projection = "orthographic", .lights = 33, .seed = 2}),
                                  engine_frame({.projection = "off-centre", .seed = 3}),
                                  engine_frame({.projection = "perspective", .lights = 50, .seed = 4})};
};

TEST_F(FramesAhead, OfEveryMethodGiveWhatTheyGiveAlone) {
  constexpr std::size_t ORDER[] = {0, 1, 2, 3};
  constexpr std::size_t OTHER[] = {2, 2, 0, 1};
  for (const CullerCandidate& candidate : culler_candidates()) {
    SCOPED_TRACE(fmt::format("{} {}", candidate.method, fmt::join(candidate.options, " ")));
    const std::vector<Masks> masks = alone(candidate);
    vulkan::Culler culler = culler_of(candidate, 4);
    expect_as_alone(culler, ORDER, masks);
    expect_as_alone(culler, OTHER, masks);
  }
}

TEST_F(FramesAhead, AsManyAsTheCullerWasMadeFor) {
  for (const CullerCandidate& candidate :
       {CullerCandidate{"drobot-zbin", {"sort=cpu"}}, {"tiled-bits", {"frusta=cached"}}}) {
    const std::vector<Masks> masks = alone(candidate);
    std::uint64_t bytes = 0;
    for (std::uint32_t count = 1; count <= MAX_FRAMES_IN_FLIGHT; ++count) {
      SCOPED_TRACE(fmt::format("{}, {} in flight", candidate.method, count));
      vulkan::Culler culler = culler_of(candidate, count);
      constexpr std::size_t ORDER[] = {1, 2, 3, 0, 2, 1, 0, 3};
      for (std::size_t first = 0; first + count <= std::size(ORDER); first += count)
        expect_as_alone(culler, std::span(ORDER).subspan(first, count), masks);
      EXPECT_EQ(culler.bytes() > bytes, bytes == 0 || candidate.method == "drobot-zbin");
      bytes = culler.bytes();
    }
  }
}

// The slot of a dropped frame is free at once; that of a frame under way is not.
TEST_F(FramesAhead, DroppedOnesMakeRoom) {
  const CullerCandidate candidate{"drobot-zbin", {"sort=cpu"}};
  const std::vector<Masks> masks = alone(candidate);
  vulkan::Culler culler = culler_of(candidate, 2);
  for (int round = 0; round < 3; ++round) {
    Flying first(culler, frames_[0]);
    const Flying never(culler, frames_[1]);
    EXPECT_EQ(culler.counters().overflowed_cells, 0);
    culler.drop(never.number);
    Flying last(culler, frames_[2]);
    first.commands.submit();
    last.commands.submit();
    last.commands.wait();
    first.commands.wait();
    EXPECT_EQ(first.pass.masks(), masks[0]);
    EXPECT_EQ(last.pass.masks(), masks[2]);
    EXPECT_EQ(take(culler.finish(first.number)), vulkan::Growth::none);
    EXPECT_EQ(take(culler.finish(last.number)), vulkan::Growth::none);
  }
}

}  // namespace
}  // namespace lamp::app
