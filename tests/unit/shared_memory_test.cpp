// Shared memory is read from SPIR-V: held against sums by hand, and known of everything that plans run.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "lamplight/method.h"
#include "lamplight/shader_code.h"
#include "unit/devices.h"
#include "unit/every_plan.h"

namespace lamp {
namespace {

std::uint64_t bytes_of(const char* shader, const std::vector<std::uint32_t>& constants) {
  return shared_bytes(find_shader(library_shaders(), shader)->spirv, constants);
}

// The shaders' own declarations, added up.
TEST(SharedMemory, IsWhatShadersDeclare) {
  EXPECT_EQ(bytes_of("methods/light_bounds", {}), 0U);
  EXPECT_EQ(bytes_of("methods/sort_count", {}), 256U * 4);
  EXPECT_EQ(bytes_of("methods/zbin_tiles", {}), 8U * 4);
  EXPECT_EQ(bytes_of("methods/grid_extents", {}), 2U * 3 * 4);
}

// Arrays whose length is a constant of the pass, by itself and in an expression.
TEST(SharedMemory, GrowsWithTheConstantsOfThePass) {
  const Method& tiled = *find_method("tiled").value();
  const auto cull_bytes = [&](const char* capacity) {
    const Plan plan = make_plan(tiled, {.width = 640,
                                        .height = 360,
                                        .light_capacity = 1U << 20,
                                        .options = resolve_options(tiled, {{capacity}}).value(),
                                        .traits = test::LARGE_DEVICE})
                          .value();
    const Pass& cull = plan.passes.back();
    return bytes_of(cull.shader.c_str(), cull.constants);
  };
  EXPECT_EQ(cull_bytes("capacity=2048") - cull_bytes("capacity=1024"), 1024U * 4);
  EXPECT_EQ(cull_bytes("capacity=512"), 512U * 4 + 540);
}

TEST(SharedMemory, IsKnownOfEveryPass) {
  std::size_t with_shared = 0;
  test::every_plan(test::LARGE_DEVICE, [&](const Result<Plan>& plan) {
    if (!plan) return;
    for (const Pass& pass : test::all_passes(plan.value())) {
      if (pass.kind != PassKind::compute) continue;
      const std::uint64_t bytes = bytes_of(pass.shader.c_str(), pass.constants);
      EXPECT_LE(bytes, test::LARGE_DEVICE.shared_memory_bytes) << pass.name;
      with_shared += bytes > 0 ? 1 : 0;
    }
  });
  EXPECT_GT(with_shared, 1000U);
}

// A device that has a byte less is told how many the pass needs.
TEST(SharedMemory, TooLittleIsRefused) {
  const Method& lamplight = *find_method("lamplight").value();
  Problem problem{.width = 640,
                  .height = 360,
                  .light_capacity = 1U << 16,
                  .options = resolve_options(lamplight, {}).value(),
                  .traits = test::LARGE_DEVICE};
  const Plan plan = make_plan(lamplight, problem).value();
  const Pass& lists = plan.passes.back();
  const std::uint64_t bytes = bytes_of(lists.shader.c_str(), lists.constants);
  DeviceTraits less = test::LARGE_DEVICE;
  less.shared_memory_bytes = static_cast<std::uint32_t>(bytes);
  EXPECT_FALSE(plan_check(plan, less));
  less.shared_memory_bytes -= 1;
  EXPECT_NE(plan_check(plan, less).value().text().find("needs " + std::to_string(bytes) + " bytes of shared memory"),
            std::string::npos);
}

}  // namespace
}  // namespace lamp
