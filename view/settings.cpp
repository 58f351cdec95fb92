// As a part of a state's JSON, and the screen.
// SPDX-License-Identifier: Apache-2.0
#include "view/settings.h"

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "commands/pictures.h"
#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"
#include "image/image.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 5> KEPT{"palette", "light_marks", "panels", "speed", "resolution"};
constexpr const char* SCREEN = "screen";
constexpr std::uint32_t LARGEST_WINDOW = 16384;

}  // namespace

std::filesystem::path settings_file() {
  const auto folder = [](const char* variable) {
    const char* text = std::getenv(variable);
    return text == nullptr ? std::filesystem::path() : std::filesystem::path(text);
  };
  std::filesystem::path base = folder("XDG_CONFIG_HOME");
  if (base.empty() && !folder("HOME").empty()) base = folder("HOME") / ".config";
  return base.empty() ? base : base / "lamplight" / "lamp-view.json";
}

glm::uvec2 unscaled(glm::uvec2 pixels, float scale) {
  if (!(scale > 0.0F)) return pixels;
  return glm::max(glm::uvec2(glm::vec2(pixels) / scale + 0.5F), glm::uvec2(glm::greaterThan(pixels, glm::uvec2(0))));
}

Settings settings_of(const ViewState& state, glm::uvec2 screen) {
  return {.palette = state.palette,
          .light_marks = state.light_marks,
          .panels = state.panels,
          .speed = state.speed,
          .resolution = state.resolution,
          .screen = screen};
}

void apply(const Settings& settings, ViewState& state) {
  state.palette = settings.palette;
  state.light_marks = settings.light_marks;
  state.panels = settings.panels;
  state.speed = settings.speed;
  state.resolution = settings.resolution;
}

Settings load_settings(const std::filesystem::path& file) {
  if (file.empty() || !std::filesystem::exists(file)) return {};
  const std::string name = file.string();
  nlohmann::json json = parse_json(
      text_of(read_file(file, {.expected = "settings of lamp-view", .most_bytes = std::uint64_t{1} << 20})), name);
  const JsonObject object{.json = json, .file = name, .element = ""};
  std::vector<std::string_view> keys(KEPT.begin(), KEPT.end());
  keys.emplace_back(SCREEN);
  object.check_keys(keys);
  Settings settings;
  if (object.has(SCREEN)) {
    const std::vector<double> size = object.numbers(SCREEN, 2);
    if (size[0] < 1.0 || size[1] < 1.0 || size[0] > LARGEST_WINDOW || size[1] > LARGEST_WINDOW)
      object.fail("screen must be two numbers of pixels, 1 and more");
    settings.screen = {size[0], size[1]};
    json.erase(SCREEN);
  }
  ViewState state;
  read_state(state, json, name);
  return settings_of(state, settings.screen);
}

void save_settings(const std::filesystem::path& file, const Settings& settings) {
  if (file.empty()) return;
  ViewState state;
  apply(settings, state);
  const nlohmann::json all = to_json(state);
  nlohmann::json kept{{SCREEN, {settings.screen.x, settings.screen.y}}};
  for (const std::string_view key : KEPT) kept[std::string(key)] = all.at(std::string(key));
  write_output(file, [&](const std::filesystem::path& path) { write_text(path, json_text(kept, 2) + "\n"); });
}

}  // namespace lamp::app
