// What a mirror ray meets, in double precision, and how far 32 bits may be from it.
// Based on: Higham, Accuracy and Stability of Numerical Algorithms (2002), chapter 3: a sum of products is off by as
// many roundings as it has operations, of the largest number in it. Promise: the reference meets the same sides, and
// the same holes, as a pixel shows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "render/bvh.h"
#include "render/scene_occluders.h"
#include "render/shaders/mirror_data.h"

namespace lamp::app {

/// How a ray's hit compares with what the reference meets.
enum class MirrorAnswer : std::uint8_t {
  same,
  unclear,  ///< another, but so does a reference that is off by rounding
  wrong
};

struct MirrorCompared {
  MirrorAnswer answer = MirrorAnswer::same;
  std::string fault;  ///< of one that is wrong, a few words
};

class MirrorReference {
 public:
  /// Both must outlive it; the hierarchy is that of the scene. `first_levels` of images: as rays read them.
  MirrorReference(const Scene& scene, const Bvh& bvh, std::span<const std::uint32_t> first_levels = {});

  /// `position`: of the surface that was made of the hit, m; of no meaning where the ray meets nothing.
  [[nodiscard]] MirrorCompared compare(const gpu::MirrorAsked& ray, const gpu::MirrorHit& hit,
                                       const glm::vec3& position) const;

 private:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  struct Line {
    glm::dvec3 origin;
    glm::dvec3 direction;
  };
  struct Met {
    double distance = NEVER;  ///< m; NEVER where nothing is met
    double cosine = 1.0;      ///< of the angle at which the ray comes in
    double numbers = 0.0;     ///< m: the largest that 32 bits round on the way to it
  };
  struct Found {
    double distance = NEVER;
    glm::dvec3 at{0.0};    ///< if there is something
    double numbers = 0.0;  ///< as above
    double placing = 0.0;  ///< m: the largest that is rounded between its place on its mesh and in the world
  };

  [[nodiscard]] Met first(const Line& line) const;
  [[nodiscard]] Found found_at(const Line& line, const gpu::MirrorHit& hit) const;
  [[nodiscard]] bool is_near(const Line& line, const Found& found, const Met& expected) const;

  Occluders occluders_;
  std::vector<DrawnSides> sides_;
  std::vector<glm::dvec3> origins_;  ///< of each instance's space in which rays meet its triangles, in the world, m
  const Bvh& bvh_;
  double reach_ = 1.0;     ///< m, of the scene
  double farthest_ = 1.0;  ///< m, from the origin
};

}  // namespace lamp::app
