// Compares what a look-up brought with the oracle's truth.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/reference.h"
#include "render/host_depth.h"
#include "render/visit.h"

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

/// "view 1, sample 2, ", as far as a frame has several; else empty.
[[nodiscard]] std::string words_of(const FramePicture& picture, const HostDepth& depth);

/// A pixel whose list lacks lights that reach it.
struct PixelMisses {
  std::uint32_t pixel = 0;  ///< x + width * y of the picture, in which views stand side by side
  std::uint32_t missed = 0;

  friend bool operator==(const PixelMisses&, const PixelMisses&) = default;
};

/// Lights walked for each that is of use; 1 when there is nothing to do and nothing done.
[[nodiscard]] double waste_of(std::uint64_t evaluations, std::uint64_t useful);

/// What a method's look-up was found to hold. Sums over the pixels that are not sky and whose walk came to its end.
struct Findings {
  std::uint64_t missed = 0;                ///< pairs of pixel and light that the truth has and the look-up has not
  std::uint64_t evaluations = 0;           ///< lights walked
  std::uint64_t useful = 0;                ///< lights of the truth
  std::uint64_t boundary_pairs = 0;        ///< pairs in the boundary band, which are not checked; of all pixels
  std::uint64_t list_sum = 0;              ///< list lengths of the cells that hold a pixel
  std::optional<std::uint64_t> truth_sum;  ///< per cell, the lights that reach one of its pixels; nothing: not counted
  std::uint64_t cells_seen = 0;            ///< cells that hold a pixel
  std::uint32_t list_max = 0;
  bool unordered = false;      ///< a list did not ascend
  std::uint64_t repeated = 0;  ///< reaching lights that a list brought again; the oracle does not count
  std::optional<std::uint32_t>
      changed_runs;              ///< repeated runs with other lists than the first's; nothing: not repeated
  std::string first_miss;        ///< "pixel (12, 34): light 56", or empty
  std::uint64_t unfollowed = 0;  ///< pixels whose walk the device ended before its end; of no other number here
  std::string first_unfollowed;  ///< "pixel (12, 34)", or empty
  std::optional<std::uint64_t> missed_fused;  ///< of the fused look-up alone, where the plan has one

  [[nodiscard]] double waste() const;  ///< evaluations / useful; 1 when there is nothing to do and nothing done
  [[nodiscard]] std::optional<double> excess() const;  ///< list_sum / truth_sum, likewise; nothing: not counted
  [[nodiscard]] double list_mean() const;
};

/// What the separate and the fused look-up of one plan were found to hold, as one: the separate one's findings, with
/// the misses of the worse of the two, so that a pair that both miss counts once, and with the disorder of either.
[[nodiscard]] Findings of_both(Findings separate, const Findings& fused);

/// Whether every pixel of two runs walked the same lights in the same order, as far as a hash tells.
[[nodiscard]] bool same_lists(std::span<const Visit> a, std::span<const Visit> b);

/// Collects findings over the bands of a picture.
class Verification {
 public:
  /// `width`: of a view.
  explicit Verification(std::uint32_t width, const HostDepth& depth = {}) : width_(width), depth_(depth) {}
  void add(const Truth& truth, std::span<const Visit> visits, const FramePicture& of = {});
  [[nodiscard]] Findings findings() const;
  /// Where lights are missed, in the order of `add`.
  [[nodiscard]] std::span<const PixelMisses> misses() const { return misses_; }

 private:
  [[nodiscard]] std::string words_of_pixel(const Truth& truth, std::size_t pixel, const FramePicture& of) const;
  void add_pixel(const Truth& truth, std::size_t pixel, const Visit& visit, const FramePicture& of);

  std::uint32_t width_;
  HostDepth depth_;
  Findings sums_;
  std::vector<PixelMisses> misses_;
  std::vector<std::uint64_t> cell_lights_;   ///< cell << 32 | light, sorted and unique after each band
  std::vector<std::uint64_t> cell_lengths_;  ///< cell << 32 | length, likewise
};

/// Truths of the query's rows, in bands that the host's memory has room for, however many lights reach everything;
/// `use` is called for each in order.
void for_each_truth(const TruthQuery& of, const std::function<void(const Truth&)>& use);

}  // namespace lamp::app
