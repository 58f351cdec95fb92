// Adds up timestamps by pass and by frame.
// SPDX-License-Identifier: Apache-2.0
#include "render/frame_times.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/renderer.h"

namespace lamp::app {
namespace {

bool is_shade_pass(std::string_view name) {
  return name == "forward+ shading" || name == "deferred shading" || name == "cull and shade" ||
         name == "light volumes";
}

double median_of(const std::vector<FrameTime>& frames, double FrameTime::* member) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const FrameTime& frame : frames) values.push_back(frame.*member);
  return percentile(std::move(values), 0.5);
}

}  // namespace

double percentile(std::vector<double> samples, double share) {
  if (samples.empty()) return 0.0;
  std::ranges::sort(samples);
  const double place = share * static_cast<double>(samples.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, samples.size() - 1);
  return std::lerp(samples[below], samples[above], place - std::floor(place));
}

double span_ms(std::span<const vulkan::Timestamps::Time> times, const std::function<bool(std::string_view)>& counts) {
  double sum = 0.0;
  std::optional<double> last_end;  // of the pass before, if it counts
  for (const vulkan::Timestamps::Time& time : times) {
    const bool counted = counts(time.pass);
    // What lies between two passes that count, barriers above all, is their cost too.
    if (counted) sum += time.end_ms - last_end.value_or(time.begin_ms);
    last_end = counted ? std::optional(time.end_ms) : std::nullopt;
  }
  return sum;
}

double span_ms(std::span<const vulkan::Timestamps::Time> times) {
  return span_ms(times, [](std::string_view) { return true; });
}

void add_to(PassSums& sums, std::string_view pass, double ms) {
  auto found = std::ranges::find(sums, pass, &PassSums::value_type::first);
  if (found == sums.end()) found = sums.insert(sums.end(), {std::string(pass), 0.0});
  found->second += ms;
}

void FrameTimes::add_sample(const std::string& pass, bool host, double ms) {
  const auto is_pass = [&](const Samples& samples) { return samples.pass == pass && samples.host == host; };
  auto found = std::ranges::find_if(samples_, is_pass);
  if (found == samples_.end()) found = samples_.insert(samples_.end(), {.pass = pass, .host = host});
  found->ms.push_back(ms);
}

vulkan::Timestamps::PartOf parts_of(const Lighting& lighting, Timing timing) {
  if (timing == Timing::passes) return {};
  return [&lighting](std::string_view pass) { return lighting.is_cull_pass(pass) ? 1 : is_shade_pass(pass) ? 2 : 0; };
}

void FrameTimes::add(const std::vector<vulkan::Timestamps::Time>& times, const Lighting& lighting) {
  const bool has_passes = next() == Timing::passes;
  ++added_;
  PassSums on_host;
  PassSums on_device;
  for (const auto& [pass, ms] : lighting.runner().host_times()) add_to(on_host, pass, ms);
  if (has_passes)
    for (const vulkan::Timestamps::Time& time : times) add_to(on_device, time.pass, time.ms());
  for (const auto& [pass, ms] : on_host) add_sample(pass, /* host= */ true, ms);
  for (const auto& [pass, ms] : on_device) add_sample(pass, /* host= */ false, ms);
  if (has_passes && takes_turns_) return;
  frames_.push_back({.cull_ms = span_ms(times, [&](std::string_view pass) { return lighting.is_cull_pass(pass); }),
                     .shade_ms = span_ms(times, is_shade_pass),
                     .frame_ms = span_ms(times)});
}

void FrameTimes::fill(Rendered& rendered, const Lighting& lighting) const {
  for (const auto& [pass, host, ms] : samples_)
    rendered.passes.push_back({.name = pass,
                               .ms_median = percentile(ms, 0.5),
                               .ms_p5 = percentile(ms, 0.05),
                               .ms_p95 = percentile(ms, 0.95),
                               .cull = !host && lighting.is_cull_pass(pass),
                               .shade = !host && is_shade_pass(pass),
                               .host = host});
  for (PassTime& pass : rendered.passes) {
    const auto statistics = lighting.statistics(pass.name);
    pass.statistics.assign(statistics.begin(), statistics.end());
  }
  rendered.cull_ms = median_of(frames_, &FrameTime::cull_ms);
  rendered.shade_ms = median_of(frames_, &FrameTime::shade_ms);
  rendered.frame_ms = median_of(frames_, &FrameTime::frame_ms);
}

}  // namespace lamp::app
