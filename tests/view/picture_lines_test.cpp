// Lines over the picture, of cameras that look along -Z from the origin.
// SPDX-License-Identifier: Apache-2.0
#include "view/picture_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamp::app {
namespace {

constexpr Window WINDOW{-1.0, 1.0, -1.0, 1.0};

View view_of(const DMat4& projection) { return View::create(100, 100, projection, glm::dmat4(1.0)).value(); }

std::vector<View> all_views() {
  const DMat4 perspectives = perspective(WINDOW, 0.1, 100.0);
  const DMat4 parallel = orthographic(WINDOW, 0.1, 100.0);
  return {view_of(perspectives), view_of(flip_depth(perspectives)), view_of(parallel), view_of(flip_depth(parallel))};
}

TEST(PictureLines, NothingBehindTheEyeIsSeen) {
  for (const View& view : all_views()) {
    EXPECT_TRUE(place_in_picture(view, {0.0F, 0.0F, -1.0F}).has_value());
    EXPECT_FALSE(place_in_picture(view, {0.0F, 0.0F, 1.0F}).has_value());
    EXPECT_FALSE(line_in_picture(view, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 2.0F}).has_value());
  }
}

TEST(PictureLines, EdgesThatPassTheEyeAreCut) {
  for (const View& view : all_views()) {
    const glm::vec3 before(0.0F, 0.0F, -10.0F);
    const glm::vec3 behind(0.05F, 0.0F, 9.8F);
    const auto line = line_in_picture(view, before, behind);
    const auto back = line_in_picture(view, behind, before);
    ASSERT_TRUE(line && back);
    EXPECT_EQ(line->first, place_in_picture(view, before));
    EXPECT_EQ(line->second, back->first);
    // Half of the way, where it is 0.1 m ahead.
    EXPECT_NEAR(line->second.x, view.orthographic() ? 0.5125 : 0.625, 1e-4);
  }
}

/// From the eye to each of its points the line touches the sphere.
TEST(PictureLines, OutlineIsWhereLinesTouch) {
  const glm::vec3 center(1.0F, 0.5F, -3.0F);
  for (const View& view : all_views()) {
    const auto outline = outline_of_sphere(view, center, 1.5F);
    ASSERT_TRUE(outline.has_value());
    for (int i = 0; i < 8; ++i) {
      const auto angle = static_cast<float>(i);
      const glm::vec3 at = outline->center + std::cos(angle) * outline->u + std::sin(angle) * outline->v;
      EXPECT_NEAR(glm::distance(at, center), 1.5F, 1e-5F);
      const glm::vec3 way = view.orthographic() ? glm::vec3(0.0F, 0.0F, -1.0F) : at;
      EXPECT_NEAR(glm::dot(at - center, glm::normalize(way)), 0.0F, 1e-5F);
    }
  }
  EXPECT_FALSE(outline_of_sphere(all_views().front(), center, 4.0F).has_value());
}

}  // namespace
}  // namespace lamp::app
