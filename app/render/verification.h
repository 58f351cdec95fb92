// Compares what a look-up brought with the oracle's truth, and a picture with brute force's.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "lamplight/reference.h"
#include "render/shaders/scene_data.h"

namespace lamp::app {

/// What a method's look-up was found to hold. Sums over the pixels that are not sky.
struct Findings {
  std::uint64_t missed = 0;       ///< pairs of pixel and light that the truth has and the look-up has not
  std::uint64_t evaluations = 0;  ///< lights walked
  std::uint64_t useful = 0;       ///< lights of the truth
  std::uint64_t list_sum = 0;     ///< list lengths of the cells that hold a pixel
  std::uint64_t truth_sum = 0;    ///< per cell, the lights that reach one of its pixels
  std::uint64_t cells_seen = 0;   ///< cells that hold a pixel
  std::uint32_t list_max = 0;
  bool unordered = false;  ///< a list did not ascend
  std::string first_miss;  ///< "pixel (12, 34): light 56", or empty

  [[nodiscard]] double waste() const;   ///< evaluations / useful; 1 when there is nothing to do and nothing done
  [[nodiscard]] double excess() const;  ///< list_sum / truth_sum, likewise
  [[nodiscard]] double list_mean() const;
};

/// Collects findings over the bands of a picture.
class Verification {
 public:
  explicit Verification(std::uint32_t width) : width_(width) {}
  void add(const Truth& truth, std::span<const gpu::Visit> visits);
  [[nodiscard]] Findings findings() const;

 private:
  void add_pixel(const Truth& truth, std::size_t pixel, const gpu::Visit& visit);

  std::uint32_t width_;
  Findings sums_;
  std::vector<std::uint64_t> cell_lights_;   ///< cell << 32 | light, sorted and unique after each band
  std::vector<std::uint64_t> cell_lengths_;  ///< cell << 32 | length, likewise
};

/// Truths of a whole picture in bands that fit the device's storage buffers; `use` is called for each in order.
void for_each_truth(const View& view, std::span<const float> depth, std::span<const shared::Light> lights,
                    std::uint64_t max_buffer_bytes, const std::function<void(const Truth&)>& use);

/// The largest difference of a channel; 0 if and only if all bits that matter agree, infinity where one is NaN.
[[nodiscard]] float max_abs_difference(const HdrImage& a, const HdrImage& b);

}  // namespace lamp::app
