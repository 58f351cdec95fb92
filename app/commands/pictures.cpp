// Makes heat maps and exposes pictures.
// SPDX-License-Identifier: Apache-2.0
#include "commands/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "commands/command_line.h"
#include "error.h"
#include "files/utf8_path.h"
#include "image/write_file.h"
#include "render/heatmap.h"
#include "render/shadow_heat.h"
#include "render/shadow_leaks.h"
#include "system/file_access.h"
#include "system/letter_case.h"
#include "system/temporary.h"

namespace lamp::app {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 4> HEAT_NAMES{"lights", "shadow-age", "shadow-size", "shadow-leaks"};
constexpr std::array<const char*, 3> HEAT_UNITS{"lights", "frames", "texels"};

/// What `of_view` says of each pixel, views side by side. The first stays shown.
template <class OfView>
auto side_by_side(Renderer& renderer, const OfView& of_view) {
  const std::uint32_t views = renderer.depth().views;
  if (views == 1) return of_view();
  const std::size_t width = renderer.targets().width;
  decltype(of_view()) all(views * width * renderer.targets().height);
  for (std::uint32_t view = views; view-- != 0;) {
    renderer.show({.view = view});
    const auto pixels = of_view();
    for (std::size_t i = 0; i < pixels.size(); ++i) all[(i / width * views + view) * width + i % width] = pixels[i];
  }
  return all;
}

}  // namespace

std::span<const std::string_view> heat_names() { return HEAT_NAMES; }

HeatOf parse_heat(const std::string& name, const Request& request) {
  const auto of = static_cast<HeatOf>(parse_name("--heatmap-of", name, HEAT_NAMES));
  if (of == HeatOf::lights) return of;
  if (!requested_shadows(request))
    throw Error(fmt::format("--heatmap-of {}: no light casts a shadow; expected --shadows with it", name));
  if (request.still_lists != "off")
    throw Error(
        fmt::format("--heatmap-of {}: not together with --still-lists, whose lights no list of the picture has", name));
  return of;
}

void for_each_picture(Renderer& renderer, const std::function<void(std::span<const float>)>& use) {
  if (!renderer.depth().several()) return use(renderer.read_depth());
  for (const FramePicture& picture : renderer.all_pictures()) {
    renderer.show(picture);
    use(renderer.draw_depth());
  }
}

std::vector<Visit> visit_all(Session& session, Lighting& lighting) {
  Renderer& renderer = session.renderer();
  return side_by_side(renderer, [&] { return renderer.visit_all(lighting); });
}

std::vector<std::uint32_t> shadow_heat(Session& session, Lighting& lighting, HeatOf of) {
  Renderer& renderer = session.renderer();
  const ShadowHeat heat = of == HeatOf::shadow_age ? ShadowHeat::age : ShadowHeat::size;
  return side_by_side(renderer, [&] { return shadow_heat(renderer, lighting, heat); });
}

void check_heat(Session& session, const Lighting& lighting, HeatOf of) {
  if (of != HeatOf::shadow_leaks) return;
  if (const std::string why = why_no_leaks(session.renderer(), lighting, session.gpu_scene().scene()); !why.empty())
    throw Error(fmt::format("--heatmap-of shadow-leaks: {}", why));
}

std::vector<gpu::ShadowLeak> shadow_leaks(Session& session, Lighting& lighting) {
  Renderer& renderer = session.renderer();
  const MirrorScene& rays = session.rays();
  return side_by_side(renderer, [&] { return shadow_leaks(renderer, lighting, rays); });
}

std::vector<std::uint32_t> walked_lights(std::span<const Visit> visits) {
  std::vector<std::uint32_t> counts;
  counts.reserve(visits.size());
  for (const Visit& visit : visits) counts.push_back(visit.cell == SKY_CELL ? SKY_CELL : visit.visited);
  return counts;
}

std::vector<gpu::StillPoint> all_pixel_points(Renderer& renderer) {
  return side_by_side(renderer, [&] { return pixel_points(renderer); });
}

void add_still_walks(const StillSetup& still, std::span<const gpu::StillPoint> points,
                     std::vector<std::uint32_t>& walked) {
  for (std::size_t i = 0; i < walked.size(); ++i)
    if (walked[i] != SKY_CELL) walked[i] += static_cast<std::uint32_t>(still.lights_at(points[i]).size());
}

LdrImage heatmap_of(Session& session, std::span<const std::uint32_t> counts, const HeatmapRequest& request) {
  const Targets& targets = session.renderer().targets();
  const std::array<HeatSignal, 2> of_shadows{
      {{.count = gpu::WAITS_FOR_REDRAWING, .color = WAITS_COLOR, .meaning = "a shadow waits to be drawn anew"},
       {.count = gpu::WITHOUT_SHADOW, .color = WITHOUT_COLOR, .meaning = "a light has no shadow"}}};
  return draw_heatmap({.width = static_cast<std::uint32_t>(counts.size() / targets.height),
                       .height = targets.height,
                       .counts = counts,
                       .scale_max = request.scale_max,
                       .title = request.title,
                       .overlay = request.overlay,
                       .unit = HEAT_UNITS[static_cast<std::size_t>(request.of)],
                       .signals = request.of == HeatOf::lights ? std::span<const HeatSignal>() : of_shadows});
}

std::optional<float> parse_exposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  float value = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value > 0.0F) || !std::isfinite(value))
    throw Error(fmt::format("--exposure '{}': expected auto or a finite factor above 0", text));
  return value;
}

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), small_letter);
  return extension;
}

void check_output(std::string_view option, const std::string& file, std::span<const std::string_view> extensions) {
  if (std::ranges::find(extensions, extension_of(utf8_path(file))) == extensions.end())
    throw Error(fmt::format("{} '{}': expected a name that ends in {}", option, file, fmt::join(extensions, " or ")));
  try {
    const fs::path path = fs::absolute(followed(utf8_path(file)));
    if (fs::is_directory(path)) throw Error(fmt::format("{} '{}': is a folder, expected a file name", option, file));
    fs::path folder = path.parent_path();
    while (!fs::exists(folder) && folder.has_relative_path()) folder = folder.parent_path();
    if (!fs::is_directory(folder))
      throw Error(fmt::format("{} '{}': {} is not a folder", option, file, folder.string()));
    if (!is_writable(folder))
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
