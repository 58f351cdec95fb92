// All keys, over the picture.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>
#include <glm/glm.hpp>

#include "view/keys.h"
#include "view/panels.h"

namespace lamp::app {

void help_window(const ScreenRect& picture, float scale) {
  const glm::vec2 middle = 0.5F * glm::vec2(picture.min + picture.max);
  ImGui::SetNextWindowPos({middle.x, middle.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowBgAlpha(0.92F);
  constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;
  if (ImGui::Begin("help", nullptr, FIXED)) {
    for (const KeyHelp& key : key_help()) {
      ImGui::TextUnformatted(key.keys.data(), key.keys.data() + key.keys.size());
      ImGui::SameLine(150.0F * scale);
      ImGui::TextUnformatted(key.does.data(), key.does.data() + key.does.size());
    }
  }
  ImGui::End();
}

}  // namespace lamp::app
