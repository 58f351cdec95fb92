// ImGui's widgets with what all of ours have: a place that scripts find by its label, a tooltip in a whole sentence,
// and a reason where they cannot be used.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "view/gui.h"

namespace lamp::app {

/// Where widgets were in the last frame.
class Places {
 public:
  void next_frame();
  void add(const std::string& label, const ScreenRect& rect, bool visible);
  /// Throws Error with the nearest labels.
  [[nodiscard]] ScreenRect find(const std::string& label) const;
  /// Whether it is in sight, and not scrolled out of it.
  [[nodiscard]] bool in_sight(const std::string& label) const;
  /// From the next frame on, the panel is scrolled to it, once.
  void scroll_to(const std::string& label) { wanted_ = label; }
  [[nodiscard]] bool takes_scroll(const std::string& label);
  /// What is being typed into a field; nothing before it is.
  std::map<std::string, std::string, std::less<>>& typed() { return typed_; }

 private:
  struct Place {
    ScreenRect rect;
    bool visible = false;
  };
  std::map<std::string, Place, std::less<>> places_, drawn_;
  std::map<std::string, std::string, std::less<>> typed_;
  std::string wanted_;
};

class Widgets {
 public:
  explicit Widgets(Places& places) : places_(places) {}

  /// A section that opens and closes. Widgets of two sections may have one label.
  [[nodiscard]] bool header(const std::string& label, bool open);
  /// True when it was clicked. A `reason` greys it.
  bool button(const std::string& label, const std::string& tip, const std::string& reason = "");
  bool check(const std::string& label, bool& value, const std::string& tip, const std::string& reason = "");
  /// Sets `value` to one of the names. `reason_of`: why a name cannot be chosen, or empty.
  bool choose(const std::string& label, std::string& value, std::span<const std::string_view> names,
              const std::string& tip, const std::function<std::string(std::string_view)>& reason_of = {});
  /// The same for an enumeration whose values are the names' places.
  template <class Word>
  bool choose_word(const std::string& label, Word& value, std::span<const std::string_view> names,
                   const std::string& tip, const std::function<std::string(std::string_view)>& reason_of = {}) {
    std::string name(names[static_cast<std::size_t>(value)]);
    if (!choose(label, name, names, tip, reason_of)) return false;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) value = static_cast<Word>(i);
    return true;
  }
  struct Limits {
    double min = 0.0;
    double max = 1.0;
    bool logarithmic = false;
    const char* format = "%.2f";
  };
  bool slide(const std::string& label, float& value, const Limits& limits, const std::string& tip,
             const std::string& reason = "");
  bool slide(const std::string& label, std::uint32_t& value, const Limits& limits, const std::string& tip,
             const std::string& reason = "");
  /// Three numbers that are dragged, `step` a pixel.
  bool move(const std::string& label, Vec3& value, float step, const std::string& tip);
  bool color(const std::string& label, Vec3& value, const std::string& tip);
  /// A row of a table, by its first cell. True when it was clicked. `words`: in place of the label, by which scripts
  /// find it.
  bool pick(const std::string& label, bool picked, const std::string& words = "");
  /// A part of a panel that is closed at first. True while it is open.
  [[nodiscard]] bool fold(const std::string& label);
  /// Takes the text when the widget is left, and is true then: what is half typed may be nothing that can be.
  bool write(const std::string& label, std::string& value, const std::string& tip, const char* empty = "");

  /// Text beside the window of the widget that was drawn last, wrapped: what the pointer is at can be read on.
  static void tip(const std::string& words);
  /// Text that can be selected, so many lines of it in sight.
  static void excerpt(const char* name, std::string words, int lines);
  /// What comes next stands beside the last widget.
  static void beside();
  /// What `draw` draws takes the height of so many lines of text at least.
  template <class Draw>
  static void steady(int lines, const Draw& draw) {
    const float top = cursor_y();
    draw();
    fill_to(top, lines);
  }
  /// Text in the panel, wrapped. A title is bright, a note is quiet.
  static void text(std::string_view words);
  static void note(std::string_view words);
  static void row(std::string_view name, std::string_view value);

 private:
  /// Of the widget that was drawn last.
  void done(const std::string& label, const std::string& tip, const std::string& reason = "");
  void before(const std::string& label);
  /// With what tells it from one of that label in another section: ImGui takes widgets of one name for one.
  [[nodiscard]] std::string unique(const std::string& label) const { return label + "##" + section_; }
  [[nodiscard]] static float cursor_y();
  static void fill_to(float top, int lines);

  Places& places_;
  std::string section_;
};

}  // namespace lamp::app
