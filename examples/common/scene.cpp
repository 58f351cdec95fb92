// The scene, its pictures, and what surrounds an example's `run`.
// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <glm/ext.hpp>
#include <glm/glm.hpp>
#include <random>
#include <stdexcept>
#include <vulkan/vulkan.hpp>

std::vector<HostLight> make_lights(std::uint32_t count, std::uint32_t frame) {
  std::mt19937 random(7);
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  std::vector<HostLight> lights(count);
  for (HostLight& light : lights) {
    const float angle = between(0.0F, 6.28F) + 0.3F * static_cast<float>(frame);
    const float radius = 14.0F * std::sqrt(between(0.0F, 1.0F));
    light.position = {radius * std::cos(angle), between(0.3F, 2.5F), radius * std::sin(angle)};
    light.range = between(1.0F, 2.5F);
    light.direction = glm::normalize(glm::vec3(between(-0.6F, 0.6F), -1.0F, between(-0.6F, 0.6F)));
    light.outer_angle = random() % 2 == 0 ? -1.0F : between(0.4F, 1.0F);
    light.color = glm::vec3(between(0.1F, 1.0F), between(0.1F, 1.0F), between(0.1F, 1.0F)) * light.range;
  }
  return lights;
}

glm::dmat4 view_from_world() { return glm::lookAt(glm::dvec3(4, 6, 15), glm::dvec3(0, 0.5, 1), glm::dvec3(0, 1, 0)); }

glm::dmat4 reversed_projection(double left, double right, double bottom, double top) {
  constexpr double NEAR = 0.1;
  constexpr double FAR = 100.0;  // in the place of the near plane
  return glm::frustumRH_ZO(left * FAR, right * FAR, top * FAR, bottom * FAR, FAR, NEAR);
}

bool compare(Pixels culled, Pixels brute_force, const std::string& file, std::uint32_t width) {
  glm::dvec4 mean(0.0);
  glm::dvec4 mean_of_all(0.0);
  float difference = 0.0F;
  bool same = true;
  for (std::size_t i = 0; i < culled.size(); ++i) {
    const glm::vec3 d = glm::abs(glm::vec3(culled[i] - brute_force[i]));
    difference = std::max({difference, d.x, d.y, d.z});
    same = same && glm::all(glm::lessThanEqual(d, glm::vec3(1e-4F)));  // fails for what is not a number, too
    mean += glm::dvec4(culled[i]) / static_cast<double>(culled.size());
    mean_of_all += glm::dvec4(brute_force[i]) / static_cast<double>(culled.size());
  }
  std::printf("walked %.1f lights a pixel instead of %.1f; mean green %.3f, largest difference %g\n", mean.w,
              mean_of_all.w, mean_of_all.y, static_cast<double>(difference));
  if (!file.empty()) {
    std::ofstream out(file, std::ios::binary);
    out << "P6\n" << width << ' ' << culled.size() / width << "\n255\n";
    for (const glm::vec4& pixel : culled) {
      const glm::vec4 near_srgb = 255.0F * glm::pow(glm::clamp(pixel, 0.0F, 1.0F), glm::vec4(1.0F / 2.2F)) + 0.5F;
      for (int i = 0; i < 3; ++i) out.put(static_cast<char>(near_srgb[i]));
    }
    if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
  }
  return same && mean_of_all.y > 0.05 && mean.w > 0.0 && mean.w < 0.5 * mean_of_all.w;
}

int run_example(int argc, char** argv, bool (*run)(const std::string& file)) {
  try {
    if (run(argc > 1 ? argv[1] : "")) return 0;
    std::fprintf(stderr, "%s: a picture or a number above is not as main.cpp expects it\n", argv[0]);
    return 1;
  } catch (const vk::FeatureNotPresentError&) {
    std::fprintf(stderr, "%s: the device lacks a feature that this example shows\n", argv[0]);
    return 77;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}
