// The lights of the picked pixel's cell, and what other methods list there.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <utility>

#include "view/panels.h"

namespace lamp::app {
namespace {

constexpr std::size_t MOST_NAMED = 24;  // of lights in a sentence
const ImVec4 SAME{0.25F, 0.5F, 0.3F, 0.55F};

/// The answer that is held against the list; null: none is.
const OtherList* chosen(const InspectorFrame& p) {
  const auto found = std::ranges::find(p.others, p.state.other, &OtherList::method);
  return found == p.others.end() || !found->refused.empty() ? nullptr : &*found;
}

/// Whether others list a light: the one that is chosen, or how many of all.
std::string listed_by(const InspectorFrame& p, std::uint32_t light) {
  if (const OtherList* const other = chosen(p)) return other->has(light) ? "listed" : "not";
  const auto able = std::ranges::count_if(p.others, &std::string::empty, &OtherList::refused);
  return fmt::format("{} of {}", std::ranges::count_if(p.others, [&](const OtherList& o) { return o.has(light); }),
                     able);
}

std::string names_of_listing(const InspectorFrame& p, std::uint32_t light) {
  std::string listing;
  std::string others;
  for (const OtherList& other : p.others) {
    if (!other.refused.empty()) continue;
    std::string& names = other.has(light) ? listing : others;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", other.method);
  }
  return fmt::format("Listed by {}.\nNot by {}.", listing.empty() ? "none" : listing,
                     others.empty() ? "none: all list it" : others);
}

void draw_row(const ListedLight& light, InspectorFrame& p) {
  const OwnTests& tests = p.shown.inspection->tests_of(light);
  const auto cell = [](const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
  };
  ImGui::TableNextColumn();
  if (const OtherList* const other = chosen(p); other != nullptr && other->has(light.light))
    ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, ImGui::GetColorU32(SAME));
  if (p.widgets.pick(fmt::format("{}", light.light), p.state.light == light.light)) {
    p.state.light = light.light;
    p.scroll.light = light.light;  // it is where the pointer is
  }
  cell(light.spot ? "spot" : "point");
  cell(fmt::format("{:.2f}", light.distance_m));
  cell(fmt::format("{:.2f}", light.range_m));
  cell(fmt::format("{:.1f}%", 100.0 * light.share));
  if (!p.others.empty()) {
    cell(listed_by(p, light.light));
    if (ImGui::IsItemHovered()) Widgets::tip(names_of_listing(p, light.light));
  }
  cell(why_listed(light, tests));
  if (ImGui::IsItemHovered()) Widgets::tip(explained(light, tests));
}

/// Whether the picked light's row, if there is one, is to be brought into sight: it was picked elsewhere since it was,
/// or the list moved it out.
bool wants_scroll(ListScroll& scroll, const std::optional<std::uint32_t>& light, std::optional<std::size_t> row) {
  if (scroll.light != light) scroll.pending = true;
  const bool moved = scroll.row && row && scroll.row != row && scroll.in_sight;
  scroll.light = light;
  scroll.row = row;
  return row && (std::exchange(scroll.pending, false) || moved);
}

void draw_rows(InspectorFrame& p) {
  const std::vector<ListedLight>& lights = p.shown.inspection->lights;
  const auto picked = std::ranges::find(lights, p.state.light.value_or(~0U), &ListedLight::light);
  std::optional<std::size_t> row;
  if (picked != lights.end()) row = static_cast<std::size_t>(picked - lights.begin());
  const bool scrolls = wants_scroll(p.scroll, p.state.light, row);
  bool in_sight = false;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(lights.size()));
  if (scrolls) clipper.ForceDisplayRangeByIndices(static_cast<int>(*row), static_cast<int>(*row) + 1);
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      draw_row(lights[static_cast<std::size_t>(i)], p);
      if (static_cast<std::size_t>(i) != row) continue;
      in_sight = ImGui::IsItemVisible() || scrolls;
      if (scrolls) ImGui::SetScrollHereY();
    }
  }
  p.scroll.in_sight = in_sight;
}

std::string sentence_of(std::span<const std::uint32_t> lights) {
  std::string words = fmt::format("{}", fmt::join(lights.first(std::min(lights.size(), MOST_NAMED)), ", "));
  if (lights.size() > MOST_NAMED) words += fmt::format(" and {} more", lights.size() - MOST_NAMED);
  return words;
}

/// What tells an answer from the list.
std::string difference_of(const OtherList& other) {
  std::string words = other.beyond.empty() ? fmt::format("{} lists no light that is not listed here", other.method)
                                           : fmt::format("{} also lists {}", other.method, sentence_of(other.beyond));
  words +=
      other.without.empty() ? ", and all that are." : fmt::format("; it does not list {}.", sentence_of(other.without));
  return words;
}

void draw_other(const OtherList& other, InspectorFrame& p) {
  ImGui::TableNextColumn();
  if (p.widgets.pick("others: " + other.method, p.state.other == other.method, other.method))
    p.state.other = p.state.other == other.method ? std::string() : other.method;
  if (!other.refused.empty()) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(other.refused.c_str());
    if (ImGui::IsItemHovered()) Widgets::tip(other.refused);
    for (int column = 0; column < 3; ++column) ImGui::TableNextColumn();
    return;
  }
  for (const std::size_t count : {other.lights.size(), other.reaching, other.beyond.size(), other.without.size()}) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(fmt::format("{}", count).c_str());
  }
}

/// Two tables of one look.
bool begin_others(const char* name) {
  constexpr ImGuiTableFlags FLAGS = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
  if (!ImGui::BeginTable(name, 5, FLAGS)) return false;
  const float letter = ImGui::CalcTextSize("0").x;
  ImGui::TableSetupColumn("method", ImGuiTableColumnFlags_WidthFixed, 24.0F * letter);
  for (const char* title : {"lists", "reach pixel", "not listed here"})
    ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthFixed, 15.0F * letter);
  ImGui::TableSetupColumn("does not list", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

}  // namespace

/// In a part of its own that scrolls: a table that scrolls by itself ends the program (an assertion of ImGui 1.86)
/// where nothing of it is in sight.
void list_of_lights(InspectorFrame& p) {
  constexpr ImGuiTableFlags FLAGS = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
  const Inspection& found = *p.shown.inspection;
  if (p.scroll.pixel != found.pixel) p.scroll.rows = 0;
  p.scroll.pixel = found.pixel;
  p.scroll.rows = std::max(p.scroll.rows, std::clamp<std::size_t>(found.lights.size() + 2, 3, 16));
  const float height = ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(p.scroll.rows);
  const bool asked = !p.others.empty();
  if (ImGui::BeginChild("lights", {0.0F, height}) && ImGui::BeginTable("lights of the cell", asked ? 7 : 6, FLAGS)) {
    for (const char* title : {"light", "type", "dist.", "range", "share"}) ImGui::TableSetupColumn(title);
    const OtherList* const other = chosen(p);
    if (asked) ImGui::TableSetupColumn(other != nullptr ? other->method.c_str() : "others");
    ImGui::TableSetupColumn("why it is listed", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    draw_rows(p);
    ImGui::EndTable();
  }
  ImGui::EndChild();
}

void lists_of_others(InspectorFrame& p) {
  if (p.others.empty()) return;
  Widgets::steady(1, [&] { Widgets::note(p.outdated); });
  if (begin_others("titles of others")) {  // apart, so that they stay in sight
    ImGui::TableHeadersRow();
    ImGui::EndTable();
  }
  const float height = ImGui::GetTextLineHeightWithSpacing() * 8.0F;
  if (ImGui::BeginChild("others", {0.0F, height}) && begin_others("what others list")) {
    for (const OtherList& other : p.others) draw_other(other, p);
    ImGui::EndTable();
  }
  ImGui::EndChild();
  const OtherList* const other = chosen(p);
  Widgets::steady(2, [&] {
    Widgets::note(other != nullptr ? difference_of(*other)
                                   : "Click a method: the lights that it lists too are marked above.");
  });
}

}  // namespace lamp::app
