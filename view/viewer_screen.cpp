// The viewer's screen: where the picture is, what the mouse does there, and what is drawn beside and over it.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

#include "view/depth_bins.h"
#include "view/light_marks.h"
#include "view/shape_lines.h"
#include "view/viewer.h"
#include "view/world_boxes.h"

namespace lamp::app {
namespace {

constexpr float PANEL_WIDTH = 400.0F;  // pixels at scale 1
constexpr float STATUS_HEIGHT = 24.0F;
constexpr float RADIANS_A_PIXEL = 0.004F;
constexpr float STILL_PX = 4.0F;  // a press that moved no farther is a click
constexpr float DIVIDER_PX = 6.0F;
const ImVec4 ALARM{1.0F, 0.45F, 0.35F, 1.0F};

/// The largest rectangle of that aspect in the middle of an area.
ScreenRect fitted(const ScreenRect& area, glm::uvec2 size) {
  const glm::dvec2 room(glm::max(area.size(), glm::ivec2(1)));
  const double scale = std::min(room.x / size.x, room.y / size.y);
  const glm::ivec2 fit = glm::max(glm::ivec2(1), glm::ivec2(glm::dvec2(size) * scale + 0.5));
  const glm::ivec2 min = area.min + (glm::ivec2(room) - fit) / 2;
  return {.min = min, .max = min + fit};
}

bool contains(const ScreenRect& rect, glm::vec2 at) {
  return at.x >= static_cast<float>(rect.min.x) && at.y >= static_cast<float>(rect.min.y) &&
         at.x < static_cast<float>(rect.max.x) && at.y < static_cast<float>(rect.max.y);
}

float divider_x(const ScreenRect& picture, const Against& against) {
  return static_cast<float>(picture.min.x) + against.divider * static_cast<float>(picture.size().x);
}

void draw_divider(const ScreenRect& picture, const Shown& shown) {
  if (!shown.state.against || !shown.second) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const glm::vec2 min(picture.min);
  const glm::vec2 max(picture.max);
  draw.PushClipRect({min.x, min.y}, {max.x, max.y});
  const float x = divider_x(picture, *shown.state.against);
  draw.AddLine({x, static_cast<float>(picture.min.y)}, {x, static_cast<float>(picture.max.y)},
               IM_COL32(255, 255, 255, 200), 2.0F);
  float y = min.y + 6.0F;
  float end = min.x;  // of the first label, which the second may not cover
  const auto label = [&](float left, const std::string& words) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    left = std::max(min.x + 4.0F, std::min(left, max.x - size.x - 4.0F));
    if (left - 4.0F < end) y += size.y + 6.0F;
    end = left + size.x + 4.0F;
    draw.AddRectFilled({left - 4.0F, y - 2.0F}, {end, y + size.y + 2.0F}, IM_COL32(0, 0, 0, 160));
    draw.AddText({left, y}, IM_COL32_WHITE, words.c_str());
  };
  const std::string a = words_of_method(shown.first.stats);
  label(x - 10.0F - ImGui::CalcTextSize(a.c_str()).x, a);
  label(x + 10.0F, words_of_method(shown.second->stats));
  draw.PopClipRect();
}

/// Shadow maps in place of the picture: nothing of the world is where it would be in the picture.
bool shows_atlas(const Shown& shown) {
  return shown.first.legend.overlay == Overlay::shadow_atlas && shown.first.legend.refused.empty();
}

void draw_frame(const glm::vec2& min, const glm::vec2& max) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRect({min.x, min.y}, {max.x, max.y}, IM_COL32(0, 0, 0, 255), 0.0F, 0, 3.0F);
  draw.AddRect({min.x, min.y}, {max.x, max.y}, IM_COL32_WHITE);
}

/// Frames around the pixel that is looked into, and around its cell.
void draw_picked(const ScreenRect& picture, const Shown& shown) {
  if (!shown.inspection) return;
  const Inspection& found = *shown.inspection;
  const glm::vec2 corner(picture.min);
  const glm::vec2 scale = glm::vec2(picture.size()) / glm::vec2(shown.view.width(), shown.view.height());
  const glm::vec2 middle = corner + (glm::vec2(found.pixel) + 0.5F) * scale;
  const float half = std::max(5.0F, 0.5F * scale.x + 2.0F);
  if (!found.sky)
    draw_frame(corner + glm::vec2(found.cell_min_px) * scale, corner + glm::vec2(found.cell_end_px) * scale);
  draw_frame(middle - half, middle + half);
}

/// What to do first, over the top of the picture, until a pixel is picked.
void draw_hint(const ScreenRect& picture, float scale) {
  const char* const words = "Click a pixel: which lights are in its cell, and why";
  const ImVec2 size = ImGui::CalcTextSize(words);
  const float room = static_cast<float>(picture.size().x);
  if (size.x + 16.0F * scale > room) return;
  const ImVec2 at(static_cast<float>(picture.min.x) + 0.5F * (room - size.x),
                  static_cast<float>(picture.min.y) + 10.0F * scale);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({at.x - 8.0F * scale, at.y - 4.0F * scale},
                     {at.x + size.x + 8.0F * scale, at.y + size.y + 4.0F * scale}, IM_COL32(0, 0, 0, 190),
                     4.0F * scale);
  draw.AddText(at, IM_COL32_WHITE, words);
}

}  // namespace

void Viewer::lay_out(glm::uvec2 screen) {
  // On a narrow screen the panels lie over the picture.
  const bool beside = state_.panels && static_cast<float>(screen.x) > 1.5F * PANEL_WIDTH * scale_;
  const auto left = static_cast<int>(beside ? PANEL_WIDTH * scale_ : 0.0F);
  const auto bottom = static_cast<int>(STATUS_HEIGHT * scale_);
  area_ = {.min = {left, 0}, .max = {static_cast<int>(screen.x), std::max(1, static_cast<int>(screen.y) - bottom)}};
  fit_to_area(state_);
  fit_to_area(settled_);
  asked_ = parse_size(state_.request.size);
  const glm::uvec2 size = shown_.captured ? glm::uvec2(shown_.view.width(), shown_.view.height()) : asked_;
  picture_ = fitted(area_, size);
}

void Viewer::fit_to_area(ViewState& state) const {
  Request& r = state.request;
  std::string size = fmt::format("{}x{}", area_.size().x, area_.size().y);
  if (r.size_given || r.size == size) return;
  const glm::uvec2 from = parse_size(std::exchange(r.size, std::move(size)));
  if (!shown_.captured && !is_captured(r.scene)) fit_to_size(state, from);
}

void Viewer::use_mouse(const Input& input, float seconds, bool focus) {
  glm::dvec2 look(0.0);
  const bool held = input.buttons[0] || input.buttons[1];
  const bool over = input.mouse && contains(picture_, *input.mouse) && !ImGui::GetIO().WantCaptureMouse;
  if (held && !pressed_at_ && over) {
    pressed_at_ = input.mouse;
    drags_divider_ = state_.against && std::abs(input.mouse->x - divider_x(picture_, *state_.against)) < DIVIDER_PX;
  }
  if (pressed_at_ && input.mouse) {
    dragging_ = dragging_ || glm::distance(*input.mouse, *pressed_at_) > STILL_PX;
    const float across = (input.mouse->x - static_cast<float>(picture_.min.x)) / static_cast<float>(picture_.size().x);
    if (dragging_ && drags_divider_ && state_.against)
      state_.against->divider = std::clamp(across, 0.0F, 1.0F);
    else if (dragging_ && last_mouse_)
      look = glm::dvec2(*input.mouse - *last_mouse_) * double{RADIANS_A_PIXEL};
  }
  if (!held && pressed_at_) {
    if (!dragging_ && shown_.number != 0) {
      const glm::vec2 size = shown_.captured ? glm::vec2(shown_.view.width(), shown_.view.height()) : glm::vec2(asked_);
      const glm::vec2 at = (*pressed_at_ - glm::vec2(picture_.min)) / glm::vec2(picture_.size()) * size;
      state_.picked = glm::uvec2(glm::clamp(at, glm::vec2(0.0F), size - 1.0F));
    }
    pressed_at_.reset();
    dragging_ = false;
  }
  last_mouse_ = input.mouse;
  Input flying = input;
  for (const std::string& key : chords_) flying.held.erase(key);
  fly(flying, state_, shown_, look, seconds, focus);
}

void Viewer::draw_panels(glm::uvec2 screen, float progress) {
  numbers_ = shown_.number != 0 ? draw_cell_numbers(shown_, picture_) : 0;
  if (shown_.number != 0 && !shows_atlas(shown_)) {
    draw_light_marks(state_.light_marks, shown_, picture_);
    draw_light_shapes(shown_, picture_);
    draw_world_cells(shown_, picture_);
    draw_probe_boxes(shown_, picture_);
    if (state_.decal_boxes) draw_decal_boxes(shown_, picture_);
    draw_picked(picture_, shown_);
  }
  draw_divider(picture_, shown_);
  if (state_.panels && shown_.number != 0 && !state_.picked && !state_.against) draw_hint(picture_, scale_);
  const float bins = shown_.number == 0 ? 0.0F : depth_bins_height(shown_, scale_);
  legend_window(shown_, picture_, std::max(bins, static_cast<float>(picture_.max.y) - status_top(screen)), numbers_);
  if (shown_.number != 0) draw_depth_bins(shown_, picture_, scale_);
  if (state_.help) help_window(area_, scale_);
  Widgets widgets(places_);
  InspectorFrame inspector{.shown = shown_,
                           .widgets = widgets,
                           .state = state_,
                           .wishes = wishes_,
                           .scroll = list_scroll_,
                           .others = others_,
                           .outdated = outdated_,
                           .asking = asking_};
  inspector_window(inspector, area_, scale_);
  if (!state_.panels) return;
  const glm::vec2 room(screen);
  const bool beside = area_.min.x != 0;
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize(
      {std::min(PANEL_WIDTH * scale_, room.x), beside ? room.y : std::max(1.0F, room.y - STATUS_HEIGHT * scale_)});
  constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin("panels", nullptr, FIXED)) {
    PanelFrame p{.state = state_,
                 .shown = shown_,
                 .widgets = widgets,
                 .times = times_,
                 .traits = traits_,
                 .depth_samples = depth_samples_,
                 .wishes = wishes_,
                 .files = files_,
                 .waiting = waiting(),
                 .bookmarks = bookmarks_,
                 .bookmark = bookmark_,
                 .proof = proof_,
                 .proving = proving_,
                 .progress = progress};
    if (widgets.button("help", "All keys. H does the same.")) state_.help = !state_.help;
    for (void (*panel)(PanelFrame&) : {proof_panel, scene_panel, camera_panel, lights_panel, method_panel, shadow_panel,
                                       world_panel, against_panel, look_panel, times_panel, save_panel, bookmark_panel})
      panel(p);
  }
  ImGui::End();
}

std::string Viewer::status() const {
  if (lost_) return "The device was lost. The state can still be saved.";
  if (!error_.empty()) return error_;
  if (shown_.number == 0) return "loading ...";
  const Stats& stats = shown_.first.stats;
  std::string words = fmt::format("{}  {}x{}  {} lights  {}{}{}  cull {:.2f}  shade {:.2f}  frame {:.2f} ms",
                                  stats.scene, stats.width, stats.height, stats.lights, only_of_first(shown_),
                                  stats.method, shown_.first.by_auto ? " (auto)" : "", stats.rendered.cull_ms,
                                  stats.rendered.shade_ms, stats.rendered.frame_ms);
  if (picture_ms_ > 0.0) words += fmt::format("  {:.1f} pictures/s", 1000.0 / picture_ms_);
  if (busy_ && !idle_) words += "  ...";
  if (!said_.empty())
    words += "  " + said_;
  else if (!proof_.empty())
    words += fmt::format("  {}: {}", proof_of_, proof_);
  return words;
}

float Viewer::status_top(glm::uvec2 screen) const {
  const float wrap = std::max(1.0F, static_cast<float>(screen.x) - static_cast<float>(area_.min.x) - 16.0F * scale_);
  const float text = ImGui::CalcTextSize(status().c_str(), nullptr, false, wrap).y;
  return static_cast<float>(screen.y) - std::max(STATUS_HEIGHT * scale_, text + 8.0F * scale_);
}

/// As many lines as it takes: over the picture, and over panels that lie there, where that is more than one.
void Viewer::draw_status(glm::uvec2 screen) const {
  const glm::vec2 end(screen);
  const glm::vec2 min(static_cast<float>(area_.min.x), status_top(screen));
  const glm::vec2 padding = scale_ * glm::vec2(8.0F, 4.0F);
  const bool alarms = lost_ || !error_.empty();
  const ImU32 ink = alarms ? ImGui::ColorConvertFloat4ToU32(ALARM) : ImGui::GetColorU32(ImGuiCol_Text);
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  draw.AddRectFilled({min.x, min.y}, {end.x, end.y}, ImGui::GetColorU32(ImGuiCol_WindowBg));
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {min.x + padding.x, min.y + padding.y}, ink, status().c_str(),
               nullptr, std::max(1.0F, end.x - min.x - 2.0F * padding.x));
}

}  // namespace lamp::app
