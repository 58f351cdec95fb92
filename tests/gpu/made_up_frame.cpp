// SPDX-License-Identifier: Apache-2.0
#include "gpu/made_up_frame.h"

#include <random>

namespace lamp::app {
namespace {

constexpr double NEAR_M = 0.1;

}  // namespace

View made_up_view(glm::uvec2 size, double turned) {
  const glm::dmat4 projection =
      perspective(symmetric_window(1.0, static_cast<double>(size.x) / size.y), NEAR_M, INFINITE_FAR);
  return View::create(size.x, size.y, projection, glm::rotate(glm::dmat4(1.0), turned, {0.0, 1.0, 0.0})).value();
}

float made_up_depth(glm::uvec2 pixel, std::uint32_t shift) {
  const std::uint32_t block = pixel.x / 5 * 31 + pixel.y / 3 * 17 + shift;
  return block % 11 == 0 ? 0.0F : static_cast<float>(NEAR_M / (4.0 + (block % 23) / 8.0));
}

std::vector<float> made_up_depths(glm::uvec2 size, std::uint32_t shift) {
  std::vector<float> depths;
  for (std::uint32_t y = 0; y < size.y; ++y)
    for (std::uint32_t x = 0; x < size.x; ++x) depths.push_back(made_up_depth({x, y}, shift));
  return depths;
}

std::vector<shared::Light> scattered_lights(const View& view, std::uint32_t count) {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    const glm::dvec2 pixel(unit() * view.width(), unit() * view.height());
    light.position = glm::vec3(view.view_position(pixel, 0.5 + 12.0 * unit()));
    light.range = static_cast<float>(0.2 + unit());
    if (unit() < 0.7) continue;
    light.type = LightType::spot;
    light.direction = glm::vec3{unit() - 0.5, unit() - 0.5, -unit()};
    light.outer_angle = static_cast<float>(0.1 + unit());
  }
  return pack(lights);
}

}  // namespace lamp::app
