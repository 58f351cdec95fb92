// Adds up visits against truths.
// SPDX-License-Identifier: Apache-2.0
#include "render/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "render/shaders/sky_cell.h"

namespace lamp::app {
namespace {

constexpr std::uint64_t BAND_PIXELS = 1U << 19;

// Lights of a band's lists: 1 GiB, and as much again while they are made. The next band may have four times the rows of
// one whose lists take less than a sixteenth.
constexpr std::uint64_t BAND_LIGHTS = 1U << 28;

void sort_unique(std::vector<std::uint64_t>& keys) {
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
}

}  // namespace

std::string words_of(const FramePicture& picture, const HostDepth& depth) {
  std::string words;
  if (depth.views > 1) words += fmt::format("view {}, ", picture.view);
  if (depth.samples > 1) words += fmt::format("sample {}, ", picture.sample);
  return words;
}

double waste_of(std::uint64_t evaluations, std::uint64_t useful) {
  if (useful != 0) return static_cast<double>(evaluations) / static_cast<double>(useful);
  return evaluations == 0 ? 1.0 : std::numeric_limits<double>::infinity();
}

double Findings::waste() const { return waste_of(evaluations, useful); }
std::optional<double> Findings::excess() const {
  return truth_sum ? std::optional(waste_of(list_sum, *truth_sum)) : std::nullopt;
}
double Findings::list_mean() const {
  return cells_seen == 0 ? 0.0 : static_cast<double>(list_sum) / static_cast<double>(cells_seen);
}

std::string_view name_of(Verifier verifier) { return verifier == Verifier::gpu ? "gpu" : "oracle"; }

Verifier chosen(VerifierChoice choice, std::uint64_t pairs) {
  if (choice == VerifierChoice::by_pairs) return pairs > ORACLE_PAIRS ? Verifier::gpu : Verifier::oracle;
  return choice == VerifierChoice::gpu ? Verifier::gpu : Verifier::oracle;
}

bool same_lists(std::span<const Visit> a, std::span<const Visit> b) {
  const auto same = [](const Visit& x, const Visit& y) { return x.visited == y.visited && x.hash == y.hash; };
  return std::ranges::equal(a, b, same);
}

Findings of_both(Findings separate, const Findings& fused) {
  separate.missed_fused = fused.missed;
  separate.missed = std::max(separate.missed, fused.missed);
  separate.unordered = separate.unordered || fused.unordered;
  separate.repeated = std::max(separate.repeated, fused.repeated);
  if (separate.first_miss.empty()) separate.first_miss = fused.first_miss;
  separate.unfollowed = std::max(separate.unfollowed, fused.unfollowed);
  if (separate.first_unfollowed.empty()) separate.first_unfollowed = fused.first_unfollowed;
  return separate;
}

void Verification::add(const Truth& truth, std::span<const Visit> visits, const FramePicture& of) {
  assert(visits.size() + 1 == truth.offsets.size() && "visit the rows that the truth speaks of");
  sums_.boundary_pairs += truth.boundary_pairs;
  std::uint64_t last_cell = ~0ULL;
  std::size_t unique_end = cell_lights_.size();
  for (std::size_t pixel = 0; pixel < visits.size(); ++pixel) {
    if (visits[pixel].cell == gpu::SKY_CELL) continue;
    if (visits[pixel].ended) {
      if (sums_.unfollowed++ == 0) sums_.first_unfollowed = words_of_pixel(truth, pixel, of);
      continue;
    }
    add_pixel(truth, pixel, visits[pixel], of);
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

std::string Verification::words_of_pixel(const Truth& truth, std::size_t pixel, const FramePicture& of) const {
  return words_of(of, depth_) + fmt::format("pixel ({}, {})", pixel % width_, truth.first_row + pixel / width_);
}

void Verification::add_pixel(const Truth& truth, std::size_t pixel, const Visit& visit, const FramePicture& of) {
  sums_.missed += visit.missed;
  sums_.evaluations += visit.visited;
  sums_.useful += truth.offsets[pixel + 1] - truth.offsets[pixel];
  sums_.list_max = std::max(sums_.list_max, visit.visited);
  sums_.unordered = sums_.unordered || visit.unordered != 0;
  if (visit.missed != 0) {
    const std::size_t row = truth.first_row + pixel / width_;
    const std::size_t in_picture = (row * depth_.views + of.view) * width_ + pixel % width_;
    misses_.push_back({static_cast<std::uint32_t>(in_picture), visit.missed});
  }
  if (visit.missed != 0 && sums_.first_miss.empty())
    sums_.first_miss = fmt::format("{}: light {}", words_of_pixel(truth, pixel, of), visit.first_missed);
  for (std::uint32_t i = truth.offsets[pixel]; i < truth.offsets[pixel + 1]; ++i)
    cell_lights_.push_back(std::uint64_t{visit.cell} << 32 | truth.lights[i]);
}

Findings Verification::findings() const {
  Findings findings = sums_;
  if (sums_.unfollowed == 0) findings.truth_sum = cell_lights_.size();
  findings.cells_seen = cell_lengths_.size();
  for (const std::uint64_t key : cell_lengths_) findings.list_sum += key & 0xffffffffU;
  return findings;
}

void for_each_truth(const TruthQuery& of, const std::function<void(const Truth&)>& use) {
  const std::uint64_t width = of.view.width();
  const std::uint64_t row_pairs = std::max<std::uint64_t>(1, width * (of.lights.size() + of.boxes.size()));
  const std::uint64_t certain_rows = std::max<std::uint64_t>(1, BAND_LIGHTS / row_pairs);
  const std::uint64_t most_rows =
      std::max<std::uint64_t>(1, std::min(BAND_PIXELS / width, std::uint64_t{~0U} / row_pairs));
  TruthQuery query = of;
  const std::uint32_t end = of.first_row + of.rows;
  for (std::uint64_t rows = std::min(certain_rows, most_rows); query.first_row < end; query.first_row += query.rows) {
    query.rows = static_cast<std::uint32_t>(std::min<std::uint64_t>(rows, end - query.first_row));
    const Truth band = truth(query);
    use(band);
    const bool sparse = band.lights.size() < BAND_LIGHTS / 16;
    rows = std::min(sparse ? 4 * rows : certain_rows, most_rows);
  }
}

}  // namespace lamp::app
