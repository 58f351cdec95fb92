// The scene of all examples: a floor with columns, and coloured lights that circle above it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

/// An instance of 36 vertices, drawn without vertex buffers (shaders/box.glsl).
struct Box {
  glm::vec3 center;
  std::uint32_t material;
  glm::vec3 half_extent;
  std::uint32_t reserved;
};
[[nodiscard]] std::vector<Box> make_boxes();

/// The examples' own light record (shaders/lighting.glsl). World space, metres, radians.
struct HostLight {
  glm::vec3 position;
  float range;
  glm::vec3 direction;
  float outer_angle;  ///< half-angle of a spot's cone; negative: a point light
  glm::vec3 color;    ///< candela
  float reserved;
};
[[nodiscard]] std::vector<HostLight> make_lights(std::uint32_t count, std::uint32_t frame);

[[nodiscard]] glm::dmat4 view_from_world();
/// What lies in a window, whose edges are those at 1 m ahead. Depth is 1 at 0.1 m and 0 infinitely far; y points down.
[[nodiscard]] glm::dmat4 reversed_projection(double left, double right, double bottom, double top);

/// Red, green and blue, linear; and how many lights the pixel's shader walked.
using Pixels = std::span<const glm::vec4>;

/// Prints how far the pictures differ, and how many lights were walked. False where a colour differs by more than
/// `tolerance`, where the picture is dark, or where more than half of the lights were walked after all.
[[nodiscard]] bool compare(Pixels culled, Pixels brute_force, float tolerance);

struct Options {
  std::string ppm;        ///< a file to write, or none
  bool validate = false;  ///< with the validation layer: every message is an error
};
/// Encodes to sRGB and writes the file that the options name, if they do.
void write_picture(const Options& options, std::uint32_t width, Pixels pixels);

/// Reads the options, calls `run`, prints what it throws. Exit code 0: it returned true; 77: LacksFeature.
int run_example(int argc, char** argv, bool (*run)(const Options& options));
