// A depth image that is larger than the picture, as engines with dynamic resolution have one: what it holds beyond the
// picture changes nothing, for every method and every way to look at depth.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/made_up_frame.h"
#include "gpu/over_depth.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t LIGHTS = 100;

/// Nearer, farther, and within what the picture holds.
float junk_depth(glm::uvec2 pixel) {
  constexpr float JUNK[] = {1.0F, 1e-5F, 0.02F, 0.9F};
  return JUNK[(pixel.x * 7 + pixel.y * 3) % 4];
}

GpuImage image_around(glm::uvec2 picture, glm::uvec2 image) {
  std::vector<float> depth(std::size_t{image.x} * image.y);
  for (std::uint32_t y = 0; y < image.y; ++y)
    for (std::uint32_t x = 0; x < image.x; ++x)
      depth[std::size_t{y} * image.x + x] = x < picture.x && y < picture.y ? made_up_depth({x, y}) : junk_depth({x, y});
  return depth_image(image.x, image.y, depth);
}

struct LargerCase {
  const Method* method = nullptr;
  std::vector<std::string> settings;
};

/// Every row of the table.
std::vector<LargerCase> rows() {
  std::vector<LargerCase> all;
  for (const Method& method : methods()) all.push_back({&method, {}});
  return all;
}

/// Every way of `tiled` to find every kind of depth bounds; containers and pruning in turns, so that each meets each.
std::vector<LargerCase> tiled_bounds() {
  std::vector<LargerCase> all;
  for (const char* bounds : {"minmax", "half", "modified-half", "mask"})
    for (const char* reduce : {"atomic", "subgroup", "parallel"})
      all.push_back({take(find_method("tiled")),
                     {fmt::format("bounds={}", bounds), fmt::format("reduce={}", reduce),
                      all.size() % 2 == 0 ? "container=bits" : "container=list",
                      all.size() / 2 % 2 == 0 ? "prune=pixel" : "prune=none"}});
  return all;
}

/// Squares of pixels that are gathered at once, in each pass that does so; and pruning.
std::vector<LargerCase> gathers(std::initializer_list<const char*> tiles) {
  std::vector<LargerCase> all;
  for (const char* cells : {"gather", "bits", "list"})
    for (const char* tile : tiles)
      all.push_back({take(find_method("lamplight")),
                     {fmt::format("cells={}", cells), fmt::format("tile={}", tile),
                      all.size() % 2 == 0 ? "prune=pixel" : "prune=none"}});
  return all;
}

std::vector<LargerCase> rastered() {
  const Method* tile = take(find_method("drobot-raster-tile"));
  return {{tile, {"raster=full"}},
          {tile, {"raster=quarter-msaa"}},
          {take(find_method("drobot-raster-cluster")), {"early=on"}}};
}

class LargerDepth : public GpuTest {
 protected:
  static void expect_ignored(glm::uvec2 picture, glm::uvec2 image, const std::vector<LargerCase>& tested) {
    SCOPED_TRACE(fmt::format("{}x{} in {}x{}", picture.x, picture.y, image.x, image.y));
    const View view = made_up_view(picture);
    const std::vector<shared::Light> lights = scattered_lights(view, LIGHTS);
    OverDepth exact(view, image_around(picture, picture), lights);
    OverDepth larger(view, image_around(picture, image), lights);
    for (const auto& [method, settings] : tested) {
      SCOPED_TRACE(fmt::format("{} {}", method->name, fmt::join(settings, " ")));
      const Result<Plan> plan = make_plan(*method, {.width = picture.x,
                                                    .height = picture.y,
                                                    .light_capacity = LIGHTS,
                                                    .options = take(resolve_options(*method, settings)),
                                                    .traits = test_context().device().traits});
      ASSERT_TRUE(plan.ok()) << plan.error().text();
      vulkan::PlanRunner runner =
          take(vulkan::PlanRunner::create(test_context().device(), plan.value(), shader_library().source()));
      for (const Passes which : {Passes::separate, Passes::fused}) {
        if (which == Passes::fused && !runner.plan().fused) continue;
        EXPECT_EQ(larger.per_pixel("count_everywhere", runner, which),
                  exact.per_pixel("count_everywhere", runner, which))
            << (which == Passes::fused ? "fused" : "separate");
      }
    }
  }
};

TEST_F(LargerDepth, IsIgnoredBeyondThePictureByEveryMethod) { expect_ignored({85, 51}, {128, 64}, rows()); }

TEST_F(LargerDepth, IsIgnoredByEveryKindOfDepthBounds) {
  expect_ignored({85, 51}, {128, 64}, tiled_bounds());
  expect_ignored({85, 51}, {128, 64}, rastered());
}

TEST_F(LargerDepth, IsIgnoredWherePixelsAreGathered) {
  expect_ignored({85, 51}, {128, 64}, gathers({"8", "16", "32"}));
  expect_ignored({85, 51}, {86, 52}, gathers({"16"}));
  expect_ignored({64, 33}, {64, 256}, gathers({"16"}));
  expect_ignored({1, 1}, {7, 3}, gathers({"8"}));
}

}  // namespace
}  // namespace lamp::app
