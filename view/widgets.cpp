// Draws widgets, notes their places.
// SPDX-License-Identifier: Apache-2.0
#include "view/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <glm/glm.hpp>

#include <algorithm>

#include "error.h"
#include "lamplight/method.h"

namespace lamp::app {
namespace {

const ImVec4 QUIET{0.62F, 0.62F, 0.66F, 1.0F};
constexpr float LABEL_PART = 0.42F;  // of a panel's width, right of the widgets

ImGuiSliderFlags flags_of(const Widgets::Limits& limits) {
  return ImGuiSliderFlags_AlwaysClamp | (limits.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

/// Greys what is drawn while it lives.
class Greyed {
 public:
  explicit Greyed(bool greyed) { ImGui::BeginDisabled(greyed); }
  ~Greyed() { ImGui::EndDisabled(); }
  Greyed(const Greyed&) = delete;
  Greyed& operator=(const Greyed&) = delete;
};

/// Where a tooltip of that size leaves what is pointed at in sight: left or right of its window, or, where there is no
/// room, a row below it, or above.
ImVec2 beside_window(const ImVec2& size) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float gap = ImGui::GetStyle().WindowPadding.x;
  const float left = ImGui::GetWindowPos().x - gap - size.x;
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + gap;
  const float top = std::clamp(ImGui::GetItemRectMin().y, 0.0F, std::max(0.0F, screen.y - size.y));
  if (right + size.x <= screen.x) return {right, top};
  if (left >= 0.0F) return {left, top};
  const float row = ImGui::GetTextLineHeightWithSpacing();
  const float below = ImGui::GetItemRectMax().y + row;
  const float above = ImGui::GetItemRectMin().y - row - size.y;
  const float x = std::max(0.0F, std::min(ImGui::GetItemRectMin().x, screen.x - size.x));
  return {x, below + size.y <= screen.y || above < 0.0F ? below : above};
}

void tooltip(const std::string& tip, const std::string& reason) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || (tip.empty() && reason.empty())) return;
  Widgets::tip(reason.empty() ? tip : tip + "\nIt cannot be used now: " + reason);
}

}  // namespace

void Places::next_frame() {
  places_ = std::move(drawn_);
  drawn_.clear();
}

void Places::add(const std::string& label, const ScreenRect& rect, bool visible) { drawn_[label] = {rect, visible}; }

ScreenRect Places::find(const std::string& label) const {
  const auto found = places_.find(label);
  if (found != places_.end()) return found->second.rect;
  std::vector<std::string_view> names;
  for (const auto& [name, place] : places_) names.push_back(name);
  throw Error(fmt::format("'{}': there is none of that name on the screen; the nearest are {}", label,
                          fmt::join(nearest_names(label, names), ", ")));
}

bool Places::in_sight(const std::string& label) const {
  const auto found = places_.find(label);
  return found != places_.end() && found->second.visible;
}

bool Places::takes_scroll(const std::string& label) {
  if (wanted_ != label) return false;
  wanted_.clear();
  return true;
}

void Widgets::before(const std::string& label) {
  if (places_.takes_scroll(label)) ImGui::SetScrollHereY();
}

void Widgets::done(const std::string& label, const std::string& tip, const std::string& reason) {
  const ImVec2 min = ImGui::GetItemRectMin();
  const ImVec2 max = ImGui::GetItemRectMax();
  // Its middle row, where a script clicks; at its left, since what spans a table is clipped to the first column here.
  const float half = 0.5F * (max.y - min.y);
  const ImVec2 left{min.x + half, min.y + half};
  const bool in_sight = ImGui::IsRectVisible(left, {left.x + 1.0F, left.y + 1.0F});
  places_.add(label, {.min = {min.x, min.y}, .max = {max.x, max.y}}, in_sight);
  tooltip(tip, reason);
}

bool Widgets::header(const std::string& label, bool open) {
  before(label);
  section_ = label;
  const bool is_open = ImGui::CollapsingHeader(label.c_str(), open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  done(label, "");
  return is_open;
}

bool Widgets::button(const std::string& label, const std::string& tip, const std::string& reason) {
  before(label);
  const Greyed greyed(!reason.empty());
  const bool clicked = ImGui::Button(unique(label).c_str());
  done(label, tip, reason);
  return clicked;
}

bool Widgets::check(const std::string& label, bool& value, const std::string& tip, const std::string& reason) {
  before(label);
  const Greyed greyed(!reason.empty());
  const bool changed = ImGui::Checkbox(unique(label).c_str(), &value);
  done(label, tip, reason);
  return changed;
}

bool Widgets::choose(const std::string& label, std::string& value, std::span<const std::string_view> names,
                     const std::string& tip, const std::function<std::string(std::string_view)>& reason_of) {
  before(label);
  ImGui::SetNextItemWidth(-LABEL_PART * ImGui::GetWindowWidth());
  const bool open = ImGui::BeginCombo(unique(label).c_str(), value.c_str(), ImGuiComboFlags_HeightLargest);
  done(label, tip);
  if (!open) return false;
  bool changed = false;
  for (const std::string_view name : names) {
    const std::string reason = reason_of ? reason_of(name) : "";
    const Greyed greyed(!reason.empty());
    if (ImGui::Selectable(std::string(name).c_str(), name == value)) {
      value = name;
      changed = true;
    }
    done(fmt::format("{}: {}", label, name), "", reason);
  }
  ImGui::EndCombo();
  return changed;
}

bool Widgets::slide(const std::string& label, float& value, const Limits& limits, const std::string& tip,
                    const std::string& reason) {
  before(label);
  const Greyed greyed(!reason.empty());
  ImGui::SetNextItemWidth(-LABEL_PART * ImGui::GetWindowWidth());
  const bool changed = ImGui::SliderFloat(unique(label).c_str(), &value, static_cast<float>(limits.min),
                                          static_cast<float>(limits.max), limits.format, flags_of(limits));
  done(label, tip, reason);
  return changed;
}

bool Widgets::slide(const std::string& label, std::uint32_t& value, const Limits& limits, const std::string& tip,
                    const std::string& reason) {
  before(label);
  const Greyed greyed(!reason.empty());
  ImGui::SetNextItemWidth(-LABEL_PART * ImGui::GetWindowWidth());
  const auto min = static_cast<std::uint32_t>(limits.min);
  const auto max = static_cast<std::uint32_t>(limits.max);
  const bool changed =
      ImGui::SliderScalar(unique(label).c_str(), ImGuiDataType_U32, &value, &min, &max, "%u", flags_of(limits));
  done(label, tip, reason);
  return changed;
}

bool Widgets::move(const std::string& label, Vec3& value, float step, const std::string& tip) {
  before(label);
  ImGui::SetNextItemWidth(-LABEL_PART * ImGui::GetWindowWidth());
  const bool changed = ImGui::DragFloat3(unique(label).c_str(), &value.x, step);
  done(label, tip);
  return changed;
}

bool Widgets::color(const std::string& label, Vec3& value, const std::string& tip) {
  before(label);
  ImGui::SetNextItemWidth(-LABEL_PART * ImGui::GetWindowWidth());
  const bool changed = ImGui::ColorEdit3(unique(label).c_str(), &value.x, ImGuiColorEditFlags_Float);
  done(label, tip);
  return changed;
}

bool Widgets::pick(const std::string& label, bool picked, const std::string& words) {
  before(label);
  const std::string shown = words.empty() ? label : words + "##" + label;
  const bool clicked = ImGui::Selectable(shown.c_str(), picked, ImGuiSelectableFlags_SpanAllColumns);
  done(label, "");
  return clicked;
}

bool Widgets::fold(const std::string& label) {
  before(label);
  const bool open = ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen);
  done(label, "");
  return open;
}

bool Widgets::write(const std::string& label, std::string& value, const std::string& tip, const char* empty) {
  before(label);
  ImGui::SetNextItemWidth(-LABEL_PART * ImGui::GetWindowWidth());
  const std::string name = unique(label);
  const auto typed = places_.typed().find(name);
  std::string text = typed == places_.typed().end() ? value : typed->second;
  ImGui::InputTextWithHint(name.c_str(), empty, &text);
  const bool left = ImGui::IsItemDeactivatedAfterEdit();
  if (ImGui::IsItemActive())
    places_.typed()[name] = text;
  else
    places_.typed().erase(name);
  if (left) value = text;
  done(label, tip);
  return left;
}

void Widgets::tip(const std::string& words) {
  const float wrap = ImGui::GetFontSize() * 26.0F;
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const ImVec2 text = ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
  const ImVec2 at = beside_window({text.x + 2.0F * padding.x, text.y + 2.0F * padding.y});
  ImGui::SetNextWindowPos(at);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap + padding.x);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void Widgets::excerpt(const char* name, std::string words, int lines) {
  const ImVec2 size(-1.0F, ImGui::GetTextLineHeight() * (static_cast<float>(lines) + 0.5F));
  ImGui::InputTextMultiline(fmt::format("##{}", name).c_str(), &words, size, ImGuiInputTextFlags_ReadOnly);
}

void Widgets::beside() { ImGui::SameLine(); }

float Widgets::cursor_y() { return ImGui::GetCursorPosY(); }

void Widgets::fill_to(float top, int lines) {
  const float spacing = ImGui::GetStyle().ItemSpacing.y;
  const float missing = top + static_cast<float>(lines) * ImGui::GetTextLineHeight() + spacing - ImGui::GetCursorPosY();
  if (missing > spacing) ImGui::Dummy({0.0F, missing - spacing});
}

void Widgets::text(std::string_view words) {
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
  ImGui::PopTextWrapPos();
}

void Widgets::note(std::string_view words) {
  ImGui::PushStyleColor(ImGuiCol_Text, QUIET);
  text(words);
  ImGui::PopStyleColor();
}

void Widgets::row(std::string_view name, std::string_view value) {
  note(name);
  ImGui::SameLine(LABEL_PART * ImGui::GetWindowWidth());
  text(value);
}

}  // namespace lamp::app
