// `auto`: which method and options to take for a device, a picture size, and the lights of a frame; and why.
// Based on: a linear cost model a candidate, fitted to a few measured frames of the device (docs/auto.md).
// Promise: pure; the same calibration and workload give the same choice; it knows no file and no device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/method.h"
#include "lamplight/view.h"

namespace lamp {

/// Lights that a tile of one size holds, on average over the picture, by ever closer tests; and those of its pixels.
struct TileLoad {
  double column = 0.0;    ///< spheres that touch the tile's column, whatever the depth
  double interval = 0.0;  ///< of those, what touches the tile's depth interval
  double walked = 0.0;    ///< interval, but all lights where more than 512 do: tiled lists have no more places
  double slab = 0.0;      ///< of column, what spans a pixel's own depth
  double exact = 0.0;     ///< lights that reach the tile's surfaces, cones included
  double cells = 0.0;     ///< cells of `lamplight` whose columns a light touches, mean over all lights
  double entries = 0.0;   ///< of those, cells whose depths it touches: it is listed there
  double tested = 0.0;    ///< tiles of the latter, which it is held against
};

/// What a frame asks of a method, as far as the cost model looks.
struct Workload {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t lights = 0;
  std::uint32_t capacity = 0;  ///< lights that there is room for, at least `lights`
  std::uint32_t boxes = 0;     ///< decals and probes that there is room for besides, which cells hold by their shape
  double reached = 0.0;        ///< lights that reach a pixel, mean
  TileLoad tile8, tile16;
};

/// Estimates a workload, with room for just its lights, from a sample: some tiles, of many lights some. `depth`: device
/// depth, row by row, 0 is sky; or empty, when it is not known: then surfaces are taken to be at every depth.
[[nodiscard]] Workload estimate_workload(const View& view, std::span<const float> depth,
                                         std::span<const shared::Light> lights);

/// A method with options, and how its cost follows from a workload.
struct AutoCandidate {
  std::string_view method;
  std::string_view options;  ///< KEY=VALUE, separated by spaces
  std::uint32_t tile_px = 16;
  double TileLoad::* walk = nullptr;    ///< what a pixel walks; null: every light
  double TileLoad::* listed = nullptr;  ///< what a tile writes; null: nothing is culled
  bool gathers = false;                 ///< every tile asks every light; else every light looks for its cells
  bool bits = false;                    ///< a pixel walks words of 32 lights too
  bool prunes = false;                  ///< every pixel tests every light of its tile while culling
  std::uint32_t least_capacity = 0;     ///< room for lights that it is measured with, at least
  std::uint32_t most_capacity = std::numeric_limits<std::uint32_t>::max();  ///< and at most; it is no method for more
  [[nodiscard]] std::string label() const;
  [[nodiscard]] std::vector<std::string> settings() const;  ///< the options, one each
};

/// All that `auto` chooses from.
[[nodiscard]] std::span<const AutoCandidate> auto_candidates();

inline constexpr std::size_t CULL_TERMS = 6;
inline constexpr std::size_t SHADE_TERMS = 4;
using CullTerms = std::array<double, CULL_TERMS>;
using ShadeTerms = std::array<double, SHADE_TERMS>;

/// What the coefficients are multiplied with. Cull: 1; lights; pixels; lights times tiles (gathering), or tiles that
/// lights are held against; entries of lists; pixels times lists (pruning), or cells that lights look at. Shading: 1;
/// pixels; lights walked; words walked.
[[nodiscard]] CullTerms cull_terms(const AutoCandidate& candidate, const Workload& workload);
[[nodiscard]] ShadeTerms shade_terms(const AutoCandidate& candidate, const Workload& workload);

/// A candidate's coefficients, milliseconds, none negative.
struct CandidateCost {
  CullTerms cull{};
  ShadeTerms shade{};
};

/// One measured frame.
struct CostSample {
  Workload workload;
  double cull_ms = 0.0;
  double shade_ms = 0.0;
};

/// The coefficients >= 0 whose predictions differ least from the samples, each relative to its sample.
[[nodiscard]] CandidateCost fit_cost(const AutoCandidate& candidate, std::span<const CostSample> samples);

/// Of one device with one driver: a cost for each of auto_candidates(), in their order.
struct Calibration {
  std::string device, driver;
  std::vector<CandidateCost> costs;
};

/// What the model says of a candidate.
struct Prediction {
  std::string label;
  std::string method;
  std::vector<std::string> options;  ///< KEY=VALUE
  double cull_ms = 0.0;
  double shade_ms = 0.0;
  std::string refused;  ///< why it cannot run here, or empty
  [[nodiscard]] double ms() const { return cull_ms + shade_ms; }
};

struct Choice {
  std::string method;
  std::vector<std::string> options;     ///< KEY=VALUE
  Prediction predicted;                 ///< of what was chosen
  std::vector<Prediction> predictions;  ///< of all candidates, in their order
  std::string reason;                   ///< one line
};

/// The candidate whose predicted cull and shading together take least, among those that can run.
/// `calibration.costs` must have one entry a candidate.
[[nodiscard]] Choice choose(const Calibration& calibration, const Workload& workload, const DeviceTraits& traits);

}  // namespace lamp
