// Makes heat maps and exposes pictures.
// SPDX-License-Identifier: Apache-2.0
#include "commands/pictures.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "error.h"
#include "image/write_file.h"
#include "render/heatmap.h"
#include "system/temporary.h"

namespace lamp::app {

namespace fs = std::filesystem;

std::vector<Visit> visit_all(Session& session, Lighting& lighting) {
  Renderer& renderer = session.renderer();
  const std::uint32_t views = renderer.depth().views;
  if (views == 1) return renderer.visit_all(lighting);
  const std::size_t width = renderer.targets().width;
  std::vector<Visit> all(views * width * renderer.targets().height);
  for (std::uint32_t view = views; view-- != 0;) {
    renderer.show({.view = view});
    const std::vector<Visit> visits = renderer.visit_all(lighting);
    for (std::size_t i = 0; i < visits.size(); ++i) all[(i / width * views + view) * width + i % width] = visits[i];
  }
  return all;
}

std::vector<std::uint32_t> walked_lights(std::span<const Visit> visits) {
  std::vector<std::uint32_t> counts;
  counts.reserve(visits.size());
  for (const Visit& visit : visits) counts.push_back(visit.cell == SKY_CELL ? SKY_CELL : visit.visited);
  return counts;
}

LdrImage heatmap_of(Session& session, std::span<const std::uint32_t> counts, const HeatmapRequest& request) {
  const Targets& targets = session.renderer().targets();
  return draw_heatmap({.width = static_cast<std::uint32_t>(counts.size() / targets.height),
                       .height = targets.height,
                       .counts = counts,
                       .scale_max = request.scale_max,
                       .title = request.title,
                       .overlay = request.overlay});
}

std::optional<float> parse_exposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  float value = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value > 0.0F) || !std::isfinite(value))
    throw Error(fmt::format("--exposure '{}': expected auto or a factor above 0", text));
  return value;
}

void check_output(std::string_view option, const std::string& file, std::span<const std::string_view> extensions) {
  if (std::ranges::find(extensions, fs::path(file).extension().string()) == extensions.end())
    throw Error(fmt::format("{} '{}': expected a name that ends in {}", option, file, fmt::join(extensions, " or ")));
  try {
    const fs::path path = fs::absolute(followed(file));
    if (fs::is_directory(path)) throw Error(fmt::format("{} '{}': is a folder, expected a file name", option, file));
    fs::path folder = path.parent_path();
    while (!fs::exists(folder) && folder.has_relative_path()) folder = folder.parent_path();
    if (!fs::is_directory(folder))
      throw Error(fmt::format("{} '{}': {} is not a folder", option, file, folder.string()));
    if (access(folder.c_str(), W_OK) != 0)
      throw Error(fmt::format("{} '{}': the folder {} is not writable", option, file, folder.string()));
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("{} '{}': {}", option, file, failure.code().message()));
  }
}

void write_output(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  try {
    NewFolders folders(followed(file).parent_path());
    write(file);
    folders.keep();
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("{}: its folder cannot be made: {}", file.string(), failure.code().message()));
  }
}

}  // namespace lamp::app
