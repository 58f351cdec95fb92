// Cameras as other engines have them, made into views as docs/your-renderer-differs.md says: what such an engine draws
// at a pixel is where the view says that it is. And what is said of cameras that were handed over as they are.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "lamplight/view.h"

namespace {

constexpr std::uint32_t WIDTH = 320;
constexpr std::uint32_t HEIGHT = 180;

/// Right-handed, +Y up, a viewport that is turned over: NDC y is up.
glm::dmat4 projection_with_y_up() {
  return glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, 1.0)) *
         glm::dmat4(lamp::perspective(lamp::symmetric_window(0.9, double{WIDTH} / HEIGHT), 0.1, 500.0));
}

glm::dmat4 camera() {
  return glm::lookAt(glm::dvec3(3.0, 2.0, 7.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
}

/// Of an engine whose view space looks along +Z: depth from 0 to 1.
glm::dmat4 left_handed_projection() { return glm::perspectiveLH_ZO(0.9, double{WIDTH} / HEIGHT, 0.1, 500.0); }
glm::dmat4 left_handed_camera() {
  return glm::lookAtLH(glm::dvec3(3.0, 2.0, -7.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
}

/// Pixel and device depth of a point, as an engine draws it.
struct Drawn {
  glm::dvec2 pixel;
  double depth;
};
Drawn draw(const glm::dmat4& clip_from_world, const glm::dvec3& point, double y_of_ndc) {
  const glm::dvec4 clip = clip_from_world * glm::dvec4(point, 1.0);
  const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
  return {{(ndc.x + 1.0) * 0.5 * WIDTH, (y_of_ndc * ndc.y + 1.0) * 0.5 * HEIGHT}, ndc.z};
}

/// `y_of_ndc`: 1 where NDC y is down, as Vulkan has it; -1 where the viewport turns it over.
void expect_draws(const lamp::Result<lamp::View>& made, const glm::dmat4& clip_from_world, double y_of_ndc) {
  ASSERT_TRUE(made.ok()) << made.error().text();
  const lamp::View& view = made.value();
  for (const glm::dvec3 point : {glm::dvec3(0.0), {1.0, 2.5, 0.5}, {-2.0, 0.25, 1.0}}) {
    const Drawn drawn = draw(clip_from_world, point, y_of_ndc);
    const glm::dvec3 at = view.view_position(drawn.pixel, view.z_view(drawn.depth));
    EXPECT_LT(glm::distance(glm::dvec3(glm::dmat4(view.world_from_view()) * glm::dvec4(at, 1.0)), point), 1e-3);
  }
}

TEST(YourRenderer, ViewportOfNegativeHeight) {
  const glm::dmat4 your_projection = projection_with_y_up();
  const glm::dmat4 view_from_world = camera();
  glm::dmat4 clip_from_view = your_projection;
  for (int column = 0; column < 4; ++column) clip_from_view[column][1] = -clip_from_view[column][1];
  const auto view = lamp::View::create(WIDTH, HEIGHT, clip_from_view, view_from_world);
  expect_draws(view, your_projection * view_from_world, -1.0);
}

TEST(YourRenderer, LooksAlongPlusZ) {
  const glm::dmat4 your_projection = left_handed_projection();
  const glm::dmat4 your_camera = left_handed_camera();
  const glm::dmat4 turn = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, -1.0));
  const auto view = lamp::View::create(WIDTH, HEIGHT, your_projection * turn, turn * your_camera);
  expect_draws(view, your_projection * your_camera, 1.0);
  EXPECT_FALSE(view.value().reversed_depth());
  EXPECT_EQ(lamp::View::create(WIDTH, HEIGHT, your_projection, your_camera).error().text(),
            "view: clip_from_view must look down -Z (clip.w > 0 ahead of the eye), got the opposite");
}

TEST(YourRenderer, HasRowsOneAfterTheOther) {
  const glm::dmat4 projection = lamp::perspective(lamp::symmetric_window(0.9, double{WIDTH} / HEIGHT), 0.1, 500.0);
  std::array<float, 16> your_projection{};
  std::array<float, 16> your_camera{};
  for (int i = 0; i < 16; ++i) {
    your_projection[i] = static_cast<float>(projection[i % 4][i / 4]);
    your_camera[i] = static_cast<float>(camera()[i % 4][i / 4]);
  }
  const auto clip_from_view = lamp::DMat4::from_rows(your_projection.data());
  const auto view_from_world = lamp::DMat4::from_rows(your_camera.data());
  const auto view = lamp::View::create(WIDTH, HEIGHT, clip_from_view, view_from_world);
  expect_draws(view, projection * camera(), 1.0);
  const auto wrong_projection =
      lamp::View::create(WIDTH, HEIGHT, glm::dmat4(glm::make_mat4(your_projection.data())), view_from_world);
  EXPECT_EQ(wrong_projection.error().text(),
            "view: clip_from_view must look down -Z (clip.w > 0 ahead of the eye), got the opposite");
  const auto wrong_camera =
      lamp::View::create(WIDTH, HEIGHT, clip_from_view, glm::dmat4(glm::make_mat4(your_camera.data())));
  EXPECT_EQ(wrong_camera.error().text().substr(0, 22), "view: view_from_world[");
}

TEST(YourRenderer, HasBothMatricesInOne) {
  const auto view = lamp::View::create(WIDTH, HEIGHT, projection_with_y_up() * camera(), glm::dmat4(1.0));
  ASSERT_FALSE(view.ok());
  EXPECT_NE(view.error().text().find("(no shear)"), std::string::npos) << view.error().text();
}

}  // namespace
