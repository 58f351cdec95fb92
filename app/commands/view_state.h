// What a viewer shows, as one plain value: the command line, files, scripts and widgets all read and write this.
// Promise: a state that was written and read again is equal, and what the two show is the same bit for bit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/request.h"

namespace lamp::app {

/// What is laid over the picture.
enum class Overlay : std::uint8_t {
  none,
  heat,          ///< lights that each pixel walks
  cells,         ///< a colour for each cell
  light_cells,   ///< cells that list the light that is looked at, and of them those in which it reaches a pixel
  depth_range,   ///< how deep the surfaces of a cell's pixels reach from front to back
  mask,          ///< how much of that a mask of the occupied parts leaves out
  overflow,      ///< cells that did not fit, in a signal colour
  missed,        ///< pixels whose list lacks a light that reaches them, likewise
  difference,    ///< lights that one of two methods walks and the other does not; of two methods alone
  shadow_atlas,  ///< the shadow maps of all lights, or of the light that is looked at; where lights cast shadows
  shadow_age,    ///< frames since the oldest map that a pixel looks up was drawn; where lights cast shadows
  shadow_size,   ///< texels a side of the smallest of them
  shadow_leaks,  ///< light that a shadow filter lets through although rays are stopped, or stops; likewise
  slice,         ///< lights that a point of each pixel's ray would walk, at one depth
};
/// "none", "heat", "cells", "light-cells", "depth-range", "mask", "overflow", "missed", "difference", "shadow-atlas",
/// "shadow-age", "shadow-size", "shadow-leaks", "slice", in the order of Overlay.
[[nodiscard]] std::span<const std::string_view> overlay_names();

/// Whether an overlay shows shadows: without a light that casts one there is nothing to lay over.
[[nodiscard]] inline bool is_of_shadows(Overlay overlay) {
  return overlay >= Overlay::shadow_atlas && overlay <= Overlay::shadow_leaks;
}

/// Colours of the heat map.
enum class Palette : std::uint8_t { rainbow, blue_yellow, grey };
/// "rainbow", "blue-yellow", "grey", in the order of Palette.
[[nodiscard]] std::span<const std::string_view> palette_names();

/// Which lights are drawn where they are.
enum class LightMarks : std::uint8_t { none, cell, all };
/// "none", "cell", "all", in the order of LightMarks.
[[nodiscard]] std::span<const std::string_view> light_mark_names();

/// What a light's shadow map says of how far it reaches, drawn around the light.
enum class ShadowShape : std::uint8_t { none, bound, mesh };
/// "none", "bound", "mesh", in the order of ShadowShape.
[[nodiscard]] std::span<const std::string_view> shadow_shape_names();

/// A light of the frame (the scene's, then the generated ones) that is another than the request makes it.
struct LightEdit {
  std::uint32_t light = 0;
  Light value;
};

/// A second method beside the first, right of a line through the picture.
struct Against {
  std::string method = "all";
  std::vector<std::string> options;  ///< KEY=VALUE
  float divider = 0.5F;              ///< where the line is, of the width

  friend bool operator==(const Against&, const Against&) = default;
};

struct ViewState {
  Request request;                ///< scene, camera, lights, method, shading: what `lamp render` takes
  std::string exposure = "auto";  ///< or a factor
  std::uint32_t samples = 1;      ///< of a pixel, in pictures that are saved
  std::vector<LightEdit> edits;
  float resolution = 0.0F;  ///< of what is shown, over the size asked for; 0: what the device can do in time
  bool paused = false;
  float speed = 1.0F;  ///< frames of the flight per frame at 30 a second
  Overlay overlay = Overlay::none;
  Palette palette = Palette::rainbow;
  LightMarks light_marks = LightMarks::none;
  LightMarks proxies = LightMarks::none;         ///< of which lights the meshes are drawn that a method rasterises
  ShadowShape shadow_shape = ShadowShape::none;  ///< of the light that is looked at
  float slice_m = 5.0F;                          ///< depth of Overlay::slice
  bool depth_bins = false;                       ///< a strip of a method's bins of depth
  bool probe_boxes = false;                      ///< outlines of all reflection probes
  bool world_cells = false;                      ///< of a method of the world, those around the picked point
  bool decal_boxes = false;                      ///< outlines of all decals
  bool list_lengths = false;                     ///< how long lists are is counted with every picture
  std::optional<glm::uvec2> drawn;               ///< size in which it was shown, where that is not the one asked for
  std::optional<glm::uvec2> picked;              ///< pixel that is looked into, of the size asked for
  std::optional<std::uint32_t> light;            ///< that is looked at: its marks stand out
  std::string other;  ///< method whose answer is held against the pixel's list, once others were asked; or none
  std::optional<Against> against;
  bool panels = true;
  bool help = false;
};

/// Adds `--state FILE`, whose state is read into `state`; options that are added behind it change that.
void add_state_option(CLI::App& command, ViewState& state);
/// Adds `--exposure`.
void add_exposure_option(CLI::App& command, std::string& exposure);

/// Throws Error for whatever is wrong without a look at the scene: as `check_request`, and the rest.
void check_state(const ViewState& state);

/// After another size was asked for than `from`: what is picked stays where it is seen, since the field of view is that
/// of the height. What is not in the picture any more is not picked.
void fit_to_size(ViewState& state, glm::uvec2 from);

[[nodiscard]] nlohmann::json to_json(const ViewState& state);
/// Sets what the object has; the rest stays as it was. Throws Error: `name` (of the file), the element, what was
/// expected; then the state is as it was.
void read_state(ViewState& state, const nlohmann::json& json, const std::string& name);
/// A state's file. What it does not say is that of `state`.
[[nodiscard]] ViewState load_state(const std::filesystem::path& file, ViewState state = {});
void save_state(const std::filesystem::path& file, const ViewState& state);

/// As `make_setup` of the request, with the lights that were changed.
[[nodiscard]] Setup make_setup(const ViewState& state);
/// Makes a light of the frame this one.
void edit_light(ViewState& state, std::uint32_t light, const Light& value);
/// A light of a frame as a user describes it.
[[nodiscard]] Light unpacked(const shared::Light& light);
/// Puts the changed lights into those of a frame. Throws Error for a light that there is not, or that no light can be.
void apply_edits(const ViewState& state, std::span<shared::Light> lights);

}  // namespace lamp::app
