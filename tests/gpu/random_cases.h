// Random numbers and directions of tests, the same in every run.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <random>

namespace lamp::app {

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float in(float low, float high) { return std::uniform_real_distribution(low, high)(engine_); }
  glm::vec3 direction() {
    glm::vec3 v;
    do v = {in(-1, 1), in(-1, 1), in(-1, 1)};
    while (glm::dot(v, v) > 1.0F || glm::dot(v, v) < 0.01F);
    return glm::normalize(v);
  }
  std::uint32_t below(std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(engine_);
  }

 private:
  std::mt19937 engine_;
};

}  // namespace lamp::app
