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

/// Instances of 36 vertices, which the vertex shader makes without buffers (shaders/box.glsl).
constexpr std::uint32_t BOXES = 65;
constexpr std::uint32_t BOX_VERTICES = 36;

using glm::vec3;
#include "shaders/host_light.h"
[[nodiscard]] std::vector<HostLight> make_lights(std::uint32_t count, std::uint32_t frame);

[[nodiscard]] glm::dmat4 view_from_world();
/// What lies in a window, whose edges are those at 1 m ahead. Depth is 1 at 0.1 m and 0 at 100 m; y points down.
[[nodiscard]] glm::dmat4 reversed_projection(double left, double right, double bottom, double top);

/// Red, green and blue, linear; and how many lights the pixel's shader walked.
using Pixels = std::span<const glm::vec4>;
/// Prints how far the pictures differ, and how many lights were walked. False where a colour differs by more than
/// 0.0001, where the picture is dark, or where more than half of the lights were walked after all.
/// `file`: a PPM of the culled picture, unless empty.
[[nodiscard]] bool compare(Pixels culled, Pixels brute_force, const std::string& file, std::uint32_t width);

/// Calls `run` with the file for the picture, if the command line names one, and prints what it throws. Returns 0 if
/// `run` returned true, 77 if the device lacks a feature, else 1.
int run_example(int argc, char** argv, bool (*run)(const std::string& file));
