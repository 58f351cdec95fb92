// The camera: checks, projections, and the way from a depth sample back to a position.
// Based on: Reed, Depth Precision Visualized (2015), for reversed depth with an infinite far plane.
// Promise: every number of a View is a 32-bit value; what is derived from them is double precision.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace lamp {
namespace {

// How far the columns of a rotation may be from orthonormal: 32-bit matrices that went through a few products stay
// well below it, a scale of a tenth of a per cent does not.
constexpr double RIGID_TOLERANCE = 1e-4;

std::string entry(std::string_view matrix, int column, int row) {
  std::ostringstream text;
  text << matrix << '[' << column << "][" << row << ']';
  return text.str();
}

// Rounds to 32 bits, or names the first entry that is no finite 32-bit number.
std::optional<Error> round_to_float(std::string_view name, DMat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      double& value = matrix[column][row];
      if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        std::ostringstream text;
        text << entry(name, column, row) << " must be a finite 32-bit number, got " << value;
        return Error{"view", text.str()};
      }
      value = static_cast<double>(static_cast<float>(value));
    }
  }
  return std::nullopt;
}

// clip.z = a z + b and clip.w = c z + d, so device depth grows towards the eye if and only if a d - b c > 0.
double depth_slope(const DMat4& p) { return p[2][2] * p[3][3] - p[3][2] * p[2][3]; }

std::optional<Error> check_projection(const DMat4& p) {
  constexpr std::array<std::array<int, 2>, 6> ZEROS{{{0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 2}, {1, 3}}};
  for (const auto [column, row] : ZEROS) {
    if (p[column][row] != 0.0) {
      std::ostringstream text;
      text << entry("clip_from_view", column, row) << " must be 0 (no shear), got " << p[column][row];
      return Error{"view", text.str()};
    }
  }
  if (p[0][0] == 0.0 || p[1][1] == 0.0 || depth_slope(p) == 0.0) {
    return Error{"view", "clip_from_view must be invertible, got a singular matrix"};
  }
  if (p[2][3] > 0.0 || (p[2][3] == 0.0 && p[3][3] < 0.0)) {
    return Error{"view", "clip_from_view must look down -Z (clip.w > 0 ahead of the eye), got the opposite"};
  }
  return std::nullopt;
}

std::optional<Error> check_rigid(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    if (m[column][3] != (column == 3 ? 1.0 : 0.0)) {
      std::ostringstream text;
      text << entry("view_from_world", column, 3) << " must be " << (column == 3 ? 1 : 0) << ", got " << m[column][3];
      return Error{"view", text.str()};
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double product = glm::dot(glm::dvec3(m[i]), glm::dvec3(m[j]));
      if (std::abs(product - (i == j ? 1.0 : 0.0)) > RIGID_TOLERANCE) {
        std::ostringstream text;
        text << "view_from_world must be rigid: columns " << i << " and " << j << " must have a dot product of "
             << (i == j ? 1 : 0) << ", got " << product;
        return Error{"view", text.str()};
      }
    }
  }
  return std::nullopt;
}

// A length becomes one between the least and the greatest singular value of `m`; their squares less 1 are eigenvalues
// of transpose(m) m - 1, and no eigenvalue is larger than the largest sum of a row's magnitudes (Gershgorin).
double stretch_of(const glm::dmat3& m) {
  const glm::dmat3 deviation = glm::transpose(m) * m - glm::dmat3(1.0);
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 row = glm::abs(deviation[i]);
    largest = std::max(largest, row.x + row.y + row.z);
  }
  return 1.0 - std::sqrt(1.0 - largest);  // the greatest deviates less: sqrt(1 + largest) - 1
}

bool is_finite(double m) { return std::abs(m) < INFINITE_FAR; }  // false for a NaN

bool has_area(const Window& window) { return window.left < window.right && window.bottom < window.top; }

DMat4 no_projection() {
  DMat4 p{};
  p[0][0] = std::numeric_limits<double>::quiet_NaN();
  return p;
}

}  // namespace

Result<View> View::create(std::uint32_t width, std::uint32_t height, const DMat4& clip_from_view,
                          const DMat4& view_from_world) {
  if (width == 0 || height == 0) {
    return Error{"view", "the size must be at least 1x1, got " + std::to_string(width) + "x" + std::to_string(height)};
  }
  View view;
  view.width_ = width;
  view.height_ = height;
  view.clip_from_view_ = clip_from_view;
  view.view_from_world_ = view_from_world;
  if (auto error = round_to_float("clip_from_view", view.clip_from_view_)) return *error;
  if (auto error = round_to_float("view_from_world", view.view_from_world_)) return *error;
  if (auto error = check_projection(view.clip_from_view_)) return *error;
  if (auto error = check_rigid(view.view_from_world_)) return *error;
  view.world_from_view_ = glm::inverse(glm::dmat4(view.view_from_world_));
  view.reversed_depth_ = depth_slope(view.clip_from_view_) > 0.0;
  view.stretch_ = stretch_of(glm::dmat3(glm::dmat4(view.view_from_world_)));
  return view;
}

double View::z_view(double device_depth) const {
  const DMat4& p = clip_from_view_;
  return (p[3][2] - p[3][3] * device_depth) / (p[2][2] - p[2][3] * device_depth);
}

DVec3 View::view_position(DVec2 pixel, double z_view) const {
  const DMat4& p = clip_from_view_;
  const double z = -z_view;
  const double w = p[2][3] * z + p[3][3];
  const double ndc_x = 2.0 * pixel.x / width_ - 1.0;
  const double ndc_y = 2.0 * pixel.y / height_ - 1.0;
  return {(ndc_x * w - p[2][0] * z - p[3][0]) / p[0][0], (ndc_y * w - p[2][1] * z - p[3][1]) / p[1][1], z};
}

DVec3 View::world_position(std::uint32_t x, std::uint32_t y, double device_depth) const {
  const glm::dvec3 position = view_position({x + 0.5, y + 0.5}, z_view(device_depth));
  return glm::dvec3(glm::dmat4(world_from_view_) * glm::dvec4(position, 1.0));
}

shared::Frame View::frame(std::uint32_t light_count, std::uint32_t light_capacity) const {
  shared::Frame frame{};
  frame.clip_from_view = Mat4(clip_from_view_);
  frame.view_from_world = Mat4(view_from_world_);
  frame.world_from_view = Mat4(world_from_view_);
  frame.eye_world = glm::vec3(glm::dmat4(world_from_view_)[3]);
  frame.light_count = light_count;
  frame.light_capacity = light_capacity;
  frame.size_px = {width_, height_};
  frame.stretch = static_cast<float>(stretch_);
  frame.sky_bits = std::bit_cast<std::uint32_t>(sky_depth());
  return frame;
}

DMat4 perspective(const Window& window, double near_m, double far_m) {
  const bool is_ahead = near_m > 0.0 && near_m < far_m;  // false for a NaN
  if (!has_area(window) || !is_ahead) return no_projection();
  const double width = window.right - window.left;
  const double height = window.top - window.bottom;
  const bool is_endless = !is_finite(far_m);
  DMat4 p{};
  p[0][0] = 2.0 / width;
  p[1][1] = -2.0 / height;
  p[2][0] = (window.right + window.left) / width;
  p[2][1] = -(window.top + window.bottom) / height;
  p[2][2] = is_endless ? 0.0 : near_m / (far_m - near_m);
  p[2][3] = -1.0;
  p[3][2] = is_endless ? near_m : near_m * (far_m / (far_m - near_m));
  return p;
}

DMat4 orthographic(const Window& window, double near_m, double far_m) {
  if (!has_area(window) || !(near_m < far_m) || !is_finite(near_m) || !is_finite(far_m)) return no_projection();
  const double width = window.right - window.left;
  const double height = window.top - window.bottom;
  DMat4 p{};
  p[0][0] = 2.0 / width;
  p[1][1] = -2.0 / height;
  p[2][2] = 1.0 / (far_m - near_m);
  p[3][0] = -(window.right + window.left) / width;
  p[3][1] = (window.top + window.bottom) / height;
  p[3][2] = far_m / (far_m - near_m);
  p[3][3] = 1.0;
  return p;
}

DMat4 flip_depth(const DMat4& clip_from_view) {
  DMat4 p = clip_from_view;
  for (int column = 0; column < 4; ++column) p[column][2] = p[column][3] - p[column][2];  // depth becomes 1 - depth
  return p;
}

Window symmetric_window(double fov_y, double aspect) {
  const double top = std::tan(0.5 * fov_y);
  return {.left = -top * aspect, .right = top * aspect, .bottom = -top, .top = top};
}

}  // namespace lamp
