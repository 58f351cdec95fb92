// Depth as engines have it: reversed or standard, of every format, of several samples a pixel, as a part of a larger
// image and as a layer of an array. No method misses a light that reaches a pixel, or a sample of one.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/flying.h"
#include "gpu/in_turn.h"
#include "render/sample_depth.h"

namespace lamp::app {
namespace {

constexpr VkOffset2D OFFSET{13, 7};
constexpr VkExtent2D LARGER{128, 64};

std::vector<CullerCandidate> rows() {
  std::vector<CullerCandidate> all;
  for (const Method& method : methods()) all.push_back({method.name, {}});
  return all;
}

/// Every way of looking at depth; containers and pruning in turns.
std::vector<CullerCandidate> ways() {
  std::vector<CullerCandidate> all = rows();
  for (const char* bounds : {"minmax", "half", "modified-half", "mask"})
    for (const char* reduce : {"atomic", "subgroup", "parallel"})
      all.push_back({"tiled",
                     {fmt::format("bounds={}", bounds), fmt::format("reduce={}", reduce),
                      all.size() % 2 == 0 ? "container=bits" : "container=list",
                      all.size() / 2 % 2 == 0 ? "prune=pixel" : "prune=none"}});
  for (const char* cells : {"gather", "bits", "list"})
    for (const char* tile : {"8", "16", "32"})
      for (const char* prune : {"none", "pixel"})
        all.push_back({"lamplight",
                       {fmt::format("cells={}", cells), fmt::format("tile={}", tile), fmt::format("prune={}", prune)}});
  for (const char* raster : {"full", "half-msaa", "quarter-msaa", "conservative"})
    all.push_back({"drobot-raster-tile", {fmt::format("raster={}", raster)}});
  all.push_back({"drobot-raster-cluster", {"early=on"}});
  return all;
}

bool can_be(VkFormat format, VkFormatFeatureFlags features) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(test_context().device().physical, format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

vulkan::Culler culler_of_samples(const CullerCandidate& candidate, std::uint32_t samples) {
  return take(vulkan::Culler::create(test_context().device(), {.width = ENGINE_WIDTH,
                                                               .height = ENGINE_HEIGHT,
                                                               .light_capacity = ENGINE_LIGHTS,
                                                               .method = std::string(candidate.method),
                                                               .options = candidate.options,
                                                               .depth_samples = samples}));
}

vulkan::CullerFrame with_depth(const EngineFrame& frame, const GpuImage& depth, VkOffset2D offset = {}) {
  vulkan::CullerFrame told = culler_frame(frame);
  told.depth_image = depth.handle();
  told.depth_view = depth.view();
  told.depth_layout = depth.sampled().layout;
  told.depth_offset = offset;
  return told;
}

/// The frames' depth, each as a sample, in a larger image of surfaces that are nearer than any.
SampledDepth in_larger_image(std::span<const EngineFrame> of_samples, VkFormat format, VkOffset2D offset = OFFSET) {
  SampledDepth depth(test_context().device(), shader_library(),
                     {.samples = static_cast<std::uint32_t>(of_samples.size()),
                      .width = LARGER.width,
                      .height = LARGER.height,
                      .format = format,
                      .offset = offset,
                      .beyond = of_samples.front().view.reversed_depth() ? 1.0F : 0.0F});
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    for (const EngineFrame& frame : of_samples) tracker.assume(frame.depth_image.sampled());
    for (std::uint32_t i = 0; i < of_samples.size(); ++i) depth.record(recorder, of_samples[i].depth_image, i);
    recorder.barrier({{.resource = depth.image().sampled(),
                       .stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}});
  });
  return depth;
}

class DepthImages : public GpuTest {};

TEST_F(DepthImages, StandardDepthGivesTheListsOfReversedDepth) {
  std::size_t number = 0;
  for (const char* projection : {"infinite", "perspective", "orthographic", "off-centre"}) {
    std::size_t way = number++;
    const EngineFrame reversed = engine_frame({.projection = projection});
    const EngineFrame standard = engine_frame({.projection = projection, .reversed_depth = false});
    ASSERT_FALSE(standard.view.reversed_depth());
    for (const CullerCandidate& candidate : ways()) {
      if (!has_turn(way++, 4)) continue;
      SCOPED_TRACE(fmt::format("{} {} {}", projection, candidate.method, fmt::join(candidate.options, " ")));
      const Masks masks = masks_alone(candidate, standard);
      expect_no_miss(standard, masks);
      const auto wanted = static_cast<double>(walked(masks_alone(candidate, reversed)));
      EXPECT_NEAR(static_cast<double>(walked(masks)), wanted, 0.02 * wanted) << "rounding moves few lights";
    }
  }
}

TEST_F(DepthImages, AnyFormatAtAnyPlace) {
  constexpr std::pair<VkFormat, const char*> FORMATS[] = {{VK_FORMAT_D16_UNORM, "D16"},
                                                          {VK_FORMAT_X8_D24_UNORM_PACK32, "X8_D24"},
                                                          {VK_FORMAT_D24_UNORM_S8_UINT, "D24_S8"},
                                                          {VK_FORMAT_D32_SFLOAT, "D32"},
                                                          {VK_FORMAT_D32_SFLOAT_S8_UINT, "D32_S8"}};
  std::uint32_t tried = 0;
  for (const bool reversed : {true, false}) {
    const EngineFrame frames[] = {engine_frame({.projection = "perspective", .reversed_depth = reversed})};
    for (const auto& [format, name] : FORMATS) {
      if (!can_be(format, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT))
        continue;
      ++tried;
      const SampledDepth depth = in_larger_image(frames, format);
      const SampledDepth at_the_corner = in_larger_image(frames, format, {});
      for (const CullerCandidate& candidate : rows()) {
        SCOPED_TRACE(fmt::format("{} {} {}", name, reversed ? "reversed" : "standard", candidate.method));
        vulkan::Culler culler = culler_of_samples(candidate, 1);
        const Masks masks = cull_and_walk(culler, frames[0], with_depth(frames[0], depth.image(), OFFSET));
        EXPECT_EQ(masks, cull_and_walk(culler, frames[0], with_depth(frames[0], at_the_corner.image())));
        if (format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D32_SFLOAT_S8_UINT) {
          EXPECT_EQ(masks, masks_alone(candidate, frames[0]));
          expect_no_miss(frames[0], masks);
        }
      }
    }
  }
  EXPECT_GE(tried, 6) << "Vulkan has D16, D32 and one with stencil";
}

TEST_F(DepthImages, AColourImageOrALayerOfAnArray) {
  const EngineFrame frame = engine_frame();
  const GpuImage colour = depth_image(ENGINE_WIDTH, ENGINE_HEIGHT, frame.depth, {.format = VK_FORMAT_R32_SFLOAT});
  const GpuImage layer = depth_image(ENGINE_WIDTH, ENGINE_HEIGHT, frame.depth, {.layers = 3});
  for (const CullerCandidate& candidate : ways()) {
    SCOPED_TRACE(fmt::format("{} {}", candidate.method, fmt::join(candidate.options, " ")));
    const Masks masks = masks_alone(candidate, frame);
    vulkan::Culler culler = culler_of_samples(candidate, 1);
    EXPECT_EQ(cull_and_walk(culler, frame, with_depth(frame, colour)), masks);
    EXPECT_EQ(cull_and_walk(culler, frame, with_depth(frame, layer)), masks);
  }
}

/// Frames of one scene as each sample of a pixel sees it.
std::vector<EngineFrame> frames_of_samples(std::uint32_t samples, bool reversed) {
  std::vector<EngineFrame> frames;
  for (const glm::dvec2 at : sample_places(samples))
    frames.push_back(engine_frame({.at = at, .reversed_depth = reversed}));
  return frames;
}

TEST_F(DepthImages, ALightThatReachesAnySampleIsListed) {
  std::uint32_t tried = 0;
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(test_context().device().physical, &properties);
  for (const std::uint32_t samples : {2U, 4U, 8U}) {
    if ((properties.limits.sampledImageDepthSampleCounts & samples) == 0) continue;
    if ((properties.limits.framebufferDepthSampleCounts & samples) == 0) continue;
    ++tried;
    const bool reversed = samples != 4;
    const std::vector<EngineFrame> frames = frames_of_samples(samples, reversed);
    const EngineFrame centred = engine_frame({.reversed_depth = reversed});
    const SampledDepth depth = in_larger_image(frames, VK_FORMAT_D32_SFLOAT);
    for (const CullerCandidate& candidate : ways()) {
      SCOPED_TRACE(fmt::format("{} samples {} {}", samples, candidate.method, fmt::join(candidate.options, " ")));
      vulkan::Culler culler = culler_of_samples(candidate, samples);
      const vulkan::CullerFrame told = with_depth(centred, depth.image(), OFFSET);
      for (const EngineFrame& frame : frames) expect_no_miss(frame, cull_and_walk(culler, frame, told));
    }
  }
  EXPECT_GE(tried, 1) << "Vulkan has images of four samples";
}

// Where all samples are alike, lists are those of one: nothing else is listed.
TEST_F(DepthImages, SamplesThatAreAlikeGiveTheListsOfOne) {
  const std::vector<EngineFrame> frames = [] {
    std::vector<EngineFrame> alike;
    for (int i = 0; i < 4; ++i) alike.push_back(engine_frame());
    return alike;
  }();
  const SampledDepth depth = in_larger_image(frames, VK_FORMAT_D32_SFLOAT);
  std::size_t number = 0;
  for (const CullerCandidate& candidate : ways()) {
    if (!has_turn(number++, 2)) continue;
    SCOPED_TRACE(fmt::format("{} {}", candidate.method, fmt::join(candidate.options, " ")));
    vulkan::Culler culler = culler_of_samples(candidate, 4);
    const Masks masks = cull_and_walk(culler, frames[0], with_depth(frames[0], depth.image(), OFFSET));
    const Masks one = masks_alone(candidate, frames[0]);
    const Options options = take(resolve_options(*take(find_method(candidate.method)), candidate.options));
    const auto is = [&](const char* option, const char* value) {
      return options.all().contains(option) && options.word(option) == value;
    };
    // Both allow for samples that lie aside of the pixel's centre.
    if (!is("prune", "pixel") && !is("raster", "full")) {
      EXPECT_EQ(masks, one);
    }
    EXPECT_LE(walked(masks), walked(one) * 11 / 10);
  }
}

TEST_F(DepthImages, WhatNoImageCanBeIsRefused) {
  const auto error = [](vulkan::CullerInfo info) {
    info.width = info.height = 8;
    info.light_capacity = 1;
    const Result<vulkan::Culler> culler = vulkan::Culler::create(test_context().device(), info);
    return culler ? "" : culler.error().text();
  };
  EXPECT_EQ(error({.depth_samples = 3}), "depth samples: expected 1, 2, 4, 8, 16, 32 or 64, got 3");
  EXPECT_EQ(error({.depth_samples = 128}), "depth samples: expected 1, 2, 4, 8, 16, 32 or 64, got 128");
  const EngineFrame frame = engine_frame();
  vulkan::Culler culler = take(engine_culler("tiled"));
  test_context().submit([&](VkCommandBuffer commands) {
    const Result<std::uint64_t> recorded = culler.record(commands, with_depth(frame, frame.depth_image, {-1, 2}));
    ASSERT_FALSE(recorded);
    EXPECT_EQ(recorded.error().text(), "depth offset: expected where the picture begins in the depth image, got -1, 2");
  });
}

}  // namespace
}  // namespace lamp::app
