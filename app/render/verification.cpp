// Adds up visits against truths.
// SPDX-License-Identifier: Apache-2.0
#include "render/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace lamp::app {
namespace {

constexpr std::uint64_t BAND_PIXELS = 1U << 19;

double ratio(std::uint64_t above, std::uint64_t below) {
  if (below != 0) return static_cast<double>(above) / static_cast<double>(below);
  return above == 0 ? 1.0 : std::numeric_limits<double>::infinity();
}

void sort_unique(std::vector<std::uint64_t>& keys) {
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
}

}  // namespace

double Findings::waste() const { return ratio(evaluations, useful); }
std::optional<double> Findings::excess() const {
  return truth_sum ? std::optional(ratio(list_sum, *truth_sum)) : std::nullopt;
}
double Findings::list_mean() const {
  return cells_seen == 0 ? 0.0 : static_cast<double>(list_sum) / static_cast<double>(cells_seen);
}

std::string_view name_of(Verifier verifier) { return verifier == Verifier::gpu ? "gpu" : "oracle"; }

Verifier chosen(VerifierChoice choice, std::uint64_t pairs) {
  if (choice == VerifierChoice::by_pairs) return pairs > ORACLE_PAIRS ? Verifier::gpu : Verifier::oracle;
  return choice == VerifierChoice::gpu ? Verifier::gpu : Verifier::oracle;
}

bool same_lists(std::span<const gpu::Visit> a, std::span<const gpu::Visit> b) {
  const auto same = [](const gpu::Visit& x, const gpu::Visit& y) { return x.visited == y.visited && x.hash == y.hash; };
  return std::ranges::equal(a, b, same);
}

Findings of_both(Findings separate, const Findings& fused) {
  separate.missed_fused = fused.missed;
  separate.missed = std::max(separate.missed, fused.missed);
  separate.unordered = separate.unordered || fused.unordered;
  separate.repeated = std::max(separate.repeated, fused.repeated);
  if (separate.first_miss.empty()) separate.first_miss = fused.first_miss;
  return separate;
}

void Verification::add(const Truth& truth, std::span<const gpu::Visit> visits) {
  assert(visits.size() + 1 == truth.offsets.size() && "visit the rows that the truth speaks of");
  std::uint64_t last_cell = ~0ULL;
  std::size_t unique_end = cell_lights_.size();
  for (std::size_t pixel = 0; pixel < visits.size(); ++pixel) {
    if (visits[pixel].cell == gpu::SKY_CELL) continue;
    add_pixel(truth, pixel, visits[pixel]);
    if (visits[pixel].cell != last_cell)
      cell_lengths_.push_back(std::uint64_t{visits[pixel].cell} << 32 | visits[pixel].visited);
    last_cell = visits[pixel].cell;
    if (cell_lights_.size() > 2 * unique_end + (1U << 20)) {
      sort_unique(cell_lights_);
      unique_end = cell_lights_.size();
    }
  }
  sort_unique(cell_lights_);
  sort_unique(cell_lengths_);
}

void Verification::add_pixel(const Truth& truth, std::size_t pixel, const gpu::Visit& visit) {
  sums_.missed += visit.missed;
  sums_.evaluations += visit.visited;
  sums_.useful += truth.offsets[pixel + 1] - truth.offsets[pixel];
  sums_.list_max = std::max(sums_.list_max, visit.visited);
  sums_.unordered = sums_.unordered || visit.unordered != 0;
  if (visit.missed != 0 && sums_.first_miss.empty())
    sums_.first_miss =
        fmt::format("pixel ({}, {}): light {}", pixel % width_, truth.first_row + pixel / width_, visit.first_missed);
  for (std::uint32_t i = truth.offsets[pixel]; i < truth.offsets[pixel + 1]; ++i)
    cell_lights_.push_back(std::uint64_t{visit.cell} << 32 | truth.lights[i]);
}

Findings Verification::findings() const {
  Findings findings = sums_;
  findings.truth_sum = cell_lights_.size();
  findings.cells_seen = cell_lengths_.size();
  for (const std::uint64_t key : cell_lengths_) findings.list_sum += key & 0xffffffffU;
  return findings;
}

void for_each_truth(const View& view, std::span<const float> depth, std::span<const shared::Light> lights,
                    std::uint64_t max_buffer_bytes, const std::function<void(const Truth&)>& use) {
  for_each_truth({.view = view, .depth = depth, .lights = lights}, max_buffer_bytes, use);
}

void for_each_truth(const TruthQuery& of, std::uint64_t max_buffer_bytes,
                    const std::function<void(const Truth&)>& use) {
  const View& view = of.view;
  const auto rows_at_most = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, BAND_PIXELS / view.width()));
  std::uint32_t rows = std::min(rows_at_most, view.height());
  for (std::uint32_t row = 0; row < view.height();) {
    rows = std::min(rows, view.height() - row);
    TruthQuery query = of;
    query.first_row = row;
    query.rows = rows;
    const Truth band = truth(query);
    if (band.lights.size() * sizeof(std::uint32_t) > max_buffer_bytes && rows > 1) {
      rows = (rows + 1) / 2;
      continue;
    }
    use(band);
    row += rows;
  }
}

float largest_value(const HdrImage& image) {
  float largest = 0.0F;
  for (const glm::vec4& pixel : image.pixels) largest = std::max({largest, pixel.r, pixel.g, pixel.b});
  return largest;
}

float picture_tolerance(const Plan& plan, const HdrImage& reference) {
  return plan.ordered ? 0.0F : UNORDERED_TOLERANCE * (1.0F + largest_value(reference));
}

bool keeps_promises(const Plan& plan, const Findings& findings, const PictureDifference& difference) {
  if (plan.ordered && findings.unordered) return false;
  if (findings.repeated != 0) return false;
  if (plan.ordered && findings.changed_runs.value_or(0) != 0) return false;
  if (plan.approximate) return true;
  return findings.missed == 0 && std::isfinite(difference.max_abs) && difference.max_abs <= difference.tolerance;
}

float max_abs_difference(const HdrImage& a, const HdrImage& b) {
  assert(a.pixels.size() == b.pixels.size() && "compare pictures of one size");
  float largest = 0.0F;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec4 difference = glm::abs(a.pixels[i] - b.pixels[i]);
    for (int c = 0; c < 4; ++c) {
      if (std::isnan(difference[c])) return std::numeric_limits<float>::infinity();
      largest = std::max(largest, difference[c]);
    }
  }
  return largest;
}

}  // namespace lamp::app
