// Times, memory, saving.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/panels.h"

namespace lamp::app {
namespace {

void draw_graph(const Times::Row& row, float top) {
  ImGui::PlotLines(("##" + row.name).c_str(), row.ms.data(), static_cast<int>(row.ms.size()), 0, nullptr, 0.0F, top,
                   {ImGui::GetWindowWidth() * 0.22F, ImGui::GetFontSize() * 1.4F});
}

/// As much of its end as there is room for: passes of one kind differ there.
std::string end_of(const std::string& text, float room) {
  std::string end = text;
  for (std::size_t cut = 1; cut < text.size() && ImGui::CalcTextSize(end.c_str()).x > room; ++cut)
    end = ".." + text.substr(cut);
  return end;
}

void draw_times(const Times& times) {
  constexpr ImGuiTableFlags FLAGS = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoKeepColumnsVisible;
  std::vector<const Times::Row*> rows;
  for (const Times::Row& row : times.rows()) rows.push_back(&row);
  if (!times.interface_row().ms.empty()) rows.push_back(&times.interface_row());
  const float right = ImGui::GetWindowContentRegionMax().x;
  if (rows.empty() || !ImGui::BeginTable("times", 3, FLAGS)) return;
  for (const Times::Row* const each : rows) {
    const Times::Row& row = *each;
    const double p95 = row.at(0.95);
    ImGui::TableNextColumn();
    draw_graph(row, static_cast<float>(std::max(1.3 * p95, 1e-3)));
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(fmt::format("{:.2f} ({:.2f} .. {:.2f})", row.at(0.5), row.at(0.05), p95).c_str());
    ImGui::TableNextColumn();
    const std::string end = end_of(row.name, right - ImGui::GetCursorPosX());
    ImGui::TextUnformatted(end.c_str());
    if (ImGui::IsItemHovered()) Widgets::tip(row.name);
  }
  ImGui::EndTable();
}

/// A bar for each range of lengths, as wide as it has cells.
void draw_lengths(std::span<const ListLengths> lengths) {
  std::uint64_t most = 1;
  for (const ListLengths& bin : lengths) most = std::max(most, bin.cells);
  const float width = ImGui::GetWindowWidth() * 0.4F;
  for (const ListLengths& bin : lengths) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFontSize();
    const float part = static_cast<float>(bin.cells) / static_cast<float>(most);
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + std::max(1.0F, part * width), at.y + height},
                                              ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    ImGui::Dummy({width, height});
    ImGui::SameLine();
    const std::string lights =
        bin.low == bin.high ? fmt::format("{}", bin.low) : fmt::format("{} to {}", bin.low, bin.high);
    ImGui::TextUnformatted(fmt::format("{} lights: {} cells", lights, bin.cells).c_str());
  }
}

/// Numbered pictures of frames of the flight.
void save_flight(PanelFrame& p) {
  p.widgets.write("frames", p.files.frames, "Of the flight, A..B: each becomes a numbered picture.");
  const bool saving = p.waiting != 0;
  if (p.widgets.button("save flight", "Writes the pictures that lamp render --frames makes of this state.",
                       saving                       ? "pictures are being saved"
                       : p.shown.flight_frames == 0 ? "the scene has no flight"
                                                    : ""))
    p.wishes.save_flight = true;
  ImGui::SameLine();
  if (p.widgets.button("stop", "Saves no more of them.", saving ? "" : "nothing is being saved"))
    p.wishes.stop_saving = true;
  Widgets::beside();
  Widgets::note(saving ? fmt::format("{} pictures to go", p.waiting) : "");
}

}  // namespace

void times_panel(PanelFrame& p) {
  if (!p.widgets.header("Times and memory", true)) return;
  const Stats& stats = p.shown.first.stats;
  Widgets::note(fmt::format("{}Median of the last pictures (5th .. 95th percentile), milliseconds on the device.",
                            only_of_first(p.shown)));
  draw_times(p.times);
  Widgets::row("GPU's clock", words_of(stats.clock.value_or(Clock())));
  Widgets::row("cells", fmt::format("{}", stats.cells));
  Widgets::row("lists", stats.findings ? fmt::format("{:.1f} lights on average, {} at most",
                                                     stats.findings->list_mean(), stats.findings->list_max)
                                       : "not counted: pick a pixel, or an overlay");
  p.widgets.check("list lengths", p.state.list_lengths, "Counts with every picture how long the cells' lists are.");
  if (p.state.list_lengths && !p.shown.first.lengths.empty()) draw_lengths(p.shown.first.lengths);
  Widgets::row("overflowed", cell_words(overflowed_cells(stats)));
  const std::string reason = overflowed_cells(stats) == 0 ? "every list fits"
                             : p.shown.first.full         ? "lists are as long as options and device allow"
                             : p.state.request.grow       ? "they are being enlarged"
                                                          : "";
  if (p.widgets.button("make room for them", "Enlarges lists until every light fits.", reason))
    p.state.request.grow = true;
  for (const auto& [name, bytes] : stats.bytes)
    Widgets::row(name, fmt::format("{:.3f} MB", static_cast<double>(bytes) * 1e-6));
}

void save_panel(PanelFrame& p) {
  if (!p.widgets.header("Save", true)) return;
  p.widgets.write("picture file", p.files.picture, "A name that ends in .png or .exr.");
  if (p.widgets.button("save picture",
                       "Writes the picture that lamp render makes of this state, in full size: by one method, A."))
    p.wishes.save_picture = true;
  p.widgets.slide("samples", p.state.samples, {.min = 1, .max = 64, .logarithmic = true},
                  "Samples of a pixel in pictures that are saved.");
  save_flight(p);
  p.widgets.write("state file", p.files.state, "A name that ends in .json.");
  if (p.widgets.button("save state", "Writes all that is set here. lamp-view --state and lamp render --state read it."))
    p.wishes.save_state = true;
  p.widgets.write("numbers file", p.files.numbers, "A name that ends in .json.");
  if (p.widgets.button("save numbers",
                       "Writes what lamp render --json prints of this picture, by A alone: times, bytes, lists."))
    p.wishes.save_numbers = true;
  p.widgets.write("capture folder", p.files.capture, "A new folder, an empty one, or a capture to replace.");
  if (p.widgets.button("save capture", "Writes the frame as lamp capture does: a scene for every command."))
    p.wishes.save_capture = true;
  if (p.widgets.button("undo", "Takes the last change back.")) p.wishes.undo = true;
  ImGui::SameLine();
  if (p.widgets.button("redo", "Makes it again.")) p.wishes.redo = true;
}

}  // namespace lamp::app
