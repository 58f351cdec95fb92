// The options of shadows.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <limits>

#include "commands/command_line.h"
#include "commands/request.h"
#include "gpu/check.h"
#include "lamplight/shadow_atlas.h"

namespace lamp::app {
namespace {

constexpr std::string_view ALL = "all";
constexpr std::array<std::string_view, 5> FILTERS{"off", "hard", "pcf", "vsm",
                                                  "evsm"};                         // then in the order of ShadowFilter
constexpr std::array<std::string_view, 2> POINTS{"faces", "octahedron"};           // in the order of PointShadows
constexpr std::array<std::string_view, 3> RASTERS{"auto", "hardware", "compute"};  // in the order of ShadowRaster
constexpr std::array<std::string_view, 3> BLURS{"fused", "lines", "listing"};      // in the order of ShadowBlur

/// A whole number, or all.
template <class Number>
Number parse_count(const char* option, const std::string& text, Number all) {
  if (text == ALL) return all;
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw Error(fmt::format("{} '{}': expected a whole number from 0 to {}, or all", option, text,
                            std::numeric_limits<Number>::max()));
  return number;
}

/// Bounds reckon with where taps lie.
void check_cuts(const Request& request, const ShadowSettings& settings) {
  if (settings.blur != ShadowBlur::listing || !ShadowMoments::has(settings.filter)) return;
  if (const auto cut = cut_by_shadows(request.options))
    throw Error(
        fmt::format("--option {}: the taps of --shadow-blur listing lie anywhere, so that nothing can be cut; "
                    "expected --shadow-blur fused or lines",
                    *cut));
}

}  // namespace

std::span<const std::string_view> shadow_names() { return FILTERS; }
std::span<const std::string_view> point_shadow_names() { return POINTS; }
std::span<const std::string_view> shadow_raster_names() { return RASTERS; }
std::span<const std::string_view> shadow_blur_names() { return BLURS; }

std::optional<std::string_view> cut_by_shadows(std::span<const std::string> options) {
  for (const std::string_view cut : {"occlusion=radial", "proxy=cut"})
    if (std::ranges::find(options, cut) != options.end()) return cut;
  return std::nullopt;
}

std::string_view shadow_filter_name(ShadowFilter filter) { return FILTERS[static_cast<std::size_t>(filter) + 1]; }

std::optional<ShadowSettings> requested_shadows(const Request& request) {
  const std::size_t filter = parse_name("--shadows", request.shadows.filter, FILTERS);
  const ShadowSettings settings{
      .filter = filter == 0 ? ShadowFilter::hard : static_cast<ShadowFilter>(filter - 1),
      .points = static_cast<PointShadows>(parse_name("--point-shadows", request.shadows.points, POINTS)),
      .raster = static_cast<ShadowRaster>(parse_name("--shadow-raster", request.shadows.raster, RASTERS)),
      .blur = static_cast<ShadowBlur>(parse_name("--shadow-blur", request.shadows.blur, BLURS)),
      .atlas_size = request.shadows.atlas,
      .lights = parse_count("--shadow-lights", request.shadows.lights, ~0U),
      .budget_texels = parse_count("--shadow-budget", request.shadows.budget, ALL_TEXELS)};
  if (filter == 0) return std::nullopt;
  check_cuts(request, settings);
  return settings;
}

std::optional<ShadowSettings> requested_shadows(const Request& request, const Scene& scene) {
  const std::optional<ShadowSettings> settings = requested_shadows(request);
  if (settings && scene.captured)
    throw Error(fmt::format("--shadows {}: the capture {} has no triangles that could cast one, expected off",
                            request.shadows.filter, request.scene));
  return settings;
}

void check_shadow_choice(const Request& request) {
  if (!requested_shadows(request)) {
    if (const auto cut = cut_by_shadows(request.options))
      throw Error(fmt::format("--option {}: cuts lights by their shadow maps; expected --shadows FILTER too", *cut));
    return;
  }
  const std::uint32_t size = request.shadows.atlas;
  static_cast<void>(take(ShadowAtlas::create({.size = size, .max_image_size = size})));  // the device may take less
}

void add_shadow_options(CLI::App& command, Request& r) {
  add_shadow_map_options(command, r);
  command
      .add_option("--shadow-budget", r.shadows.budget,
                  "texels of shadow maps that are drawn in a frame, or all; what waits is counted")
      ->type_name("TEXELS")
      ->group("Shadows")
      ->capture_default_str();
}

void add_shadow_map_options(CLI::App& command, Request& r) {
  command.add_option("--shadows", r.shadows.filter, "how shadows are filtered: off, hard, pcf, vsm or evsm")
      ->type_name("FILTER")
      ->group("Shadows")
      ->capture_default_str();
  command.add_option("--shadow-lights", r.shadows.lights, "how many lights cast shadows, the first so many, or all")
      ->type_name("N")
      ->group("Shadows")
      ->capture_default_str();
  command
      .add_option("--atlas", r.shadows.atlas, "side of the image that holds all shadow maps, texels, a power of two")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()))
      ->type_name("SIZE")
      ->group("Shadows")
      ->capture_default_str();
  command.add_option("--point-shadows", r.shadows.points, "a point light's map: six faces or one octahedron")
      ->type_name("NAME")
      ->group("Shadows")
      ->capture_default_str();
  command
      .add_option(
          "--shadow-raster", r.shadows.raster,
          "what draws shadow maps: the GPU's rasterizer (hardware) or compute shaders (compute); auto takes compute, "
          "but not on Mesa's llvmpipe")
      ->type_name("NAME")
      ->group("Shadows")
      ->capture_default_str();
  command
      .add_option(
          "--shadow-blur", r.shadows.blur,
          "how vsm and evsm are blurred: both ways in one pass (fused); in two passes, line by line (lines), or by the "
          "indices of the article's listing, which mix lines (listing)")
      ->type_name("NAME")
      ->group("Shadows")
      ->capture_default_str();
}

}  // namespace lamp::app
