// Frames that are recorded and never run: the next ones wait for what ran, and make what was not made.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <random>

#include "gpu/flying.h"

namespace lamp::app {
namespace {

class DroppedFrames : public GpuTest {
 protected:
  const EngineFrame frames_[3] = {engine_frame(), engine_frame({.projection = "orthographic", .lights = 33, .seed = 2}),
                                  engine_frame({.seed = 5})};
};

// Both frames that run are in one command buffer, so that validation sees whatever the second does not wait for; the
// one between them goes into another, which nobody submits.
TEST_F(DroppedFrames, LeaveNothingBehind) {
  for (const CullerCandidate& candidate : culler_candidates()) {
    SCOPED_TRACE(fmt::format("{} {}", candidate.method, fmt::join(candidate.options, " ")));
    vulkan::Culler culler = culler_of(candidate, 3);
    const MaskPass first(culler.lookup(), frames_[0]);
    const MaskPass last(culler.lookup(), frames_[2]);
    const auto record = [&](VkCommandBuffer commands, const MaskPass& pass, const EngineFrame& frame) {
      const std::uint64_t number = take(culler.record(commands, culler_frame(frame)));
      pass.record(commands, culler.lookup());
      return number;
    };
    Commands commands([&](VkCommandBuffer buffer) {
      static_cast<void>(record(buffer, first, frames_[0]));
      const Flying never(culler, frames_[1]);
      culler.drop(never.number);
      static_cast<void>(record(buffer, last, frames_[2]));
      MaskPass::record_to_host(buffer);
    });
    commands.submit();
    commands.wait();
    EXPECT_EQ(first.masks(), masks_alone(candidate, frames_[0]));
    EXPECT_EQ(last.masks(), masks_alone(candidate, frames_[2]));
  }
}

/// Every light of `some` is in `all`.
bool holds(const Masks& all, const Masks& some) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if ((some[i] & ~all[i]) != glm::uvec2(0)) return false;
  return true;
}

/// Records, drops, submits and finishes frames in any order in which a host may do so, and checks those that ran.
class RandomHost {
 public:
  RandomHost(vulkan::Culler& culler, std::span<const EngineFrame> frames, std::span<const Masks> alone)
      : culler_(culler), frames_(frames), alone_(alone) {}

  void run(std::uint32_t steps) {
    for (std::uint32_t i = 0; i < steps; ++i) {
      const std::uint32_t dice = random_() % 8;
      if (dice < 3)
        record();
      else if (dice == 3)
        drop();
      else if (dice < 6)
        submit();
      else
        finish();
    }
    for (submit(); !flying_.empty(); submit()) finish();
  }
  [[nodiscard]] std::uint32_t checked() const { return checked_; }
  [[nodiscard]] std::uint32_t grown() const { return grown_; }

  static constexpr std::uint32_t IN_FLIGHT = 3;

 private:
  struct One {
    std::size_t frame = 0;
    bool submitted = false;
    std::unique_ptr<Flying> flying;
  };

  auto first_waiting() { return std::ranges::find(flying_, false, &One::submitted); }
  void record() {
    if (flying_.size() == IN_FLIGHT) return;
    const std::size_t frame = random_() % frames_.size();
    flying_.push_back({frame, false, std::make_unique<Flying>(culler_, frames_[frame])});
  }
  void drop() {
    const auto waiting = flying_.end() - first_waiting();
    if (waiting == 0) return;
    const auto dropped = first_waiting() + static_cast<std::ptrdiff_t>(random_() % static_cast<unsigned>(waiting));
    culler_.drop(dropped->flying->number);
    flying_.erase(dropped);
  }
  void submit() {
    const auto next = first_waiting();
    if (next == flying_.end()) return;
    next->flying->commands.submit();
    next->submitted = true;
  }
  void finish() {
    if (flying_.empty() || !flying_.front().submitted) return;
    const One& done = flying_.front();
    done.flying->commands.wait();
    const Masks masks = done.flying->pass.masks();
    const bool grew = take(culler_.finish(done.flying->number)) != vulkan::Growth::none;
    EXPECT_TRUE(holds(masks, alone_[done.frame])) << "number " << done.flying->number;
    if (grown_ == 0 && !grew) {
      EXPECT_EQ(masks, alone_[done.frame]) << "number " << done.flying->number;
    }
    ++checked_;
    grown_ += grew ? 1 : 0;
    flying_.pop_front();
  }

  vulkan::Culler& culler_;
  std::span<const EngineFrame> frames_;
  std::span<const Masks> alone_;
  std::deque<One> flying_;
  std::mt19937 random_{7};
  std::uint32_t checked_ = 0;
  std::uint32_t grown_ = 0;
};

// What is kept while the projection stays the same; with lists that must grow while frames are under way; and a slot a
// frame.
TEST_F(DroppedFrames, InAnyOrderWithOthersThatRun) {
  using Settings = std::vector<std::string>;
  struct Case {
    CullerCandidate candidate;
    Settings short_lists;  ///< besides
  };
  for (const auto& [candidate, short_lists] : {Case{{"tiled-bits", {"frusta=cached"}}, {}},
                                               {{"primal", {}}, {}},
                                               {{"primal", {}}, {"mean_capacity=1"}},
                                               {{"primal-base", {}}, {}},
                                               {{"primal-base", {}}, {"capacity=1"}},
                                               {{"article-deferred", {}}, {}},
                                               {{"drobot-zbin", {"sort=cpu"}}, {}},
                                               {{"clustered", {}}, {"mean_capacity=1"}}}) {
    SCOPED_TRACE(
        fmt::format("{} {} {}", candidate.method, fmt::join(candidate.options, " "), fmt::join(short_lists, " ")));
    std::vector<Masks> alone;
    for (const EngineFrame& frame : frames_) alone.push_back(masks_alone(candidate, frame));
    CullerCandidate tested = candidate;
    tested.options.insert(tested.options.end(), short_lists.begin(), short_lists.end());
    vulkan::Culler culler = culler_of(tested, RandomHost::IN_FLIGHT);
    RandomHost host(culler, frames_, alone);
    host.run(200);
    EXPECT_GT(host.checked(), 15);
    EXPECT_EQ(host.grown() > 0, !short_lists.empty());
  }
}

TEST_F(DroppedFrames, KeptPassesAreRecordedUntilOneIsKnownToHaveRun) {
  const Method& method = *take(find_method("tiled-bits"));
  vulkan::PlanRunner runner = take(vulkan::PlanRunner::create(
      test_context().device(), take(make_plan(method, {.width = ENGINE_WIDTH,
                                                       .height = ENGINE_HEIGHT,
                                                       .light_capacity = ENGINE_LIGHTS,
                                                       .options = take(resolve_options(method, {"frusta=cached"})),
                                                       .traits = test_context().device().traits}))));
  const vulkan::Buffer records = host_buffer("frame", sizeof(shared::Frame));
  const auto record = [&](const EngineFrame& frame) {
    const shared::Frame host_frame = frame.view.frame(1, ENGINE_LIGHTS);
    const vulkan::PlanInputs inputs{.frame = records.handle(),
                                    .lights = frame.light_buffer.handle(),
                                    .spheres = frame.sphere_buffer.handle(),
                                    .depth = frame.depth_image.sampled(),
                                    .host_frame = &host_frame};
    std::uint64_t number = 0;
    const Commands never([&](VkCommandBuffer commands) {
      vulkan::AccessTracker tracker;
      tracker.assume(inputs.depth);
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      number = take(runner.record(recorder, inputs));
    });
    return number;
  };
  const EngineFrame& one = frames_[0];
  const EngineFrame& other = frames_[1];
  const auto rebuilds = [&] { return runner.projection_rebuilds(); };
  static_cast<void>(record(one));
  const std::uint64_t second = record(one);
  EXPECT_EQ(rebuilds(), 2) << "neither is known to have run";
  runner.finish(second);
  static_cast<void>(record(one));
  EXPECT_EQ(rebuilds(), 2) << "kept";
  const std::uint64_t changed = record(other);
  EXPECT_EQ(rebuilds(), 3);
  const std::uint64_t back = record(one);
  EXPECT_EQ(rebuilds(), 4) << "the other projection may have been written over it";
  runner.finish(changed);
  static_cast<void>(record(one));
  EXPECT_EQ(rebuilds(), 5) << "what has run wrote the other projection";
  runner.finish(back);
  static_cast<void>(record(one));
  EXPECT_EQ(rebuilds(), 5);
}

}  // namespace
}  // namespace lamp::app
