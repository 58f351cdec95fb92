// All keys, over the picture.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>

#include "view/keys.h"
#include "view/panels.h"

namespace lamp::app {

void help_window(const ScreenRect& picture, float scale) {
  const float of_keys = 150.0F * scale;
  float of_words = 0.0F;
  for (const KeyHelp& key : key_help())
    of_words = std::max(of_words, ImGui::CalcTextSize(key.does.data(), key.does.data() + key.does.size()).x);
  const glm::vec2 room = glm::max(glm::vec2(picture.size()), 1.0F);
  const float bar = ImGui::GetStyle().ScrollbarSize + 2.0F * ImGui::GetStyle().WindowPadding.x;
  const float width = std::min(of_keys + of_words + bar, room.x);
  const glm::vec2 middle = 0.5F * glm::vec2(picture.min + picture.max);
  ImGui::SetNextWindowPos({middle.x, middle.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, room.y});
  ImGui::SetNextWindowSize({width, 0.0F});  // as high as it needs
  ImGui::SetNextWindowBgAlpha(0.92F);
  constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("help", nullptr, FIXED)) {
    for (const KeyHelp& key : key_help()) {
      ImGui::TextUnformatted(key.keys.data(), key.keys.data() + key.keys.size());
      ImGui::SameLine(std::min(of_keys, 0.4F * width));
      Widgets::text(key.does);
    }
  }
  ImGui::End();
}

}  // namespace lamp::app
