// Random numbers, vectors and directions of tests: the same in every run, with every standard library.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <random>

namespace lamp::test {

template <class Scalar>
class RandomOf {
 public:
  using Vector = glm::vec<3, Scalar>;

  explicit RandomOf(std::uint64_t seed) : engine_(seed) {}

  Scalar in(Scalar low, Scalar high) {
    return static_cast<Scalar>(low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  Vector vector(Scalar half) {
    const Scalar x = in(-half, half);
    const Scalar y = in(-half, half);
    return {x, y, in(-half, half)};
  }
  Vector direction() {
    Vector v;
    do v = vector(Scalar{1});
    while (glm::dot(v, v) > Scalar{1} || glm::dot(v, v) < static_cast<Scalar>(0.01));
    return glm::normalize(v);
  }

 private:
  std::mt19937_64 engine_;
};

using Random = RandomOf<float>;
using RandomDoubles = RandomOf<double>;

}  // namespace lamp::test
