// Names, options and checks of a viewer's state.
// SPDX-License-Identifier: Apache-2.0
#include "commands/view_state.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/command_line.h"
#include "commands/pictures.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 14> OVERLAYS{
    "none",   "heat",       "cells",        "light-cells", "depth-range", "mask",         "overflow",
    "missed", "difference", "shadow-atlas", "shadow-age",  "shadow-size", "shadow-leaks", "slice"};
constexpr std::array<std::string_view, 3> PALETTES{"rainbow", "blue-yellow", "grey"};
constexpr std::array<std::string_view, 3> LIGHT_MARKS{"none", "cell", "all"};
constexpr std::array<std::string_view, 3> SHADOW_SHAPES{"none", "bound", "mesh"};

void check_projection(const std::string& name) {
  if (const std::string wrong = one_of(name, projection_names()); !wrong.empty())
    throw Error(fmt::format("--projection: {}", wrong));
}

}  // namespace

std::span<const std::string_view> overlay_names() { return OVERLAYS; }
std::span<const std::string_view> palette_names() { return PALETTES; }
std::span<const std::string_view> light_mark_names() { return LIGHT_MARKS; }
std::span<const std::string_view> shadow_shape_names() { return SHADOW_SHAPES; }

void add_state_option(CLI::App& command, ViewState& state) {
  command
      .add_option_function<std::string>(
          "--state", [&state](const std::string& file) { state = load_state(file); },
          "begin with the state that lamp-view saved in this file; other options change it")
      ->type_name("FILE")
      ->group("View");
}

void add_exposure_option(CLI::App& command, std::string& exposure) {
  command.add_option("--exposure", exposure, "factor of the picture's brightness, or auto: from its surfaces")
      ->type_name("FACTOR")
      ->group("View")
      ->capture_default_str();
}

void check_state(const ViewState& state) {
  check_request(state.request, state.request.method);
  check_projection(state.request.projection);
  static_cast<void>(parse_exposure(state.exposure));
  if (!state.other.empty()) static_cast<void>(parse_method(state.other));
  if (!state.against) return;
  Request other = state.request;
  other.options = state.against->options;
  check_request(other, state.against->method);
}

void apply_edits(const ViewState& state, std::span<shared::Light> lights) {
  for (const LightEdit& edit : state.edits) {
    if (edit.light >= lights.size())
      throw Error(fmt::format("edits: light {}: there is none, expected one of the {} of the frame", edit.light,
                              lights.size()));
    if (const auto error = check_shown_lights({&edit.value, 1}))
      throw Error(fmt::format("edits: light {}: {}", edit.light, error->message));
    lights[edit.light] = pack(edit.value);
  }
}

void edit_light(ViewState& state, std::uint32_t light, const Light& value) {
  const auto found = std::ranges::find(state.edits, light, &LightEdit::light);
  if (found != state.edits.end())
    found->value = value;
  else
    state.edits.push_back({.light = light, .value = value});
}

Light unpacked(const shared::Light& light) {
  const float intensity = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
  return {.type = static_cast<LightType>(light.type),
          .position = light.position,
          .range = light.range,
          .color = intensity > 0.0F ? glm::vec3(light.intensity) / intensity : glm::vec3(1.0F),
          .intensity = intensity,
          .direction = light.direction,
          .inner_angle = light.inner_angle,
          .outer_angle = light.outer_angle};
}

Setup make_setup(const ViewState& state) {
  Setup setup = make_setup(state.request);
  apply_edits(state, setup.lights);
  return setup;
}

}  // namespace lamp::app
