// Samples of a pixel lie spread over it, and a shifted view shows there what the view shows at its centre.
// SPDX-License-Identifier: Apache-2.0
#include "render/antialias.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/flight.h"

namespace lamp::app {
namespace {

TEST(Antialias, SamplesAreSpreadOverThePixel) {
  EXPECT_EQ(sample_offset(0), glm::dvec2(0.0));
  for (const std::uint32_t count : {4U, 16U, 64U}) {
    glm::dvec2 sum(0.0);
    std::array<std::uint32_t, 4> quarters{};
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::dvec2 offset = sample_offset(i);
      EXPECT_TRUE(offset.x > -0.5 && offset.x < 0.5 && offset.y > -0.5 && offset.y < 0.5)
          << offset.x << " " << offset.y;
      for (std::uint32_t other = 0; other < i; ++other) EXPECT_NE(offset, sample_offset(other));
      sum += offset;
      ++quarters[(offset.x < 0.0 ? 0 : 1) + (offset.y < 0.0 ? 0 : 2)];
    }
    EXPECT_LT(glm::length(sum) / count, 0.5 / std::sqrt(count));
    for (const std::uint32_t samples : quarters) EXPECT_GE(samples, count / 8);
  }
}

TEST(Antialias, AShiftedViewIsShiftedUnderEveryProjection) {
  constexpr glm::dvec2 OFFSET(0.25, -0.375);
  for (const std::string_view projection : {"perspective", "infinite", "orthographic", "off-centre"}) {
    SCOPED_TRACE(projection);
    const View view = view_of(Camera{}, 640, 360, projection);
    const View moved = shifted(view, OFFSET);
    for (const double z : {0.5, 3.0, 40.0}) {
      const glm::dvec3 here = view.view_position(glm::dvec2(100.0, 50.0) + OFFSET, z);
      const glm::dvec3 there = moved.view_position(glm::dvec2(100.0, 50.0), z);
      EXPECT_NEAR(glm::length(here - there), 0.0, 1e-6 * z + 1e-6);
    }
  }
}

}  // namespace
}  // namespace lamp::app
