// Lights with maps of every kind, depths that nobody drew, and points around them that look-ups are asked for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gpu/dispatch.h"
#include "gpu/shaders/shadow_case.h"
#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"
#include "random.h"
#include "render/shadow_reach.h"

namespace lamp::app {

constexpr std::uint32_t LIT_ATLAS = 512;
constexpr std::uint32_t LIT_CASES = 64 * 2048;

struct LitLights {
  std::vector<shared::Light> lights;
  std::vector<shared::ShadowMap> maps;
};

/// Maps of every kind and of several sizes, the last one of a light that has moved since.
[[nodiscard]] LitLights some_lit_lights(ShadowFilter filter);
/// A spot that is wider than one square should show, in a small one: what a texel may light is wide, too.
[[nodiscard]] LitLights wide_lit_light(ShadowFilter filter);
/// A map with more large blocks than a work group of few threads holds at once.
[[nodiscard]] LitLights large_lit_light(ShadowFilter filter);
/// Walls at some metres that are whole over several cells, with holes and what stands before them.
[[nodiscard]] std::vector<float> some_wall_depths(test::Random& random);
/// Around where the walls are.
[[nodiscard]] std::vector<shared::ShadowCase> some_lit_cases(const LitLights& lit, test::Random& random);

/// What shadow_of says of each case.
[[nodiscard]] std::vector<float> shadows_of(const std::vector<shared::ShadowCase>& cases, const LitLights& lit,
                                            const GpuImage& atlas, ShadowFilter filter);
/// Makes radial bounds, or meshes, of all lights, as often as it is called.
void make_reach(ShadowReach& reach, const LitLights& lit, const GpuImage& atlas);
[[nodiscard]] ShadowReach reach_of(ShadowReach::Kind kind, const LitLights& lit, const GpuImage& atlas,
                                   ShadowFilter filter);

}  // namespace lamp::app
