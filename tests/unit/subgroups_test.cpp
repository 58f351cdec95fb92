// Subgroups as devices have them: operations that are missing, in one stage or both, and sizes from 4 to 128 threads.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lamplight/method.h"
#include "lamplight/shader_code.h"
#include "unit/devices.h"
#include "unit/every_plan.h"

namespace {

using lamp::DeviceTraits;
using lamp::Method;
using lamp::Pass;
using lamp::Plan;
using lamp::SubgroupOperations;
using lamp::test::all_passes;
using lamp::test::every_plan;

SubgroupOperations asked_by(const Pass& pass) {
  return lamp::subgroup_operations(lamp::find_shader(lamp::library_shaders(), pass.shader)->spirv);
}

struct Operation {
  const char* name;
  bool SubgroupOperations::* there;
};
constexpr Operation OPERATIONS[] = {{"votes", &SubgroupOperations::vote},
                                    {"ballot", &SubgroupOperations::ballot},
                                    {"arithmetic", &SubgroupOperations::arithmetic},
                                    {"shuffle", &SubgroupOperations::shuffle},
                                    {"relative shuffle", &SubgroupOperations::shuffle_relative}};

// Each is needed by some shader of the library, or there were no need to know whether a device has it.
TEST(Subgroups, NoPlanAsksForAnOperationThatTheDeviceLacks) {
  for (const Operation& operation : OPERATIONS) {
    SCOPED_TRACE(operation.name);
    DeviceTraits traits = lamp::test::LARGE_DEVICE;
    traits.compute_subgroups.*operation.there = traits.fragment_subgroups.*operation.there = false;
    int refused = 0;
    every_plan(traits, [&](const lamp::Result<Plan>& plan) {
      if (!plan) {
        const std::string reason = std::string("needs the subgroup operation ") + operation.name + ", which";
        if (plan.error().text().find(reason) != std::string::npos) ++refused;
        return;
      }
      for (const Pass& pass : all_passes(plan.value()))
        EXPECT_FALSE(pass.kind != lamp::PassKind::host && asked_by(pass).*operation.there) << pass.name;
    });
    EXPECT_GT(refused, 0);
  }
}

TEST(Subgroups, AStageWithoutThemIsNotAskedForThem) {
  DeviceTraits traits = lamp::test::LARGE_DEVICE;
  traits.fragment_subgroups = {};
  bool has_scalar_walk = false;
  int plans = 0;
  every_plan(traits, [&](const lamp::Result<Plan>& plan) {
    if (!plan) return;
    ++plans;
    has_scalar_walk = has_scalar_walk || plan.value().lookup.name.ends_with("_scalar");
    for (const Pass& pass : all_passes(plan.value()))
      EXPECT_TRUE(pass.kind != lamp::PassKind::raster || asked_by(pass) == SubgroupOperations{}) << pass.name;
  });
  EXPECT_FALSE(has_scalar_walk) << "fragment shaders walk as well";
  EXPECT_GT(plans, 100);
}

TEST(Subgroups, ReducingWithoutThemIsSaid) {
  const Method& primal = *lamp::find_method("primal").value();
  const auto notes = [&](const DeviceTraits& traits) {
    return lamp::make_plan(primal, {.width = 64,
                                    .height = 64,
                                    .light_capacity = 100,
                                    .options = lamp::resolve_options(primal, {}).value(),
                                    .traits = traits})
        .value()
        .notes;
  };
  EXPECT_TRUE(notes(lamp::test::LARGE_DEVICE).empty());
  ASSERT_EQ(notes(lamp::test::LEAST_DEVICE).size(), 1U);
  EXPECT_TRUE(notes(lamp::test::LEAST_DEVICE)[0].starts_with("reduce=atomic instead of subgroup"));
}

// Whoever shuffles counts on all threads of a subgroup. Work groups are then whole subgroups, however large these are.
TEST(Subgroups, AreFullWhereShadersCountOnIt) {
  for (const std::uint32_t size : {4U, 8U, 16U, 32U, 64U, 128U}) {
    SCOPED_TRACE(size);
    DeviceTraits traits = lamp::test::LARGE_DEVICE;
    traits.max_group_invocations = std::max(128U, size);
    traits.subgroup_size = std::min(size, 32U);  // some devices choose a size for each pipeline
    traits.max_subgroup_size = size;
    int full = 0;
    every_plan(traits, [&](const lamp::Result<Plan>& plan) {
      if (!plan) return;
      for (const Pass& pass : all_passes(plan.value())) {
        if (pass.kind != lamp::PassKind::compute) continue;
        const bool shuffles = asked_by(pass).shuffle || asked_by(pass).shuffle_relative;
        EXPECT_TRUE(!shuffles || pass.full_subgroups != 0) << pass.name;
        if (pass.full_subgroups == 0) continue;
        ++full;
        EXPECT_EQ(pass.full_subgroups, pass.constants[0]) << pass.name << ": constant 0 is the work group's size";
        EXPECT_EQ(pass.full_subgroups % size, 0U) << pass.name;
        EXPECT_LE(pass.full_subgroups, traits.max_group_invocations) << pass.name;
      }
    });
    EXPECT_GT(full, 100);
  }
}

TEST(Subgroups, LargerThanAWorkGroupMayBeAreRefused) {
  DeviceTraits traits = lamp::test::LARGE_DEVICE;
  traits.max_group_invocations = 128;
  traits.max_subgroup_size = 256;
  const Method& method = *lamp::find_method("lamplight").value();
  const auto plan = lamp::make_plan(method, {.width = 64,
                                             .height = 64,
                                             .light_capacity = 4096,
                                             .options = lamp::resolve_options(method, {}).value(),
                                             .traits = traits});
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().text().find("must be full subgroups of up to 256"), std::string::npos) << plan.error().text();
}

}  // namespace
