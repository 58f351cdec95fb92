// A suite's series expanded: groups of configurations that are measured together, in interleaved rounds.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/suite.h"

namespace lamp::app {

/// A method by one path, its options and then the swept ones, of which later ones win.
struct GroupEntry : SuiteMethod {
  std::vector<std::pair<std::string, std::string>> swept;  ///< the series' options here: for the chart's x axis
  std::string calibration_hash;  ///< of what `auto` goes by; empty: no concern of this method's
};

/// Everything that the entries of a group share.
struct Group {
  std::string series;
  std::string scene, size, range, camera, projection, brdf, depth;
  std::uint32_t depth_samples = 1;
  double stereo_m = 0.0;
  ShadowChoice shadows;
  double mirror = 0.0;
  std::string mirror_lists = "world-cells";
  std::uint32_t lights = 0;  ///< the most, in a flight
  double spots = 0.0;
  std::uint32_t decals = 0;
  std::uint32_t probes = 0;
  double still = 0.0;
  std::uint64_t seed = 1;
  int frame = -1;
  std::uint32_t frames = 0;  ///< 0: nothing is rendered
  std::uint32_t warm_up = 0;
  std::optional<LightWave> flight;
  Verify verify;
  std::string unchecked;  ///< what of the output is not checked, and why; empty when all is
  bool pictures = false;
  std::string scene_hash;  ///< of the files that the scene is read from; empty: it is built in
  std::vector<GroupEntry> entries;
};

/// How many configurations a series multiplies out to.
[[nodiscard]] double configurations(const Series& series);

/// What the command line changes in every series.
struct Limits {
  std::optional<std::uint32_t> frames;
  std::optional<std::uint32_t> warm_up;
  double scale = 1.0;                 ///< of all sizes, each side; before max_pixels
  std::uint32_t most_frames = ~0U;    ///< of a series without `frames` from the command line; of a flight 12 times
                                      ///< as many
  std::uint32_t max_lights = ~0U;     ///< groups with more are left out
  std::uint64_t max_pixels = ~0ULL;   ///< likewise
  std::vector<std::string> series;    ///< names; others are left out; empty: all are taken
  std::uint64_t most_pairs = ~0ULL;   ///< of pixel and light that brute force can walk here; beyond, lists alone are
                                      ///< checked, and nothing where there are too many for the oracle as well
  std::uint64_t most_walked = ~0ULL;  ///< lights that brute force can walk at a pixel; beyond, likewise
  VerifierChoice verifier = VerifierChoice::oracle;
  bool every_list = false;  ///< where the GPU verifies: the lists of every row
};

/// All groups, in the order in which they are measured. `left_out` counts those beyond the limits.
struct Expansion {
  std::vector<Group> groups;
  std::size_t left_out = 0;
};
[[nodiscard]] Expansion expand(const Suite& suite, const Limits& limits);

/// Names a configuration by all that decides its result but the content of files, in one printable line.
[[nodiscard]] std::string key_of(const Group& group, const GroupEntry& entry);

/// "picture", "64 rows", "64 rows, lists alone", "64 rows, every list, by gpu", "nothing".
[[nodiscard]] std::string words_of(const Verify& verify);

/// Lights at a frame of a flight of so many frames.
[[nodiscard]] std::uint32_t lights_at(const LightWave& wave, std::uint32_t frame, std::uint32_t frames);

/// Width times height of "1280x720"; 0 if it is nothing like it.
[[nodiscard]] std::uint64_t pixels_of(const std::string& size);

}  // namespace lamp::app
