// Random numbers for procedural scenes: the same on every machine and compiler.
// Based on: O'Neill, PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms, 2014 (XSH-RR 64/32).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace lamp::app::procedural {

/// A sequence of random numbers; the seed names the sequence.
class Random {
 public:
  explicit Random(std::uint64_t seed) : increment_((seed << 1U) | 1U) {
    bits();
    state_ += seed;
    bits();
  }

  /// 32 uniform bits.
  std::uint32_t bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto turn = static_cast<std::uint32_t>(old >> 59U);
    return (mixed >> turn) | (mixed << ((32U - turn) & 31U));
  }

  /// Uniform in [0, 1).
  float unit() { return static_cast<float>(bits() >> 8U) * 0x1p-24F; }

  /// Uniform in [low, high).
  float between(float low, float high) { return low + (high - low) * unit(); }

  /// Uniform in 0 .. count - 1; count > 0.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits()) * count) >> 32U);
  }

  /// True with that probability.
  bool chance(float probability) { return unit() < probability; }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

/// A number in [0, 1) that depends on the three numbers alone.
/// The mixer is the finalizer of MurmurHash3 (Appleby, public domain).
inline float hash_unit(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = x * 0x9E3779B9U ^ (y * 0x85EBCA6BU + 0x7F4A7C15U) ^ (seed * 0xC2B2AE35U + 0x165667B1U);
  for (std::uint32_t round = 0; round < 2; ++round) {
    h = (h ^ (h >> 16U)) * 0x85EBCA6BU;
    h = (h ^ (h >> 13U)) * 0xC2B2AE35U;
    h ^= h >> 16U;
  }
  return static_cast<float>(h >> 8U) * 0x1p-24F;
}

}  // namespace lamp::app::procedural
