// Names, options and checks of a viewer's state.
// SPDX-License-Identifier: Apache-2.0
#include "commands/view_state.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "commands/command_line.h"
#include "commands/pictures.h"
#include "files/utf8_path.h"
#include "system/print.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 14> OVERLAYS{
    "none",   "heat",       "cells",        "light-cells", "depth-range", "mask",         "overflow",
    "missed", "difference", "shadow-atlas", "shadow-age",  "shadow-size", "shadow-leaks", "slice"};
constexpr std::array<std::string_view, 3> PALETTES{"rainbow", "blue-yellow", "grey"};
constexpr std::array<std::string_view, 3> LIGHT_MARKS{"none", "cell", "all"};
constexpr std::array<std::string_view, 3> SHADOW_SHAPES{"none", "bound", "mesh"};

std::string_view key_of(std::string_view setting) { return setting.substr(0, setting.find('=')); }

/// Who names another camera leaves that of the state; lights stay where they are, unless a frame is named.
void change_camera(const CLI::App& command, Request& request) {
  const bool flight = value_of(command, "--frames").find("..") != std::string::npos;
  if (flight || is_given(command, "--frame")) {
    request.free_camera.reset();
    request.camera.clear();
    request.light_frame = -1;
    if (!is_given(command, "--frame")) request.frame = -1;
  } else if (is_given(command, "--camera")) {
    request.free_camera.reset();
    if (request.light_frame < 0) request.light_frame = request.frame;
    request.frame = -1;
  }
}

/// Options of the state's method stay, but those that are given anew. Another method has none of them.
void change_options(const CLI::App& command, const Request& read, Request& request) {
  const bool given = is_given(command, "--option");
  if (request.method != read.method) {
    if (given || read.options.empty()) return;
    print_error("--method {}: the state's {} is of {}, and left out\n", request.method, fmt::join(read.options, ", "),
                read.method);
    request.options.clear();
    return;
  }
  if (!given) return;
  std::vector<std::string> merged;
  for (const std::string& old : read.options)
    if (std::ranges::find(request.options, key_of(old), key_of) == request.options.end()) merged.push_back(old);
  merged.insert(merged.end(), request.options.begin(), request.options.end());
  request.options = std::move(merged);
}

}  // namespace

std::span<const std::string_view> overlay_names() { return OVERLAYS; }
std::span<const std::string_view> palette_names() { return PALETTES; }
std::span<const std::string_view> light_mark_names() { return LIGHT_MARKS; }
std::span<const std::string_view> shadow_shape_names() { return SHADOW_SHAPES; }

void add_state_option(CLI::App& command, ViewState& state) {
  const auto read = std::make_shared<std::optional<Request>>();
  command
      .add_option_function<std::string>(
          "--state",
          [&state, read](const std::string& file) {
            state = load_state(utf8_path(file), state);
            *read = state.request;
          },
          "begin with the state that lamp-view saved in this file; other options change it")
      ->type_name("FILE")
      ->group("View");
  command.parse_complete_callback([&command, &state, read] {
    if (!*read) return;
    change_camera(command, state.request);
    change_options(command, **read, state.request);
    if (is_given(command, "--size")) fit_to_size(state, parse_size((*read)->size));
  });
}

void add_exposure_option(CLI::App& command, std::string& exposure) {
  command.add_option("--exposure", exposure, "factor of the picture's brightness, or auto: from its surfaces")
      ->type_name("FACTOR")
      ->group("View")
      ->capture_default_str();
}

void check_state(const ViewState& state) {
  check_request(state.request, state.request.method);
  static_cast<void>(parse_exposure(state.exposure));
  if (!state.other.empty()) static_cast<void>(parse_method(state.other));
  if (!state.against) return;
  Request other = state.request;
  other.options = state.against->options;
  check_request(other, state.against->method);
}

void fit_to_size(ViewState& state, glm::uvec2 from) {
  const glm::uvec2 to = parse_size(state.request.size);
  if (to == from) return;
  state.drawn.reset();
  if (!state.picked) return;
  const double scale = static_cast<double>(to.y) / from.y;
  const glm::dvec2 place = 0.5 * glm::dvec2(to) + scale * (glm::dvec2(*state.picked) + 0.5 - 0.5 * glm::dvec2(from));
  const bool seen = place.x >= 0.0 && place.y >= 0.0 && place.x < to.x && place.y < to.y;
  state.picked = seen ? std::optional(glm::uvec2(place)) : std::nullopt;
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
