// Scene, camera, lights.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "commands/still_stats.h"
#include "scene/builtin.h"
#include "scene/flight.h"
#include "view/panels.h"

namespace lamp::app {
namespace {

constexpr const char* SCENE_CAMERA = "camera";
constexpr const char* FLIGHT = "flight";
constexpr const char* FREE = "free";
const std::string NO_FLIGHT = "the scene has no flight";
const std::string OF_A_CAPTURE = "a capture is one view, and has its own";

std::string camera_kind(const Request& r) { return r.free_camera ? FREE : r.frame >= 0 ? FLIGHT : SCENE_CAMERA; }

void set_camera_kind(PanelFrame& p, const std::string& kind) {
  Request& r = p.state.request;
  if (kind == FREE && !r.free_camera) r.free_camera = free_from(p.shown.scene_camera);
  if (kind != FREE) r.free_camera.reset();
  if (r.frame >= 0 && kind != FLIGHT) r.light_frame = r.frame;
  r.frame = kind == FLIGHT ? std::max({r.frame, r.light_frame % static_cast<int>(p.shown.flight_frames), 0}) : -1;
  if (kind == FLIGHT) r.light_frame = -1;
}

void choose_camera(PanelFrame& p) {
  if (p.shown.captured || p.shown.cameras.size() < 2) return;
  std::vector<std::string_view> names(p.shown.cameras.begin(), p.shown.cameras.end());
  std::string name = p.state.request.camera.empty() ? p.shown.cameras.front() : p.state.request.camera;
  if (!p.widgets.choose("camera of the scene", name, names, "The scene's cameras; a free camera starts where it is."))
    return;
  p.state.request.camera = name;
  set_camera_kind(p, SCENE_CAMERA);
}

/// Lights that stand still, and what these are looked up in.
void choose_still(PanelFrame& p) {
  Request& r = p.state.request;
  p.widgets.slide("still", r.still, {},
                  "Which part of the generated lights stand still; those of the scene always do.");
  const auto with = [&](std::string_view lists) {
    Request changed = r;
    changed.still_lists = lists;
    if (lists == still_lists_names().front()) changed.still_occlusion = 0;
    return changed;
  };
  const auto reason = [&](std::string_view lists) {
    return p.shown.captured && lists != still_lists_names().front() ? std::string("a capture has no triangles")
                                                                    : why_refused(with(lists));
  };
  std::string lists = r.still_lists;
  if (p.widgets.choose("still lists", lists, still_lists_names(),
                       "Looks lights that stand still up in lists that were made ahead: by a pixel's triangle, or in a "
                       "tree by its position.",
                       reason))
    r = with(lists);
  if (r.still_lists == still_lists_names().front()) return;
  p.widgets.slide("still occlusion", r.still_occlusion, {.min = 0, .max = 64},
                  "Leaves still lights out where walls surely hide them: texels a side of the cube with which each "
                  "looks around. 0: walls hide nothing, and lights shine through them.");
  p.widgets.slide("still bytes", r.still_bytes, {.min = 0, .max = 1e4, .logarithmic = true},
                  "Bytes for each triangle that the lists may take: less room makes lists longer. 0: without limit.");
  Widgets::steady(3, [&] { Widgets::note(p.shown.first.stats.still ? still_words(*p.shown.first.stats.still) : ""); });
}

}  // namespace

std::string named_by_widgets(std::string_view error) {
  return with_options_named(error, [](std::string_view option) {
    std::string words(option);
    std::ranges::replace(words, '-', ' ');
    return words;
  });
}

std::string why_refused(const Request& request) {
  try {
    check_request(request, request.method);
  } catch (const Error& error) {
    return named_by_widgets(error.what());
  }
  return "";
}

void scene_panel(PanelFrame& p) {
  if (!p.widgets.header("Scene", true)) return;
  std::vector<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  std::string scene = p.state.request.scene;
  bool changed = p.widgets.choose("scene", scene, names, "A built-in scene. A file can be dropped on the window, too.");
  changed =
      p.widgets.write("scene file", scene,
                      "A .gltf or .glb file, or the folder of a capture. It is opened when you leave the field.") ||
      changed;
  if (changed && scene != p.state.request.scene) {
    Request& r = p.state.request;
    r.scene = scene;
    r.camera.clear();
    r.free_camera.reset();
    r.frame = -1;
    p.state.edits.clear();
    p.state.picked.reset();
    p.state.light.reset();
  }
  for (const std::string& note : p.shown.notes) Widgets::note(note);
}

void camera_panel(PanelFrame& p) {
  if (!p.widgets.header("Camera and time", true)) return;
  Request& r = p.state.request;
  const auto reason = [&](std::string_view kind) {
    if (p.shown.captured && kind != SCENE_CAMERA) return OF_A_CAPTURE;
    return kind == FLIGHT && p.shown.flight_frames == 0 ? NO_FLIGHT : std::string();
  };
  constexpr std::string_view KINDS[] = {SCENE_CAMERA, FLIGHT, FREE};
  std::string kind = camera_kind(r);
  if (p.widgets.choose("view from", kind, KINDS,
                       "A camera of the scene, its flight, or wherever you fly (W A S D Q E and the mouse).", reason))
    set_camera_kind(p, kind);
  choose_camera(p);
  p.widgets.choose("projection", r.projection, projection_names(), "How the camera projects.");
  p.widgets.check("pause", p.state.paused, "Lights and the flight stand still. The space bar does the same.");
  ImGui::SameLine();
  if (p.widgets.button("step", "Advances by one frame of the flight.")) p.wishes.step = true;
  p.widgets.slide("speed", p.state.speed, {.min = -4.0, .max = 4.0},
                  "Frames of the flight for every 30th of a second.");
  const int frame = r.frame >= 0 ? r.frame : std::max(0, r.light_frame);
  auto at = static_cast<std::uint32_t>(frame);
  const double last = p.shown.flight_frames != 0 ? p.shown.flight_frames - 1 : 299;
  if (p.widgets.slide("frame", at, {.min = 0, .max = last}, "Where on their paths the lights and the flight are."))
    (r.frame >= 0 ? r.frame : r.light_frame) = static_cast<int>(at);
}

void lights_panel(PanelFrame& p) {
  if (!p.widgets.header("Lights", true)) return;
  Request& r = p.state.request;
  if (p.widgets.slide("number", r.lights, {.min = 0, .max = 1'000'000, .logarithmic = true},
                      "Generated lights, besides the scene's own."))
    r.lights_given = true;
  p.widgets.slide("spots", r.spots, {}, "Which part of the generated lights are spots.");
  p.widgets.write("range", r.range,
                  "Of the generated lights in metres, MIN:MAX or one number. Empty: about 24 reach a point.",
                  "by their number");
  auto seed = static_cast<std::uint32_t>(std::min<std::uint64_t>(r.seed, ~0U));
  const double top = std::max(1000U, seed);
  if (p.widgets.slide("seed", seed, {.min = 0, .max = top}, "Another seed makes other lights and decals."))
    r.seed = seed;
  choose_still(p);
  p.widgets.slide("decals", r.decals, {.min = 0, .max = 1024, .logarithmic = true},
                  "Box decals: the scene's own first, then generated ones.", p.shown.captured ? OF_A_CAPTURE : "");
  p.widgets.choose_word(
      "show lights", p.state.light_marks, light_mark_names(),
      "Draws where lights are and how far they reach: none, those of the cell that you look into, or all.");
  p.widgets.check("decal boxes", p.state.decal_boxes, "Draws the outlines of all decals.",
                  p.shown.decals.empty() ? "there are no decals" : "");
  if (p.widgets.button("undo changes", "Every light becomes again what the options make it.",
                       p.state.edits.empty() ? "no light was changed" : ""))
    p.state.edits.clear();
  Widgets::beside();
  Widgets::note(p.state.edits.empty() ? "" : fmt::format("of {} lights", p.state.edits.size()));
}

}  // namespace lamp::app
