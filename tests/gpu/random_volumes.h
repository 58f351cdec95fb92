// Random views, tiles, and lights near a point of the tile: for property tests of everything that culls.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "gpu/shaders/volume_case.h"
#include "lamplight/light.h"
#include "lamplight/view.h"

namespace lamp::app {

/// A tile of a view between two depths, and the position of a pixel in it that has one of the depths.
struct RandomTile {
  shared::VolumeCase volume;
  glm::dvec3 position_world{0.0};
  float depth = 0.0F;  ///< device depth of the position
};

class RandomVolumes {
 public:
  explicit RandomVolumes(std::uint32_t seed) : random_(seed) {}

  /// Any projection (finite, infinite, off-centre, orthographic, leaning, with the near plane behind the eye), any
  /// rotation and what is rigid within tolerance, eyes up to 5 km from the origin.
  [[nodiscard]] View view();

  /// Pixels up to 5 km ahead of the eye, or behind it; often the slab has no thickness.
  [[nodiscard]] RandomTile tile(const View& view);

  /// A light that nearly always reaches the position, often only just: a point light, or a spot with a half-angle of
  /// 0.1 to 90 degrees; ranges from 5 cm to 500 m.
  [[nodiscard]] Light light_reaching(const View& view, const glm::dvec3& position_world);

  /// The same kinds of lights, but anywhere around the position, up to ten ranges away.
  [[nodiscard]] Light light_around(const glm::dvec3& position_world);

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  std::uint32_t below(std::uint32_t end) { return std::uniform_int_distribution(0U, end - 1)(random_); }
  /// 0 .. 1, half of the time only just below 1.
  double share_near_one();
  glm::dvec3 unit_vector();
  glm::dmat4 projection(double aspect);
  Light light_at(const glm::dvec3& position, const glm::dvec3& towards);

  std::mt19937 random_;
};

/// Tiles of many views with a light each.
struct RandomBatch {
  std::vector<shared::Frame> frames;
  std::vector<RandomTile> tiles;  ///< `volume.frame` is one of the frames
  std::vector<shared::Light> lights;
};

enum class Lights : std::uint8_t { reaching, around };  ///< of RandomVolumes

[[nodiscard]] RandomBatch draw_batch(std::uint32_t seed, std::uint32_t tiles, Lights kind);

}  // namespace lamp::app
