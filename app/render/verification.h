// Compares what a look-up brought with the oracle's truth, and a picture with brute force's.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"
#include "lamplight/plan.h"
#include "oracle/reference.h"
#include "render/shaders/scene_data.h"

namespace lamp::app {

/// Who says which lights reach which pixels.
enum class Verifier : std::uint8_t {
  oracle,  ///< reference.h, on the CPU
  gpu,     ///< GpuVerifier: the same answers on the device, where pairs of pixel and light are too many for a CPU
};
[[nodiscard]] std::string_view name_of(Verifier verifier);
enum class VerifierChoice : std::uint8_t { oracle, gpu, by_pairs };
/// Pairs of pixel and light that the oracle answers for in a few seconds; beyond, the GPU verifier is sooner.
inline constexpr std::uint64_t ORACLE_PAIRS = 20'000'000'000;
[[nodiscard]] Verifier chosen(VerifierChoice choice, std::uint64_t pairs);

/// What a method's look-up was found to hold. Sums over the pixels that are not sky.
struct Findings {
  std::uint64_t missed = 0;                ///< pairs of pixel and light that the truth has and the look-up has not
  std::uint64_t evaluations = 0;           ///< lights walked
  std::uint64_t useful = 0;                ///< lights of the truth
  std::uint64_t list_sum = 0;              ///< list lengths of the cells that hold a pixel
  std::optional<std::uint64_t> truth_sum;  ///< per cell, the lights that reach one of its pixels; nothing: not counted
  std::uint64_t cells_seen = 0;            ///< cells that hold a pixel
  std::uint32_t list_max = 0;
  bool unordered = false;      ///< a list did not ascend
  std::uint64_t repeated = 0;  ///< reaching lights that a list brought again; the oracle does not count
  std::optional<std::uint32_t>
      changed_runs;        ///< repeated runs with other lists than the first's; nothing: not repeated
  std::string first_miss;  ///< "pixel (12, 34): light 56", or empty
  std::optional<std::uint64_t> missed_fused;  ///< of the fused look-up alone, where the plan has one

  [[nodiscard]] double waste() const;  ///< evaluations / useful; 1 when there is nothing to do and nothing done
  [[nodiscard]] std::optional<double> excess() const;  ///< list_sum / truth_sum, likewise; nothing: not counted
  [[nodiscard]] double list_mean() const;
};

/// What the separate and the fused look-up of one plan were found to hold, as one: the separate one's findings, with
/// the misses of the worse of the two, so that a pair that both miss counts once, and with the disorder of either.
[[nodiscard]] Findings of_both(Findings separate, const Findings& fused);

/// Whether every pixel of two runs walked the same lights in the same order, as far as a hash tells.
[[nodiscard]] bool same_lists(std::span<const gpu::Visit> a, std::span<const gpu::Visit> b);

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

/// Likewise for any entities; rows and first row of the query are not read.
void for_each_truth(const TruthQuery& of, std::uint64_t max_buffer_bytes, const std::function<void(const Truth&)>& use);

/// How far a picture may be from brute force's: not at all where lists ascend; else, for 4096 additions in any order,
/// by this share of one more than the largest value.
inline constexpr float UNORDERED_TOLERANCE = 1e-4F;
[[nodiscard]] float picture_tolerance(const Plan& plan, const HdrImage& reference);
[[nodiscard]] float largest_value(const HdrImage& image);

/// A picture against brute force's.
struct PictureDifference {
  float max_abs = 0.0F;    ///< of max_abs_difference
  float tolerance = 0.0F;  ///< of picture_tolerance
};
/// Whether a plan does what its row promises: nothing missed or repeated, lists in order, the same picture. What an
/// approximate plan misses is counted, not held against it.
[[nodiscard]] bool keeps_promises(const Plan& plan, const Findings& findings, const PictureDifference& difference);

/// The largest difference of a channel; 0 if and only if all bits that matter agree, infinity where one is NaN.
[[nodiscard]] float max_abs_difference(const HdrImage& a, const HdrImage& b);

}  // namespace lamp::app
