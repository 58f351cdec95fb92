// Packs and unpacks G-buffer texels in double precision.
// Based on: octahedral normals: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
// JCGT 3:2 (2014); IEC 61966-2-1 (sRGB); the rounding rules of the Vulkan specification's packing built-ins.
// SPDX-License-Identifier: Apache-2.0
#include "render/gbuffer_texels.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace lamp::app {
namespace {

constexpr double SNORM16 = 32767.0;
constexpr double UNORM8 = 255.0;

double linear_of(std::uint8_t srgb) {
  const double s = srgb / UNORM8;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::uint8_t srgb_of(double linear) {
  const double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(std::clamp(s, 0.0, 1.0) * UNORM8));
}

double sign_of(double value) { return value >= 0.0 ? 1.0 : -1.0; }

std::uint32_t packed_normal(const glm::dvec3& n) {
  glm::dvec2 p = glm::dvec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  if (n.z < 0.0) p = {(1.0 - std::abs(p.y)) * sign_of(p.x), (1.0 - std::abs(p.x)) * sign_of(p.y)};
  const auto code = [](double value) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(std::lround(value * SNORM16)));
  };
  return code(p.x) | code(p.y) << 16U;
}

glm::vec3 unpacked_normal(std::uint32_t packed) {
  const auto value = [](std::uint32_t code) {
    return std::max(static_cast<std::int16_t>(static_cast<std::uint16_t>(code)) / SNORM16, -1.0);
  };
  const glm::dvec2 p(value(packed & 0xFFFFU), value(packed >> 16U));
  glm::dvec3 n(p, 1.0 - std::abs(p.x) - std::abs(p.y));
  const double fold = std::max(-n.z, 0.0);
  n.x -= sign_of(n.x) * fold;
  n.y -= sign_of(n.y) * fold;
  return glm::vec3(glm::normalize(n));
}

std::uint32_t packed_factors(const glm::vec3& factors) {
  std::uint32_t packed = 0;
  for (int i = 0; i < 3; ++i)
    packed |= static_cast<std::uint32_t>(std::lround(static_cast<double>(factors[i]) * UNORM8)) << (8 * i);
  return packed;
}

glm::vec3 unpacked_factors(std::uint32_t packed) {
  glm::vec3 factors;
  for (int i = 0; i < 3; ++i) factors[i] = static_cast<float>((packed >> (8 * i) & 0xFFU) / UNORM8);
  return factors;
}

}  // namespace

GBufferTexels encode(const CapturedFrame& frame) {
  const std::size_t pixels = frame.depth.size();
  GBufferTexels texels{.depth = frame.depth,
                       .base_color = std::vector<glm::u8vec4>(pixels, glm::u8vec4(0)),
                       .surface = std::vector<glm::uvec2>(pixels, glm::uvec2(0)),
                       .emission = std::vector<glm::u16vec4>(pixels, glm::u16vec4(0))};
  for (std::size_t i = 0; i < pixels; ++i) {
    if (frame.depth[i] == 0.0F) continue;
    const glm::vec3& albedo = frame.albedo[i];
    const glm::vec3& emission = frame.emission[i];
    texels.base_color[i] = {srgb_of(albedo.r), srgb_of(albedo.g), srgb_of(albedo.b), 255};
    texels.surface[i] = {packed_normal(glm::dvec3(frame.normal[i])), packed_factors(frame.material[i])};
    texels.emission[i] = {glm::packHalf1x16(emission.r), glm::packHalf1x16(emission.g), glm::packHalf1x16(emission.b),
                          glm::packHalf1x16(1.0F)};
  }
  return texels;
}

CapturedFrame decode(const View& view, const GBufferTexels& texels) {
  const std::size_t pixels = texels.depth.size();
  CapturedFrame frame{.view = view,
                      .depth = texels.depth,
                      .albedo = std::vector<glm::vec3>(pixels, glm::vec3(0.0F)),
                      .normal = std::vector<glm::vec3>(pixels, glm::vec3(0.0F)),
                      .material = std::vector<glm::vec3>(pixels, glm::vec3(0.0F)),
                      .emission = std::vector<glm::vec3>(pixels, glm::vec3(0.0F))};
  for (std::size_t i = 0; i < pixels; ++i) {
    if (texels.depth[i] == 0.0F) continue;
    const glm::u8vec4& color = texels.base_color[i];
    const glm::u16vec4& emission = texels.emission[i];
    frame.albedo[i] = {linear_of(color.r), linear_of(color.g), linear_of(color.b)};
    frame.normal[i] = unpacked_normal(texels.surface[i].x);
    frame.material[i] = unpacked_factors(texels.surface[i].y);
    frame.emission[i] = {glm::unpackHalf1x16(emission.r), glm::unpackHalf1x16(emission.g),
                         glm::unpackHalf1x16(emission.b)};
  }
  return frame;
}

}  // namespace lamp::app
