// Plans of rasterised culling: what they leave to a device that can do it, and what they do and say where it cannot.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "lamplight/method.h"
#include "unit/devices.h"

namespace {

using lamp::DeviceTraits;
using lamp::Method;
using lamp::Plan;
using lamp::test::LEAST_DEVICE;
using lamp::test::SOFTWARE_DEVICE;

TEST(RasterisedCulling, LeavesCoverageToTheDeviceOnlyIfItCan) {
  DeviceTraits able = SOFTWARE_DEVICE;
  able.conservative_raster = true;
  for (const char* name : {"drobot-raster-tile", "drobot-raster-cluster"}) {
    const Method& method = *lamp::find_method(name).value();
    const auto options = lamp::resolve_options(method, {"raster=conservative"}).value();
    const auto plan = [&](const DeviceTraits& traits) {
      return lamp::make_plan(method,
                             {.width = 65, .height = 64, .light_capacity = 100, .options = options, .traits = traits})
          .value();
    };
    const lamp::RasterState by_device = plan(able).passes.back().raster;
    EXPECT_TRUE(by_device.conservative);
    EXPECT_EQ(by_device.pixel, 8U);
    EXPECT_TRUE(plan(able).notes.empty());
    EXPECT_TRUE(lamp::plan_check(plan(able), SOFTWARE_DEVICE)) << "a device that cannot";
    EXPECT_FALSE(plan(SOFTWARE_DEVICE).passes.back().raster.conservative);
    ASSERT_EQ(plan(SOFTWARE_DEVICE).notes.size(), 1U);
    EXPECT_TRUE(plan(SOFTWARE_DEVICE).notes[0].starts_with("raster=half-msaa instead of conservative"));
  }
}

TEST(RasterisedCulling, DoesNotMergeAtomicsWhereTheDeviceCannotAndSaysSo) {
  for (const char* name : {"drobot-raster-tile", "drobot-raster-cluster"}) {
    const Method& method = *lamp::find_method(name).value();
    const auto plan = [&](const char* compact, const DeviceTraits& traits) {
      const auto options = lamp::resolve_options(method, {std::string("compact=") + compact, "walk=plain"}).value();
      return lamp::make_plan(method,
                             {.width = 64, .height = 64, .light_capacity = 100, .options = options, .traits = traits})
          .value();
    };
    EXPECT_TRUE(plan("on", SOFTWARE_DEVICE).passes.back().shader.ends_with("_compact"));
    EXPECT_TRUE(plan("on", SOFTWARE_DEVICE).notes.empty());
    EXPECT_FALSE(plan("off", SOFTWARE_DEVICE).passes.back().shader.ends_with("_compact"));
    const Plan without = plan("on", LEAST_DEVICE);
    EXPECT_FALSE(without.passes.back().shader.ends_with("_compact"));
    ASSERT_EQ(without.notes.size(), 1U);
    EXPECT_TRUE(without.notes[0].starts_with("compact=off instead of on")) << without.notes[0];
    EXPECT_TRUE(plan("off", LEAST_DEVICE).notes.empty());
  }
}

TEST(RasterisedCulling, TheSourcesWalkIsApproximate) {
  const Method& method = *lamp::find_method("drobot-raster-cluster").value();
  for (const char* mark : {"farthest", "first"}) {
    const auto options = lamp::resolve_options(method, {std::string("mark=") + mark}).value();
    const Plan plan =
        lamp::make_plan(
            method, {.width = 65, .height = 64, .light_capacity = 100, .options = options, .traits = SOFTWARE_DEVICE})
            .value();
    EXPECT_EQ(plan.approximate, std::string_view(mark) == "first");
  }
}

// Devices with the 4 bits that Vulkan guarantees; most have 8.
TEST(RasterisedCulling, ReachesFartherWhereCornersAreSnappedFarther) {
  for (const char* name : {"drobot-raster-tile", "drobot-raster-cluster"}) {
    const Method& method = *lamp::find_method(name).value();
    const auto reach_px = [&](const char* raster, std::uint32_t bits) {
      DeviceTraits traits = SOFTWARE_DEVICE;
      traits.sub_pixel_bits = bits;
      const auto options = lamp::resolve_options(method, {std::string("raster=") + raster}).value();
      const Plan plan =
          lamp::make_plan(method,
                          {.width = 65, .height = 64, .light_capacity = 100, .options = options, .traits = traits})
              .value();
      EXPECT_EQ(plan.passes.front().name, "light proxies");
      return plan.passes.front().constants[1] / 1024.0;
    };
    EXPECT_NEAR(reach_px("full", 8), 0.05, 0.001);
    EXPECT_NEAR(reach_px("half-msaa", 8), 2 * 0.45, 0.001);
    EXPECT_NEAR(reach_px("full", 4), 0.5, 0.001);
    EXPECT_NEAR(reach_px("half-msaa", 4), 2 * 0.9, 0.001);
    EXPECT_NEAR(reach_px("quarter-msaa", 4), 4 * 0.9, 0.001);
  }
}

}  // namespace
