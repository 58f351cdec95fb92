// Pictures of a session: the tone-mapped scene and heat maps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "commands/request.h"
#include "image/image.h"
#include "render/shaders/shadow_leak_data.h"
#include "render/still_check.h"

namespace lamp::app {

/// Visits of the whole picture, of several views side by side, checked against nothing. The first view stays shown.
[[nodiscard]] std::vector<Visit> visit_all(Session& session, Lighting& lighting);

/// Calls `use` with the depth of each of the frame's pictures, which the renderer then draws.
void for_each_picture(Renderer& renderer, const std::function<void(std::span<const float>)>& use);

/// Lights walked at each pixel; SKY_CELL for sky.
[[nodiscard]] std::vector<std::uint32_t> walked_lights(std::span<const Visit> visits);
/// As `pixel_points` of a view (render/still_check.h), of several views side by side. The first stays shown.
[[nodiscard]] std::vector<gpu::StillPoint> all_pixel_points(Renderer& renderer);
/// Adds the lights that lists of still lights have at these points, one for each pixel.
void add_still_walks(const StillSetup& still, std::span<const gpu::StillPoint> points,
                     std::vector<std::uint32_t>& walked);

/// What a heat map counts.
enum class HeatOf : std::uint8_t {
  lights,        ///< that each pixel walks
  shadow_age,    ///< frames since the oldest shadow map that is looked up there was drawn
  shadow_size,   ///< texels a side of the smallest
  shadow_leaks,  ///< no count: light that a filter lets through or stops, and should not (draw_leak_map)
};
/// "lights", "shadow-age", "shadow-size", "shadow-leaks", in the order of HeatOf.
[[nodiscard]] std::span<const std::string_view> heat_names();
/// Throws Error, naming `--heatmap-of`, for what is no such name, or needs shadows that the request does not have.
[[nodiscard]] HeatOf parse_heat(const std::string& name, const Request& request);
/// As `shadow_heat` of a view (render/shadow_heat.h), of several views side by side. The first view stays shown.
[[nodiscard]] std::vector<std::uint32_t> shadow_heat(Session& session, Lighting& lighting, HeatOf of);
/// Throws Error, naming `--heatmap-of`, for what the lighting's lists or rays through the scene cannot say.
void check_heat(Session& session, const Lighting& lighting, HeatOf of);
/// As `shadow_leaks` of a view (render/shadow_leaks.h), likewise; of what `check_heat` has nothing against.
[[nodiscard]] std::vector<gpu::ShadowLeak> shadow_leaks(Session& session, Lighting& lighting);

/// Colours of what is no number in heat maps of shadows.
inline constexpr glm::u8vec3 WAITS_COLOR{255, 70, 40};
inline constexpr glm::u8vec3 WITHOUT_COLOR{255, 0, 200};

struct HeatmapRequest {
  std::string title;
  std::uint32_t scale_max = 0;        ///< 0: from the largest count
  const LdrImage* overlay = nullptr;  ///< lay the map over this picture
  HeatOf of = HeatOf::lights;
};
[[nodiscard]] LdrImage heatmap_of(Session& session, std::span<const std::uint32_t> counts,
                                  const HeatmapRequest& request);

/// "auto" (nothing) or a factor > 0.
[[nodiscard]] std::optional<float> parse_exposure(const std::string& text);

/// With its dot, in small letters.
[[nodiscard]] std::string extension_of(const std::filesystem::path& file);
/// Throws Error, naming the option, unless `file` ends in one of the extensions and looks as if it can be written.
/// Asked before long work begins; makes nothing.
void check_output(std::string_view option, const std::string& file, std::span<const std::string_view> extensions);

/// Calls `write` with the file, in a folder that is made where there is none, and goes again when writing fails.
void write_output(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

}  // namespace lamp::app
