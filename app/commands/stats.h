// Stats: what a run of one method took and gave; as the JSON object of the design, and as rows of a table.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/mirror_stats.h"
#include "commands/request.h"
#include "commands/still_stats.h"
#include "gpu/device_clock.h"
#include "render/judgement.h"
#include "render/shadow_leaks.h"
#include "render/shadow_truth.h"

namespace lamp::app {

/// Of the last frame.
struct ShadowStats {
  ShadowSettings settings;
  ShadowCounts counts;
  std::vector<std::uint32_t> waiting;  ///< lights
  std::vector<std::uint32_t> without;
  std::optional<ShadowFindings> truth;  ///< where they were held against rays
  std::optional<LeakSums> leaks;        ///< of a picture of leaks
};

/// Of the lists that transparent surfaces have of their own, where the method's hold at one depth alone.
struct TransparentStats {
  std::string method;
  Options options;
  std::uint64_t bytes = 0;
  std::uint32_t overflowed_cells = 0;  ///< of the last frame
  bool can_grow = false;               ///< with --grow
};

struct Stats {
  std::string device, driver, scene, method;
  Options options;
  std::string path;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t views = 1;  ///< of that size each
  std::size_t lights = 0;
  std::size_t decals = 0;
  std::size_t probes = 0;
  std::uint32_t frames = 0;
  std::optional<ShadowStats> shadows;  ///< where lights cast them
  std::optional<MirrorStats> mirror;   ///< where surfaces mirror
  std::optional<StillStats> still;     ///< where lights that stand still have lists of their own
  std::optional<TransparentStats> transparent;
  Rendered rendered;  ///< its picture is not kept
  std::vector<std::pair<std::string, std::uint64_t>> bytes;
  std::uint64_t cells = 0;
  std::vector<std::pair<std::string, std::string>> fits_with;  ///< options with which all lists of the frame fit
  std::vector<std::string> notes;                              ///< the plan's: what is done otherwise than asked
  std::optional<Findings> findings;                            ///< of lights
  std::optional<Findings> decal_findings;  ///< of decals, where there are some and they were held against a truth
  std::optional<ProbeCounts> captures;     ///< of probes, where they show any
  std::optional<Findings> probe_findings;  ///< likewise of probes
  bool ordered = true;                     ///< the plan's lists ascend
  bool approximate = false;                ///< the plan may miss lights
  std::optional<Judgement> judgement;      ///< of the findings and the picture
  std::optional<Verifier> verifier;        ///< whose truth the findings were held against, if any
  std::optional<float> image_max_abs_diff;
  std::optional<float> image_tolerance;  ///< how large it may be
  std::optional<Clock> clock;            ///< of the device when it had drawn, where it was asked for
};

/// What of a run is known before it begins.
struct StatsInfo {
  const DeviceRow& device;
  std::string scene;
  const View& view;
  std::size_t lights = 0;
  std::uint32_t frames = 0;
  std::size_t decals = 0;
  std::size_t probes = 0;
};
[[nodiscard]] Stats make_stats(const StatsInfo& info, Lighting& lighting, Rendered rendered);

/// Fills what request, session and lighting know.
[[nodiscard]] Stats make_stats(const Request& request, Session& session, Lighting& lighting, const Setup& setup,
                               Rendered rendered, std::uint32_t frames);

/// Takes over what was walked without a truth. Where the device ended walks, a note says so.
void set_walked(Stats& stats, std::span<const Visit> visits);

/// "mean_cells=3, mean_capacity=40".
[[nodiscard]] std::string words_of(std::span<const std::pair<std::string, std::string>> settings);

/// "1 cell", "3 cells".
[[nodiscard]] std::string cell_words(std::uint64_t count);
/// "3 cells did not fit and walked more lights; there is room with mean_capacity=40". Of a frame with overflow.
[[nodiscard]] std::string overflow_words(const Stats& stats);
/// "of transparent surfaces' own lists 3 cells did not fit and walked more lights; --grow makes room". Likewise.
[[nodiscard]] std::string overflow_words(const TransparentStats& stats);
/// Of all lists.
[[nodiscard]] std::uint32_t overflowed_cells(const Stats& stats);
/// What did not fit, in words of the list it is of; empty where all did.
[[nodiscard]] std::vector<std::string> all_overflow_words(const Stats& stats);

/// "pcf: 60 of 64 lights in view have one, 4 wait; 1.2 million texels of 4096 x 4096"
[[nodiscard]] std::string shadow_words(const ShadowStats& shadows);
/// "leaks 1.2 % of the light that rays stop, ..."
[[nodiscard]] std::string truth_words(const ShadowFindings& truth);
/// "12 of 34 pairs that maps leave dark are beyond ..."
[[nodiscard]] std::string cut_words(const ShadowFindings& truth);
[[nodiscard]] std::optional<ShadowStats> shadow_stats(const Shadows* shadows);
[[nodiscard]] nlohmann::json to_json(const ShadowStats& shadows);

[[nodiscard]] nlohmann::json to_json(const Stats& stats);

/// Why `waste` and `excess` are infinite.
inline constexpr const char* NONE_USEFUL = "lights are walked, and none of them reaches its pixel";
/// Sets a number. JSON has no infinity: where the number is none, it becomes null, and KEY_reason says why.
void add_number(nlohmann::json& json, const std::string& key, std::optional<double> value, const char* reason);

}  // namespace lamp::app
