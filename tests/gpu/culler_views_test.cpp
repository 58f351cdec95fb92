// A Culler with two views a frame: each is culled as it would be alone, by every method; what did not fit is counted
// over both, and there is room for both in the next frame.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/engine_frame.h"

namespace lamp::app {
namespace {

vulkan::CullerView culler_view(const EngineFrame& frame) {
  return {.view = &frame.view,
          .depth_image = frame.depth_image.handle(),
          .depth_view = frame.depth_image.view(),
          .depth_layout = frame.depth_image.sampled().layout};
}

class CullerViews : public GpuTest {
 protected:
  /// Two eyes on the same lights.
  void SetUp() override {
    eyes_.push_back(engine_frame());
    EngineFrame other = engine_frame({.projection = "orthographic", .seed = 2});
    other.lights = eyes_[0].lights;
    eyes_.push_back(std::move(other));
    for (const EngineFrame& eye : eyes_) views_.push_back(culler_view(eye));
  }

  static vulkan::Culler make_culler(std::uint32_t views, const Method& method, std::vector<std::string> options = {}) {
    return take(vulkan::Culler::create(test_context().device(), {.width = ENGINE_WIDTH,
                                                                 .height = ENGINE_HEIGHT,
                                                                 .views = views,
                                                                 .light_capacity = ENGINE_LIGHTS,
                                                                 .method = std::string(method.name),
                                                                 .options = std::move(options)}));
  }

  /// Lights, without a camera.
  [[nodiscard]] vulkan::CullerFrame told() const {
    vulkan::CullerFrame frame = culler_frame(eyes_[0]);
    frame.view = nullptr;
    frame.depth_image = VK_NULL_HANDLE;
    return frame;
  }

  std::vector<Masks> walk_together(vulkan::Culler& culler, std::uint64_t& number) const {
    vulkan::CullerFrame frame = told();
    frame.views = views_;
    std::vector<MaskPass> passes;
    for (std::uint32_t i = 0; i < 2; ++i) passes.emplace_back(culler.lookup(), eyes_[i], glm::uvec2(8), i);
    test_context().submit([&](VkCommandBuffer commands) {
      number = take(culler.record(commands, frame));
      for (const MaskPass& pass : passes) pass.record(commands, culler.lookup());
      MaskPass::record_to_host(commands);
    });
    return {passes[0].masks(), passes[1].masks()};
  }

  Masks walk_alone(vulkan::Culler& culler, std::uint32_t eye) const {
    vulkan::CullerFrame frame = told();
    frame.views = std::span(views_).subspan(eye, 1);
    return cull_and_walk(culler, eyes_[eye], frame);
  }

  static std::vector<std::uint32_t> constants_of(const vulkan::Culler& culler) {
    std::vector<std::uint32_t> values;
    for (const vulkan::Constant& constant : culler.lookup().constants) values.push_back(constant.value);
    return values;
  }

  std::vector<EngineFrame> eyes_;
  std::vector<vulkan::CullerView> views_;
};

TEST_F(CullerViews, AreCulledAsAloneByEveryMethod) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    vulkan::Culler together = make_culler(2, method);
    vulkan::Culler alone = make_culler(1, method);
    std::uint64_t number = 0;
    for (int frame = 0; frame < 2; ++frame) {  // what is kept between frames is kept for each view
      const std::vector<Masks> found = walk_together(together, number);
      EXPECT_EQ(take(together.finish(number)), vulkan::Growth::none);
      if (frame == 0) continue;
      for (std::uint32_t eye = 0; eye < 2; ++eye) {
        EXPECT_GT(walked(found[eye]), 0U);
        EXPECT_EQ(found[eye], walk_alone(alone, eye)) << "eye " << eye;
      }
    }
  }
}

TEST_F(CullerViews, OfOptionsThatKeepOrUpload) {
  for (const auto& [name, options] : {std::pair<const char*, std::vector<std::string>>{"tiled", {"frusta=cached"}},
                                      {"drobot-zbin", {"sort=cpu"}},
                                      {"drobot-raster-tile", {"depth=stencil", "raster=full"}}}) {
    SCOPED_TRACE(name);
    const Method& method = *take(find_method(name));
    vulkan::Culler together = make_culler(2, method, options);
    vulkan::Culler alone = make_culler(1, method, options);
    std::uint64_t number = 0;
    static_cast<void>(walk_together(together, number));
    static_cast<void>(take(together.finish(number)));
    const std::vector<Masks> found = walk_together(together, number);
    for (std::uint32_t eye = 0; eye < 2; ++eye) EXPECT_EQ(found[eye], walk_alone(alone, eye)) << "eye " << eye;
  }
}

TEST_F(CullerViews, WhatDoesNotFitIsCountedOverAllAndGetsRoom) {
  for (const auto& [name, option] : {std::pair("tiled", "capacity=1"), {"clustered", "mean_capacity=1"}}) {
    SCOPED_TRACE(name);
    const Method& method = *take(find_method(name));
    vulkan::Culler small = make_culler(2, method, {option});
    vulkan::Culler alone = make_culler(1, method);
    std::uint32_t overflowed = 0;
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      vulkan::Culler own = make_culler(1, method, {option});
      static_cast<void>(walk_alone(own, eye));
      overflowed += own.counters().overflowed_cells;
    }
    std::uint64_t number = 0;
    const std::vector<Masks> crowded = walk_together(small, number);
    EXPECT_GT(overflowed, 0U);
    EXPECT_EQ(small.counters().overflowed_cells, overflowed);
    const std::vector<std::uint32_t> before = constants_of(small);
    const vulkan::Growth growth = take(small.finish(number));
    EXPECT_EQ(growth, constants_of(small) == before ? vulkan::Growth::buffers : vulkan::Growth::constants);
    EXPECT_NE(constants_of(small), before) << "views' parts of larger buffers lie elsewhere";
    const std::vector<Masks> found = walk_together(small, number);
    EXPECT_EQ(small.counters().overflowed_cells, 0U);
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      expect_no_miss(eyes_[eye], crowded[eye]);
      EXPECT_EQ(found[eye], walk_alone(alone, eye)) << "eye " << eye;
    }
  }
}

TEST_F(CullerViews, OfAnotherNumberAreRefused) {
  const auto of = [&](std::span<const vulkan::CullerView> views) {
    vulkan::CullerFrame frame = told();
    frame.views = views;
    return frame;
  };
  vulkan::Culler culler = make_culler(2, *take(find_method("tiled")));
  const auto refusal = [&](const vulkan::CullerFrame& frame) {
    const Result<std::uint64_t> recorded = culler.record(VK_NULL_HANDLE, frame);
    return recorded ? "nothing" : recorded.error().text();
  };
  EXPECT_EQ(refusal(culler_frame(eyes_[0])), "views: expected 2, as many as the Culler was made for, got 1");
  EXPECT_EQ(refusal(of(std::span(views_).first(1))), "views: expected 2, as many as the Culler was made for, got 1");
  std::vector<vulkan::CullerView> blind = views_;
  blind[1].depth_view = VK_NULL_HANDLE;
  EXPECT_EQ(refusal(of(blind)), "view 1: depth view: expected a view of the depth image, got none");
  const Result<vulkan::Culler> many = vulkan::Culler::create(
      test_context().device(), {.width = 8, .height = 8, .views = 9, .light_capacity = 8, .method = "tiled"});
  ASSERT_FALSE(many.ok());
  EXPECT_EQ(many.error().text(), "views: expected 1 to 8, got 9");
}

}  // namespace
}  // namespace lamp::app
