// From linear radiance to eight-bit sRGB: automatic exposure, a filmic curve, the sRGB transfer function.
// Based on: Reinhard, Stark, Shirley, Ferwerda, Photographic Tone Reproduction for Digital Images, SIGGRAPH 2002,
// section 3.1; Narkowicz, ACES Filmic Tone Mapping Curve, 2016; IEC 61966-2-1 (sRGB); ITU-R BT.709 (luminance).
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "image/image.h"

namespace lamp::app {
namespace {

constexpr double MIDDLE_GREY = 0.18;

/// Radiance is cut here before the curve, which is white long before, so that an infinite pixel is white too.
constexpr float BRIGHTEST = 1.0e4F;

/// A pixel that is not a number is an error of the renderer and must be seen.
constexpr glm::u8vec4 NOT_A_NUMBER{255, 0, 255, 255};

/// Narkowicz's fit of the ACES curve. Its input is scaled so that the fit maps middle grey to middle grey:
/// 0.13017 is the positive x that the fit maps to 0.18.
float filmic(float radiance) {
  constexpr float GREY_SCALE = 0.13017F / 0.18F;
  const float x = GREY_SCALE * std::fmin(std::fmax(radiance, 0.0F), BRIGHTEST);
  const float y = x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F);
  return std::fmin(y, 1.0F);
}

std::uint8_t srgb_byte(float linear) {
  const float encoded = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * encoded));
}

glm::u8vec4 tone_map(const glm::vec4& pixel, float exposure) {
  if (std::isnan(pixel.r) || std::isnan(pixel.g) || std::isnan(pixel.b)) return NOT_A_NUMBER;
  const auto channel = [exposure](float value) { return srgb_byte(filmic(exposure * value)); };
  return {channel(pixel.r), channel(pixel.g), channel(pixel.b), 255};
}

}  // namespace

double luminance(const glm::vec3& linear) { return 0.2126 * linear.r + 0.7152 * linear.g + 0.0722 * linear.b; }

float automatic_exposure(const HdrImage& image) {
  double sum_of_logs = 0.0;
  double lit = 0.0;  // pixels, those that surfaces cover in part as such a part
  for (const glm::vec4& pixel : image.pixels) {
    const double y = luminance(glm::vec3(pixel));
    if (pixel.a > 0.0F && y > 0.0 && std::isfinite(y)) {
      sum_of_logs += pixel.a * std::log(y);
      lit += pixel.a;
    }
  }
  if (lit == 0.0) return 1.0F;
  const double log_average = std::exp(sum_of_logs / lit);
  return static_cast<float>(MIDDLE_GREY / log_average);
}

LdrImage tone_map(const HdrImage& image, float exposure) {
  LdrImage mapped{image.width, image.height, {}};
  mapped.pixels.reserve(image.pixels.size());
  for (const glm::vec4& pixel : image.pixels) mapped.pixels.push_back(tone_map(pixel, exposure));
  return mapped;
}

}  // namespace lamp::app
