// What scalar walks ask of a subgroup, in GLSL's words; in HLSL it is called a wave.
// SPDX-License-Identifier: Apache-2.0
#ifndef LOOKUP_SUBGROUP
#define LOOKUP_SUBGROUP
#ifdef LAMP_HLSL

#define subgroupMin(value) WaveActiveMin(value)
#define subgroupMax(value) WaveActiveMax(value)
#define subgroupOr(value) WaveActiveBitOr(value)
#define subgroupBallot(value) WaveActiveBallot(value)
#define subgroupBroadcastFirst(value) WaveReadLaneFirst(value)

bool subgroupInverseBallot(uint4 ballot) {
  const uint thread = WaveGetLaneIndex();
  return (ballot[thread / 32u] >> (thread % 32u) & 1u) != 0u;
}

uint subgroupBallotBitCount(uint4 ballot) {
  const uint4 counts = countbits(ballot);
  return counts.x + counts.y + counts.z + counts.w;
}

uint subgroupBallotExclusiveBitCount(uint4 ballot) { return WavePrefixCountBits(subgroupInverseBallot(ballot)); }

#else
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#endif
#endif
