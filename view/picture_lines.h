// Points and lines of the world over the picture, as far as they lie ahead of its near plane.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>
#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "lamplight/view.h"
#include "view/gui.h"

namespace lamp::app {

/// Where in the picture a point of the world is seen, 0 .. 1 from its top left; nothing before the near plane.
[[nodiscard]] std::optional<glm::vec2> place_in_picture(const View& view, const glm::vec3& position);
/// The same of the part of a line that lies behind the near plane.
[[nodiscard]] std::optional<std::pair<glm::vec2, glm::vec2>> line_in_picture(const View& view, const glm::vec3& from,
                                                                             const glm::vec3& to);

struct Circle {
  glm::vec3 center{0.0F};
  glm::vec3 u{0.0F};  ///< to its edge, and at a right angle
  glm::vec3 v{0.0F};
};
/// The outline of a sphere as the eye sees it; nothing where the eye is within.
[[nodiscard]] std::optional<Circle> outline_of_sphere(const View& view, const glm::vec3& center, float radius);

struct Ink {
  ImU32 color = IM_COL32_WHITE;
  float width = 1.0F;
};

/// What is drawn over the picture is cut at its edges while this lives.
class PictureLines {
 public:
  PictureLines(const View& view, const ScreenRect& picture);
  ~PictureLines() { draw_.PopClipRect(); }
  PictureLines(const PictureLines&) = delete;
  PictureLines& operator=(const PictureLines&) = delete;

  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] ImDrawList& draw() const { return draw_; }
  [[nodiscard]] std::optional<ImVec2> at(const glm::vec3& position) const;
  void line(const glm::vec3& from, const glm::vec3& to, const Ink& ink) const;
  void ring(const Circle& circle, const Ink& ink) const;
  /// `axes`: from the centre to the middle of three faces.
  void box(const glm::vec3& center, const glm::mat3& axes, const Ink& ink) const;

 private:
  [[nodiscard]] ImVec2 on_screen(const glm::vec2& place) const;

  const View& view_;
  const ScreenRect& picture_;
  ImDrawList& draw_;
};

}  // namespace lamp::app
