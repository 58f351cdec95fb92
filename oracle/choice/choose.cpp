// The candidates of `auto`, the terms of their costs, and the choice.
// Based on: docs/auto.md.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/choose.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <sstream>

#include "lamplight/shared/lamplight.h"

namespace lamp {
namespace {

// Terms are in these units, so that coefficients are of like size and print well.
constexpr double LIGHTS = 1e4;
constexpr double PIXELS = 1e6;
constexpr double PAIRS = 1e7;

constexpr double ROOM = 2.0;  // over the estimate, where the room that a plan has by itself will not do

const TileLoad& load_of(const AutoCandidate& candidate, const Workload& workload) {
  return candidate.tile_px == 8 ? workload.tile8 : workload.tile16;
}

double pixels_of(const Workload& w) { return static_cast<double>(w.width) * w.height; }

double tiles_of(const AutoCandidate& candidate, const Workload& w) {
  return std::ceil(static_cast<double>(w.width) / candidate.tile_px) *
         std::ceil(static_cast<double>(w.height) / candidate.tile_px);
}

template <std::size_t COUNT>
double dot(const std::array<double, COUNT>& a, const std::array<double, COUNT>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < COUNT; ++i) sum += a[i] * b[i];
  return sum;
}

/// Of lists and bits: lights and boxes.
std::uint32_t room_of(const Workload& w) { return w.capacity + w.boxes; }

/// As a frame with these lights and boxes makes it: boxes are culled by their shape where the method can.
Result<Plan> plan_of(std::string_view name, std::vector<std::string> settings, const Workload& workload,
                     const DeviceTraits& traits) {
  const auto method = find_method(name);
  if (!method.ok()) return method.error();
  const bool has_shapes =
      std::ranges::find(method.value()->options, "boxes", &OptionSpec::key) != method.value()->options.end();
  if (workload.boxes != 0 && has_shapes) settings.emplace_back("boxes=shape");
  auto options = resolve_options(*method.value(), settings);
  if (!options.ok()) return options.error();
  return make_plan(*method.value(), {.width = workload.width,
                                     .height = workload.height,
                                     .light_capacity = room_of(workload),
                                     .options = std::move(options.value()),
                                     .traits = traits});
}

// "mean_cells=N" where the room that a plan has by itself will not do; `each`: estimate for each of `count`. A plan
// without such a capacity has room for all there can be.
void add_room(std::vector<std::string>& options, const Plan& plan, std::string_view key, double each, double count) {
  const auto capacity = std::ranges::find(plan.capacities, key, &Capacity::option);
  if (capacity == plan.capacities.end()) return;
  if (each * count <= static_cast<double>(capacity->entries)) return;
  const double wanted = std::min(std::ceil(ROOM * each), 4096.0);
  options.push_back(std::string(key) + "=" + std::to_string(static_cast<int>(wanted)));
}

std::vector<std::string> options_of(const AutoCandidate& candidate, const Workload& workload,
                                    const DeviceTraits& traits) {
  std::vector<std::string> options = candidate.settings();
  if (candidate.method != "lamplight") return options;
  const Result<Plan> plan = plan_of(candidate.method, options, workload, traits);
  if (!plan.ok()) return options;
  const TileLoad& load = load_of(candidate, workload);
  add_room(options, plan.value(), "mean_cells", load.entries, workload.lights);
  add_room(options, plan.value(), "mean_capacity", load.exact, tiles_of(candidate, workload));
  return options;
}

// Why the candidate cannot run, or nothing.
std::string refusal(const Prediction& prediction, const Workload& workload, const DeviceTraits& traits) {
  const Result<Plan> plan = plan_of(prediction.method, prediction.options, workload, traits);
  return plan.ok() ? "" : plan.error().text();
}

std::string times(double ratio) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", ratio);
  return text.data();
}

/// With so little room the method is another candidate by itself: the one that is measured with no more.
bool stands_for(const AutoCandidate& few, const AutoCandidate& many, const Workload& workload) {
  return room_of(workload) < many.least_capacity && few.method == many.method && few.tile_px == many.tile_px &&
         few.most_capacity < many.least_capacity;
}

void refuse_stood_for(std::vector<Prediction>& predictions, const Workload& workload) {
  const std::span<const AutoCandidate> candidates = auto_candidates();
  for (std::size_t many = 0; many < candidates.size(); ++many)
    for (std::size_t few = 0; few < candidates.size(); ++few)
      if (stands_for(candidates[few], candidates[many], workload) && predictions[few].refused.empty())
        predictions[many].refused = "with so few lights it is " + predictions[few].label;
}

std::string reason_of(const Prediction& chosen, const std::vector<Prediction>& predictions) {
  const Prediction* next = nullptr;
  for (const Prediction& other : predictions) {
    if (&other == &chosen || !other.refused.empty()) continue;
    if (next == nullptr || other.ms() < next->ms()) next = &other;
  }
  if (next == nullptr) return "the only candidate that can run";
  if (chosen.ms() <= 0.0) return "the least predicted time of cull and shading";
  return "the least predicted time of cull and shading; next is " + next->label + " (" +
         times(next->ms() / chosen.ms()) + " times)";
}

}  // namespace

std::string AutoCandidate::label() const {
  return std::string(method) + (options.empty() ? "" : " ") + std::string(options);
}

std::vector<std::string> AutoCandidate::settings() const {
  std::istringstream words{std::string(options)};
  return {std::istream_iterator<std::string>(words), {}};
}

std::span<const AutoCandidate> auto_candidates() {
  static constexpr std::array<AutoCandidate, 11> TABLE{{
      {.method = "all"},
      {.method = "tiled", .walk = &TileLoad::walked, .listed = &TileLoad::interval, .gathers = true},
      {.method = "tiled",
       .options = "tile=8",
       .tile_px = 8,
       .walk = &TileLoad::walked,
       .listed = &TileLoad::interval,
       .gathers = true},
      {.method = "tiled-bits",
       .walk = &TileLoad::interval,
       .listed = &TileLoad::interval,
       .gathers = true,
       .bits = true},
      {.method = "clustered", .walk = &TileLoad::slab, .listed = &TileLoad::column, .gathers = true},
      {.method = "tight", .walk = &TileLoad::exact, .listed = &TileLoad::exact, .gathers = true, .prunes = true},
      {.method = "lamplight",
       .walk = &TileLoad::exact,
       .listed = &TileLoad::exact,
       .least_capacity = shared::PIECE + 1},
      {.method = "lamplight",
       .options = "tile=8",
       .tile_px = 8,
       .walk = &TileLoad::exact,
       .listed = &TileLoad::exact,
       .least_capacity = shared::PIECE + 1},
      {.method = "lamplight",
       .options = "cells=gather",
       .walk = &TileLoad::exact,
       .listed = &TileLoad::exact,
       .gathers = true,
       .most_capacity = shared::PIECE},
      {.method = "lamplight",
       .options = "tile=8 cells=gather",
       .tile_px = 8,
       .walk = &TileLoad::exact,
       .listed = &TileLoad::exact,
       .gathers = true,
       .most_capacity = shared::PIECE},
      {.method = "drobot-zbin",
       .tile_px = 8,
       .walk = &TileLoad::slab,
       .listed = &TileLoad::column,
       .gathers = true,
       .bits = true},
  }};
  return TABLE;
}

CullTerms cull_terms(const AutoCandidate& candidate, const Workload& w) {
  if (candidate.listed == nullptr) return {};
  const TileLoad& load = load_of(candidate, w);
  const double tiles = tiles_of(candidate, w);
  const double pairs = w.lights * (candidate.gathers ? tiles : load.tested);
  const double looks = candidate.prunes ? pixels_of(w) * load.interval : 0.0;
  const double found = candidate.gathers ? 0.0 : w.lights * load.cells;
  const double listed = tiles * load.*candidate.listed;
  return {1.0, w.lights / LIGHTS, pixels_of(w) / PIXELS, pairs / PAIRS, listed / PIXELS, (looks + found) / PAIRS};
}

ShadeTerms shade_terms(const AutoCandidate& candidate, const Workload& w) {
  const double walked = candidate.walk == nullptr ? w.lights : load_of(candidate, w).*candidate.walk;
  const double words = candidate.bits ? std::ceil(room_of(w) / 32.0) : 0.0;
  return {1.0, pixels_of(w) / PIXELS, pixels_of(w) * walked / PAIRS, pixels_of(w) * words / PAIRS};
}

Choice choose(const Calibration& calibration, const Workload& workload, const DeviceTraits& traits) {
  const std::span<const AutoCandidate> candidates = auto_candidates();
  assert(calibration.costs.size() == candidates.size() && "a calibration has one cost a candidate");
  Choice choice;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Prediction prediction{.label = candidates[i].label(),
                          .method = std::string(candidates[i].method),
                          .options = options_of(candidates[i], workload, traits),
                          .cull_ms = dot(calibration.costs[i].cull, cull_terms(candidates[i], workload)),
                          .shade_ms = dot(calibration.costs[i].shade, shade_terms(candidates[i], workload))};
    prediction.refused = refusal(prediction, workload, traits);
    choice.predictions.push_back(std::move(prediction));
  }
  refuse_stood_for(choice.predictions, workload);
  const Prediction* best = nullptr;
  for (const Prediction& prediction : choice.predictions) {
    if (!prediction.refused.empty()) continue;
    if (best == nullptr || prediction.ms() < best->ms()) best = &prediction;
  }
  const bool nothing = room_of(workload) == 0;
  // Brute force has no buffers that a device could refuse; a picture too large for it is too large for everything.
  if (best == nullptr || nothing) best = &choice.predictions.front();
  choice.predicted = *best;
  choice.method = best->method;
  choice.options = best->options;
  choice.reason =
      nothing ? "there are no lights to cull, in this frame or another" : reason_of(*best, choice.predictions);
  return choice;
}

}  // namespace lamp
