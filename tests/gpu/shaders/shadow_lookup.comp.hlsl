// shadow_lookup.comp in HLSL.
// SPDX-License-Identifier: Apache-2.0
#define SHADOW_FIRST_BINDING 2
#define SHADOW_FIRST_CONSTANT 0
#include "shadow/shadow.hlsl"
#include "shadow_case.h"

[[vk::binding(0, 0)]] StructuredBuffer<ShadowCase> cases;
[[vk::binding(1, 0)]] RWStructuredBuffer<float> lit;

[numthreads(64, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
  const uint i = thread.x;
  lit[i] = shadow_of(cases[i].light, cases[i].position, cases[i].normal, cases[i].seed);
}
