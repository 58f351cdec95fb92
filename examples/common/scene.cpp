// The scene, its pictures, and what surrounds an example's `run`.
// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <stdexcept>
#include <string_view>

#include "gpu.h"

std::vector<Box> make_boxes() {
  std::vector<Box> boxes{{{0, -0.5F, 0}, 0, {14, 0.5F, 14}, 0}};
  for (int z = 0; z < 8; ++z)
    for (int x = 0; x < 8; ++x) {
      const float height = 0.3F + 0.35F * static_cast<float>((x * 5 + z * 3) % 7);
      const float width = 0.35F + 0.05F * static_cast<float>((x + 2 * z) % 4);
      boxes.push_back({{-10.5F + 3.0F * static_cast<float>(x), height, -10.5F + 3.0F * static_cast<float>(z)},
                       static_cast<std::uint32_t>(1 + (x + z) % 4),
                       {width, height, width},
                       0});
    }
  return boxes;
}

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
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 / (right - left);
  m[1][1] = 2.0 / (bottom - top);
  m[2] = {(right + left) / (right - left), (bottom + top) / (bottom - top), 0.0, -1.0};
  m[3][2] = 0.1;
  return m;
}

bool compare(Pixels culled, Pixels brute_force, float tolerance) {
  float difference = 0.0F;
  glm::dvec4 mean(0.0);
  glm::dvec4 mean_of_all(0.0);
  for (std::size_t i = 0; i < culled.size(); ++i) {
    const glm::vec3 d = glm::abs(glm::vec3(culled[i]) - glm::vec3(brute_force[i]));
    const float largest = std::max({d.x, d.y, d.z});
    if (!(largest <= difference)) difference = largest;  // also what is not a number
    mean += glm::dvec4(culled[i]) / static_cast<double>(culled.size());
    mean_of_all += glm::dvec4(brute_force[i]) / static_cast<double>(culled.size());
  }
  std::printf("walked %.1f lights a pixel instead of %.1f; mean green %.3f, largest difference %g\n", mean.w,
              mean_of_all.w, mean_of_all.y, static_cast<double>(difference));
  return difference <= tolerance && mean_of_all.y > 0.05 && mean.w > 0.0 && mean.w < 0.5 * mean_of_all.w;
}

void write_picture(const Options& options, std::uint32_t width, Pixels pixels) {
  if (options.ppm.empty()) return;
  std::ofstream file(options.ppm, std::ios::binary);
  file << "P6\n" << width << ' ' << pixels.size() / width << "\n255\n";
  for (const glm::vec4& pixel : pixels)
    for (int i = 0; i < 3; ++i) {
      const float c = std::clamp(pixel[i], 0.0F, 1.0F);
      const float encoded = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
      file.put(static_cast<char>(std::lround(255.0F * encoded)));
    }
  if (!file.flush()) throw std::runtime_error(options.ppm + ": cannot be written");
}

int run_example(int argc, char** argv, bool (*run)(const Options& options)) {
  try {
    Options options;
    for (int i = 1; i < argc; ++i) {
      const std::string_view argument = argv[i];
      if (argument == "--validate")
        options.validate = true;
      else if (argument == "--ppm" && i + 1 < argc)
        options.ppm = argv[++i];
      else
        throw std::runtime_error("usage: [--validate] [--ppm FILE], got " + std::string(argument));
    }
    return run(options) ? 0 : 1;
  } catch (const LacksFeature& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 77;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}
