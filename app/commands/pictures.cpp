// Makes heat maps and exposes pictures.
// SPDX-License-Identifier: Apache-2.0
#include "commands/pictures.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cmath>

#include "render/heatmap.h"

namespace lamp::app {

std::vector<gpu::Visit> visit_all(Session& session, Lighting& lighting) {
  const Targets& targets = session.renderer().targets();
  return session.renderer().visit(lighting, empty_truth(targets.width, targets.height));
}

std::vector<std::uint32_t> walked_lights(std::span<const gpu::Visit> visits) {
  std::vector<std::uint32_t> counts;
  counts.reserve(visits.size());
  for (const gpu::Visit& visit : visits) counts.push_back(visit.cell == NO_CELL ? NO_CELL : visit.visited);
  return counts;
}

LdrImage heatmap_of(Session& session, std::span<const std::uint32_t> counts, const HeatmapRequest& request) {
  const Targets& targets = session.renderer().targets();
  return draw_heatmap({.width = targets.width,
                       .height = targets.height,
                       .counts = counts,
                       .scale_max = request.scale_max,
                       .title = request.title,
                       .overlay = request.overlay});
}

float parse_exposure(const std::string& text, const HdrImage& image) {
  if (text == "auto") return automatic_exposure(image);
  float value = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value > 0.0F) || !std::isfinite(value))
    throw Error(fmt::format("--exposure '{}': expected auto or a factor above 0", text));
  return value;
}

void check_writable(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
  if (access(folder.c_str(), W_OK) != 0)
    throw Error(fmt::format("{}: the folder is not writable", folder.string()));
  if (std::filesystem::is_directory(file)) throw Error(fmt::format("{}: is a folder, expected a file name", file.string()));
}

}  // namespace lamp::app
