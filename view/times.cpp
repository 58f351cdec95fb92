// Keeps times.
// SPDX-License-Identifier: Apache-2.0
#include "view/times.h"

#include <algorithm>

#include "render/frame_times.h"

namespace lamp::app {
namespace {

std::vector<std::pair<std::string, double>> samples_of(const Rendered& rendered) {
  std::vector<std::pair<std::string, double>> samples{
      {"cull", rendered.cull_ms}, {"shade", rendered.shade_ms}, {"frame", rendered.frame_ms}};
  for (const PassTime& pass : rendered.passes)
    samples.emplace_back(pass.host ? pass.name + " (CPU)" : pass.name, pass.ms_median);
  return samples;
}

void keep(std::vector<float>& ms, double last) {
  if (ms.size() == Times::MOST) ms.erase(ms.begin());
  ms.push_back(static_cast<float>(last));
}

}  // namespace

double Times::Row::at(double share) const { return percentile({ms.begin(), ms.end()}, share); }

void Times::add(const Rendered& rendered) {
  const auto samples = samples_of(rendered);
  const bool same = std::ranges::equal(samples, rows_, {}, [](const auto& sample) { return sample.first; }, &Row::name);
  if (!same) {
    rows_.clear();
    for (const auto& [name, ms] : samples) rows_.push_back({.name = name, .ms = {}});
  }
  for (std::size_t i = 0; i < samples.size(); ++i) keep(rows_[i].ms, samples[i].second);
}

void Times::add_interface(double ms) { keep(interface_.ms, ms); }

}  // namespace lamp::app
