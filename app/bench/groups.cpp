// Multiplies sweeps out.
// SPDX-License-Identifier: Apache-2.0
#include "bench/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "files/printable.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t FLIGHT_FACTOR = 12;  // most_frames of a flight: it is one sample a frame, not a median

// The oracle looks at blocks of pixels first and discards most lights for all of a block.
constexpr std::uint64_t ORACLE_FACTOR = 256;

using Swept = std::vector<std::pair<std::string, std::string>>;

/// Width and height of "1280x720"; 0 if it is nothing like it.
std::pair<std::uint32_t, std::uint32_t> size_of(const std::string& size) {
  const std::size_t x = size.find('x');
  if (x == std::string::npos) return {0, 0};
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  const char* end = size.data() + size.size();
  const bool whole = std::from_chars(size.data(), end, width).ptr == size.data() + x &&
                     std::from_chars(size.data() + x + 1, end, height).ptr == end;
  return whole ? std::pair(width, height) : std::pair(0U, 0U);
}

/// Both sides to the nearest whole number of pixels, at least 1; what is no size stays as it is.
std::string scaled(const std::string& size, double scale) {
  const auto [width, height] = size_of(size);
  if (width == 0 || height == 0 || scale == 1.0) return size;
  const auto side = [scale](std::uint32_t pixels) { return std::max(std::lround(pixels * scale), 1L); };
  return fmt::format("{}x{}", side(width), side(height));
}

/// All combinations of the swept options.
std::vector<Swept> combinations(const Series& series) {
  std::vector<Swept> all{{}};
  for (const auto& [key, values] : series.options) {
    std::vector<Swept> longer;
    for (const Swept& swept : all)
      for (const std::string& value : values) {
        longer.push_back(swept);
        longer.back().emplace_back(key, value);
      }
    all = std::move(longer);
  }
  return all;
}

std::vector<GroupEntry> entries_of(const Series& series) {
  std::vector<GroupEntry> entries;
  for (const SuiteMethod& method : series.methods)
    for (const Swept& swept : combinations(series))
      for (const std::string& path : paths_of(series, method)) {
        GroupEntry entry{method, swept, {}};
        entry.path = path;
        if (series.paths.size() > 1 && method.path.empty() && series.chart.x != "path") entry.label += ", " + path;
        for (const auto& [key, value] : swept) entry.options.push_back(fmt::format("{}={}", key, value));
        entries.push_back(std::move(entry));
      }
  return entries;
}

Group base_of(const Series& series, const Limits& limits) {
  Group group{.series = series.name,
              .brdf = series.brdf,
              .depth = series.depth,
              .depth_samples = series.depth_samples,
              .stereo_m = series.stereo_m,
              .shadows = series.shadows,
              .mirror = series.mirror,
              .mirror_lists = series.mirror_lists,
              .still = series.still,
              .seed = series.seed,
              .frame = series.frame,
              .entries = entries_of(series)};
  if (!series.timed) return group;
  const std::uint32_t most = series.flight && limits.most_frames < ~0U / FLIGHT_FACTOR
                                 ? limits.most_frames * FLIGHT_FACTOR
                                 : limits.most_frames;
  const bool limited = !limits.frames && series.frames > most;
  group.frames = limits.frames.value_or(std::min(series.frames, most));
  group.warm_up = limits.warm_up.value_or(limited ? 1 : series.warm_up);
  group.flight = series.flight;
  return group;
}

/// Says what of a group is checked, and why not all.
void limit_verify(const Series& series, const Limits& limits, Group& group) {
  group.verify = series.verify;
  group.unchecked.clear();
  if (!series.timed) {
    group.verify = {.what = Verify::What::nothing};
    group.unchecked = "neither timed nor verified: the suite asks for what plans say by themselves";
    return;
  }
  const auto [width, height] = size_of(group.size);
  const std::uint64_t rows = group.verify.what == Verify::What::rows ? std::min(group.verify.rows, height) : height;
  const std::uint64_t pairs = std::uint64_t{width} * rows * series.depth_samples * group.lights;
  const std::uint64_t all_pairs = std::uint64_t{width} * height * group.lights;
  const bool boxes = group.decals + group.probes != 0;
  const bool oracle_only = boxes || series.depth_samples > 1 || series.stereo_m > 0.0 || series.shadows.filter != "off";
  group.verify.verifier = oracle_only  // which it alone knows of
                              ? Verifier::oracle
                              : chosen(limits.verifier, limits.every_list ? all_pairs : pairs);
  const bool by_gpu = group.verify.verifier == Verifier::gpu;
  group.verify.every_list = by_gpu && limits.every_list && rows < height;
  if (series.verify.what == Verify::What::nothing) {
    group.unchecked = "not verified: the suite says so";
  } else if (!by_gpu && pairs / ORACLE_FACTOR > limits.most_pairs) {
    group.verify.what = Verify::What::nothing;
    group.unchecked = "not verified: too many lights for the oracle";
  } else if (pairs > limits.most_pairs || group.lights > limits.most_walked) {
    group.verify.compares_pictures = false;
    group.unchecked =
        fmt::format("lists were held against the {}; the picture was not compared: too many lights for brute force",
                    by_gpu ? "GPU verifier" : "oracle");
  }
}

/// Calls `use` with how many lights, decals and probes each group has.
template <class Use>
void for_each_count(const Series& series, const Use& use) {
  const std::vector<std::uint32_t> lights =
      series.flight ? std::vector<std::uint32_t>{series.flight->to} : series.lights;
  for (const std::uint32_t light_count : lights)
    for (const std::uint32_t decals : series.decals)
      for (const std::uint32_t probes : series.probes) use(light_count, decals, probes);
}

/// Calls `use` with every group of a series.
template <class Use>
void for_each_group(const Series& series, const Limits& limits, const Use& use) {
  Group group = base_of(series, limits);
  for (const std::string& scene : series.scenes)
    for (const std::string& camera : series.cameras)
      for (const std::string& projection : series.projections)
        for (const std::string& size : series.sizes)
          for (const std::string& range : series.ranges)
            for (const double spots : series.spots) {
              group.scene = scene;
              group.camera = camera;
              group.projection = projection;
              group.size = scaled(size, limits.scale);
              group.range = range;
              group.spots = spots;
              for_each_count(series, [&](std::uint32_t lights, std::uint32_t decals, std::uint32_t probes) {
                group.lights = lights;
                group.decals = decals;
                group.probes = probes;
                limit_verify(series, limits, group);
                use(group);
              });
            }
}

/// Marks, for every scene of a series, the first group with the most lights.
void choose_pictures(const Series& series, std::span<Group> groups) {
  if (!series.pictures) return;
  std::map<std::string_view, Group*> most;
  for (Group& group : groups) {
    Group*& best = most.emplace(group.scene, &group).first->second;
    if (group.lights > best->lights) best = &group;
  }
  for (const auto& [scene, group] : most) group->pictures = true;
}

/// Nothing of what is as it mostly is: keys of old results hold.
std::string unusual_words(const Group& group) {
  return (group.depth == "reversed" ? "" : " depth=" + group.depth) +
         (group.depth_samples == 1 ? "" : fmt::format(" depth_samples={}", group.depth_samples)) +
         (group.stereo_m == 0.0 ? "" : fmt::format(" stereo={}", group.stereo_m)) +
         (group.still == 0.0 ? "" : fmt::format(" still={}", group.still)) +
         (group.decals == 0 ? "" : fmt::format(" decals={}", group.decals)) +
         (group.probes == 0 ? "" : fmt::format(" probes={}", group.probes));
}

/// Likewise.
std::string shadow_words(const Group& group) {
  const ShadowChoice usual;
  std::string words;
  for (const auto& [name, value] : SHADOW_WORDS) {
    if (group.shadows.filter == usual.filter || group.shadows.*value == usual.*value) continue;
    words += fmt::format(" {}={}", name, group.shadows.*value);
    if (value == &ShadowChoice::filter) words += fmt::format(" atlas={}", group.shadows.atlas);
  }
  if (group.mirror != 0.0) words += fmt::format(" mirror={} mirror_lists={}", group.mirror, group.mirror_lists);
  return words;
}

std::string host_words(const GroupEntry& entry) {
  std::string words;
  if (entry.host != Host::plan) words += fmt::format(" host={}", host_names()[static_cast<std::size_t>(entry.host)]);
  if (entry.still_lists != "off")
    words += fmt::format(" still_lists={} still_occlusion={}", entry.still_lists, entry.still_occlusion);
  if (entry.still_bytes != SuiteMethod{}.still_bytes) words += fmt::format(" still_bytes={}", entry.still_bytes);
  return words;
}

}  // namespace

double configurations(const Series& series) {
  double entries = 0.0;
  for (const SuiteMethod& method : series.methods)
    entries += method.path.empty() ? static_cast<double>(series.paths.size()) : 1.0;
  double product = entries * (series.flight ? 1.0 : static_cast<double>(series.lights.size()));
  for (const auto& [key, values] : series.options) product *= static_cast<double>(values.size());
  for (const std::size_t swept :
       {series.scenes.size(), series.cameras.size(), series.projections.size(), series.sizes.size(),
        series.ranges.size(), series.spots.size(), series.decals.size(), series.probes.size()})
    product *= static_cast<double>(swept);
  return product;
}

Expansion expand(const Suite& suite, const Limits& limits) {
  Expansion expansion;
  for (const Series& series : suite.series) {
    const std::size_t first = expansion.groups.size();
    if (!limits.series.empty() && std::ranges::find(limits.series, series.name) == limits.series.end()) continue;
    for_each_group(series, limits, [&](const Group& group) {
      if (group.lights > limits.max_lights || pixels_of(group.size) > limits.max_pixels)
        expansion.left_out += group.entries.size();
      else
        expansion.groups.push_back(group);
    });
    choose_pictures(series, std::span(expansion.groups).subspan(first));
  }
  return expansion;
}

std::string words_of(const Verify& verify) {
  if (verify.what == Verify::What::nothing) return "nothing";
  const std::string what = verify.what == Verify::What::rows ? fmt::format("{} rows", verify.rows) : "picture";
  return what + (verify.compares_pictures ? "" : ", lists alone") + (verify.every_list ? ", every list" : "") +
         (verify.verifier == Verifier::gpu ? ", by gpu" : "");
}

std::string key_of(const Group& group, const GroupEntry& entry) {
  std::string lights = std::to_string(group.lights);
  if (group.flight)
    lights = fmt::format("{}..{} in {} waves", group.flight->from, group.flight->to, group.flight->waves);
  std::vector<std::string> options = entry.options;
  return printable(fmt::format(
      "{}: {} {} lights={} spots={} range={} seed={} camera={} projection={} frame={} brdf={}{}{} | {} {}{}{}{} | "
      "frames={}+{} verify={}{}",
      group.series, group.scene, group.size, lights, group.spots, group.range.empty() ? "automatic" : group.range,
      group.seed, group.camera.empty() ? "first" : group.camera, group.projection, group.frame, group.brdf,
      unusual_words(group), shadow_words(group), entry.name, fmt::join(options, " "), options.empty() ? "" : " ",
      entry.path, host_words(entry), group.warm_up, group.frames, words_of(group.verify),
      group.pictures ? " pictures" : ""));
}

std::uint32_t lights_at(const LightWave& wave, std::uint32_t frame, std::uint32_t frames) {
  if (frames <= 1) return wave.to;
  const double turns = static_cast<double>(frame) / frames * wave.waves;
  const double t = 1.0 - std::abs(2.0 * (turns - std::floor(turns)) - 1.0);
  return wave.from + static_cast<std::uint32_t>(std::lround(t * t * (wave.to - wave.from)));
}

std::uint64_t pixels_of(const std::string& size) {
  const auto [width, height] = size_of(size);
  return std::uint64_t{width} * height;
}

}  // namespace lamp::app
