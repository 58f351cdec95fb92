// Keys to changes of the state.
// SPDX-License-Identifier: Apache-2.0
#include "view/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "commands/pictures.h"
#include "view/light_cells.h"

namespace lamp::app {
namespace {

constexpr std::array<KeyHelp, 27> HELP{{
    {"H, F1", "Shows and hides this help."},
    {"Tab", "Shows and hides the panels."},
    {"click", "Looks into a pixel: its cell and the lights there."},
    {"Escape", "Looks away, and closes the help."},
    {"drag", "Turns the camera."},
    {"W A S D, arrows", "Fly: ahead, left, back, right."},
    {"Q, E", "Fly down and up. Shift makes it ten times as fast."},
    {"R", "Goes back to the scene's camera."},
    {"Space", "Stops and starts time."},
    {"period, comma", "One frame on, one frame back."},
    {"O, Shift+O", "The next overlay, the one before."},
    {"P", "The next palette."},
    {"3, 4", "The slice of clusters nearer, farther."},
    {"Z", "Shows bins of depth as a strip."},
    {"L", "Shows lights: none, those of the cell, all."},
    {"K", "Shows the cells that list the light that is looked at."},
    {"X", "Shows the meshes that a method rasterises: none, of the cell's lights, of all."},
    {"C", "Shows what the light's shadow map bounds: nothing, by direction, its mesh."},
    {"Y", "Shows cells of the world around the picked point."},
    {"U", "Shows the volumes of reflection probes."},
    {"M, Shift+M", "The next method, the one before."},
    {"G", "The next shading path."},
    {"B", "A against B: the picture right of a line by a second method."},
    {"1, 2", "Darker, brighter. 0 sets the automatic exposure."},
    {"V", "Holds the whole picture against the oracle."},
    {"Ctrl+S", "Saves the picture; with Shift, the state."},
    {"Ctrl+Z", "Takes the last change back; with Shift, makes it again."},
}};

constexpr double METRES_A_SECOND = 3.0;
constexpr double QUICK = 10.0;
constexpr double STEEPEST = 0.499 * std::numbers::pi;

template <class Word>
void next_word(Word& value, std::size_t count, int by) {
  value = static_cast<Word>((static_cast<std::size_t>(value) + count + static_cast<std::size_t>(by)) % count);
}

std::string next_name(std::string_view name, std::span<const std::string_view> names, int by) {
  const auto count = static_cast<std::ptrdiff_t>(names.size());
  const std::ptrdiff_t at = std::ranges::find(names, name) - names.begin();
  return std::string(names[static_cast<std::size_t>((at + count + by) % count)]);
}

void next_method(ViewState& state, int by) {
  state.request.method = next_name(state.request.method, method_choices(), by);
  const auto method = find_method(state.request.method);
  state.request.options =
      method.ok() ? kept_options(state.request.options, *method.value()) : std::vector<std::string>();
}

void expose(ViewState& state, const Shown& shown, float factor) {
  const float now = parse_exposure(state.exposure).value_or(shown.exposure);
  state.exposure = fmt::format("{}", std::clamp(now * factor, 1e-6F, 1e6F));
}

/// Overlays that cannot be shown are passed over.
void next_overlay(ViewState& state, const Shown& shown, int by) {
  do next_word(state.overlay, overlay_names().size(), by);
  while (!why_no_overlay(state.overlay, state, shown).empty());
}

/// Why there is nothing to be seen of what a key switched on; or empty.
std::string why_nothing(std::string_view key, const ViewState& state, const Shown& shown) {
  if (key == "u" && state.probe_boxes && shown.probe_volumes.empty()) return "there are no reflection probes";
  if (key == "y" && state.world_cells && !state.picked) return "click a pixel: world cells are those around it";
  if (key == "c" && state.shadow_shape != ShadowShape::none) {
    if (!shown.first.stats.shadows) return "no light casts a shadow";
    if (!state.light) return NO_LIGHT;
  }
  if (key == "x" && state.proxies == LightMarks::cell && !shown.first.rasterises)
    return fmt::format("{} rasterises no lights; drobot-raster-tile and drobot-raster-cluster do",
                       shown.first.stats.method);
  if (key == "k" && state.overlay == Overlay::light_cells && !state.light) return NO_LIGHT;
  return "";
}

void move_slice(ViewState& state, float factor) {
  state.overlay = Overlay::slice;
  state.slice_m = std::clamp(state.slice_m * factor, 0.01F, 1e6F);
}

void toggle(Overlay& overlay, Overlay which) { overlay = overlay == which ? Overlay::none : which; }

void step_time(ViewState& state, const Shown& shown, int by) {
  state.paused = true;
  const int frames = shown.flight_frames != 0 ? static_cast<int>(shown.flight_frames) : 300;
  int& frame = state.request.frame >= 0 ? state.request.frame : state.request.light_frame;
  frame = (std::max(frame, 0) + frames + by) % frames;
}

/// Switches, which a key that is held turns once.
void switch_by_key(std::string_view key, int by, ViewState& state, const Shown& shown, Wishes& wishes) {
  if (key == "h" || key == "f1") state.help = !state.help;
  if (key == "r") state.request.free_camera.reset();
  if (key == "o") next_overlay(state, shown, by);
  if (key == "p") next_word(state.palette, palette_names().size(), by);
  if (key == "l") next_word(state.light_marks, light_mark_names().size(), by);
  if (key == "m") next_method(state, by);
  if (key == "g") state.request.path = next_name(state.request.path, path_names(), by);
  if (key == "b") state.against = state.against ? std::nullopt : std::optional(Against());
  if (key == "v") wishes.prove = true;
  if (key == "k") toggle(state.overlay, Overlay::light_cells);
  if (key == "x") next_word(state.proxies, light_mark_names().size(), by);
  if (key == "c") next_word(state.shadow_shape, shadow_shape_names().size(), by);
  if (key == "y") state.world_cells = !state.world_cells;
  if (key == "u") state.probe_boxes = !state.probe_boxes;
  if (key == "z") state.depth_bins = !state.depth_bins;
  if (key == "0") state.exposure = "auto";
  if (std::string why = why_nothing(key, state, shown); !why.empty()) wishes.say = std::move(why);
}

/// Steps, which a key that is held repeats.
void step_by_key(std::string_view key, ViewState& state, const Shown& shown) {
  if (key == "3") move_slice(state, 1.0F / 1.1F);
  if (key == "4") move_slice(state, 1.1F);
  if (key == "1") expose(state, shown, 1.0F / 1.25F);
  if (key == "2") expose(state, shown, 1.25F);
  if (key == "period") step_time(state, shown, 1);
  if (key == "comma") step_time(state, shown, -1);
}

}  // namespace

std::span<const KeyHelp> key_help() { return HELP; }

void apply_keys(const Input& input, ViewState& state, const Shown& shown, Wishes& wishes, bool focus) {
  const bool shift = input.holds("shift");
  for (const std::string& key : input.repeated) {
    if (!input.holds("ctrl")) step_by_key(key, state, shown);
    if (input.holds("ctrl") && key == "z") (shift ? wishes.redo : wishes.undo) = true;
  }
  for (const std::string& key : input.pressed) {
    if (input.holds("ctrl")) {
      if (key == "s") (shift ? wishes.save_state : wishes.save_picture) = true;
      if (key == "z") (shift ? wishes.redo : wishes.undo) = true;
      continue;
    }
    switch_by_key(key, shift ? -1 : 1, state, shown, wishes);
    step_by_key(key, state, shown);
    if (focus) continue;
    if (key == "tab") state.panels = !state.panels;
    if (key == "space") state.paused = !state.paused;
    if (key == "escape" && !state.help) {
      state.picked.reset();
      state.light.reset();
    }
    if (key == "escape") state.help = false;
  }
}

void fly(const Input& input, ViewState& state, const Shown& shown, glm::dvec2 look, float seconds, bool focus) {
  if (input.holds("ctrl") || shown.number == 0 || shown.captured) return;
  const auto held = [&](std::string_view letter, std::string_view arrow) {
    return input.holds(letter) || (!focus && !arrow.empty() && input.holds(arrow)) ? 1.0 : 0.0;
  };
  const glm::dvec3 move(held("d", "right") - held("a", "left"), held("e", "") - held("q", ""),
                        held("w", "up") - held("s", "down"));
  if (move == glm::dvec3(0.0) && look == glm::dvec2(0.0)) return;
  if (!state.request.free_camera) {
    if (state.request.frame >= 0) state.request.light_frame = state.request.frame;
    state.request.frame = -1;
    state.request.free_camera = free_from(shown.scene_camera);
  }
  FreeCamera& camera = *state.request.free_camera;
  camera.yaw = std::remainder(camera.yaw - look.x, 2.0 * std::numbers::pi);
  camera.pitch = std::clamp(camera.pitch - look.y, -STEEPEST, STEEPEST);
  const double metres = METRES_A_SECOND * seconds * (input.holds("shift") ? QUICK : 1.0);
  camera.eye += metres * (move.x * right(camera) + glm::dvec3(0.0, move.y, 0.0) + move.z * ahead(camera));
}

}  // namespace lamp::app
