// Reads scripts, plays them.
// SPDX-License-Identifier: Apache-2.0
#include "view/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/pictures.h"
#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"

namespace lamp::app {
namespace {

constexpr int MOST_FRAMES = 3000;  // of a wait: whatever is not there then will not be
constexpr int CLICK_FRAMES = 2;    // ImGui takes a widget under the mouse for hovered one frame late
constexpr int DRAG_STEPS = 6;
constexpr std::uint32_t LARGEST_SCREEN = 8192;

using Play = void (*)(Player&, const ScriptLine&);

[[noreturn]] void fail(const ScriptLine& line, std::string_view problem, Exit exit = Exit::bad_input) {
  throw Error(fmt::format("{}: {}", line.name, problem), exit);
}

void frames(Player& player, int count) {
  for (int i = 0; i < count; ++i) player.frame();
}

std::string text_of(const ScriptLine& line) {
  if (!line.value.is_string() || line.value.get<std::string>().empty())
    fail(line, fmt::format("{} is {}, expected a text", line.what, shown(line.value)));
  return line.value.get<std::string>();
}

glm::vec2 pair_of(const ScriptLine& line, const nlohmann::json& json) {
  const bool is_pair = json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number();
  if (!is_pair) fail(line, fmt::format("{} is {}, expected two numbers", line.what, shown(json)));
  return {json[0].get<float>(), json[1].get<float>()};
}

std::pair<glm::vec2, glm::vec2> way_of(const ScriptLine& line) {
  if (!line.value.is_array() || line.value.size() != 2)
    fail(line, fmt::format("{} is {}, expected two places", line.what, shown(line.value)));
  return {pair_of(line, line.value[0]), pair_of(line, line.value[1])};
}

glm::vec2 on_screen(const Player& player, glm::vec2 place) {
  const ScreenRect& picture = player.viewer.picture();
  return glm::vec2(picture.min) + place * glm::vec2(picture.size());
}

int count_of(const ScriptLine& line, const nlohmann::json& json) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > MOST_FRAMES)
    fail(line, fmt::format("{} is {}, expected a number of frames up to {}", line.what, shown(json), MOST_FRAMES));
  return json.get<int>();
}

void press_at(Player& player, glm::vec2 at) {
  player.input.mouse = at;
  frames(player, CLICK_FRAMES);
  player.input.buttons[0] = true;
  frames(player, CLICK_FRAMES);
  player.input.buttons[0] = false;
  frames(player, CLICK_FRAMES);
}

/// The middle of a widget that is scrolled into sight.
glm::vec2 widget_at(Player& player, const ScriptLine& line, const std::string& label) {
  frames(player, 2);  // a list that has just opened finds its place in the frame after its first
  try {
    static_cast<void>(player.viewer.places().find(label));
  } catch (const Error& error) {
    fail(line, error.what());
  }
  if (!player.viewer.places().in_sight(label)) {
    player.viewer.places().scroll_to(label);
    frames(player, 3);
  }
  if (!player.viewer.places().in_sight(label))
    fail(line, fmt::format("{} cannot be scrolled into sight", label), Exit::check_failed);
  const ScreenRect rect = player.viewer.places().find(label);
  return 0.5F * glm::vec2(rect.min + rect.max);
}

void play_set(Player& player, const ScriptLine& line) { read_state(player.viewer.state(), line.value, line.name); }

/// Until all is done, and where time goes on, until something was drawn that was asked for after that.
void play_until_idle(Player& player, const ScriptLine& line) {
  frames(player, 1);
  const std::uint64_t first = player.viewer.shown().number + (player.viewer.busy() ? 1 : 0);
  const auto moved = [&] {
    return player.viewer.asks_for_nothing() && player.viewer.shown().number > first && !player.viewer.state().paused;
  };
  for (int i = 0; i < MOST_FRAMES && !player.viewer.idle() && !moved(); ++i) player.frame();
  if (!player.viewer.idle() && !moved())
    fail(line, fmt::format("not idle after {} frames", MOST_FRAMES), Exit::check_failed);
  frames(player, 1);  // so that panels show it
}

void play_wait(Player& player, const ScriptLine& line) {
  if (line.value == "idle")
    play_until_idle(player, line);
  else
    frames(player, count_of(line, line.value));
}

/// Where panels grow as pictures come, not until the widget stands still under the mouse.
void press_widget(Player& player, const ScriptLine& line, const std::string& label) {
  glm::vec2 at = widget_at(player, line, label);
  for (int i = 0; i < MOST_FRAMES; ++i) {
    player.input.mouse = at;
    frames(player, CLICK_FRAMES);
    const glm::vec2 now = widget_at(player, line, label);
    if (now == at) return press_at(player, at);
    at = now;
  }
  fail(line, fmt::format("{} does not stand still", label), Exit::check_failed);
}

void play_click(Player& player, const ScriptLine& line) {
  if (line.value.is_string()) return press_widget(player, line, text_of(line));
  press_at(player, pair_of(line, line.value));
}

void play_click_picture(Player& player, const ScriptLine& line) {
  press_at(player, on_screen(player, pair_of(line, line.value)));
}

void drag(Player& player, glm::vec2 from, glm::vec2 to) {
  player.input.mouse = from;
  frames(player, CLICK_FRAMES);
  player.input.buttons[0] = true;
  for (int i = 0; i <= DRAG_STEPS; ++i) {
    player.input.mouse = glm::mix(from, to, static_cast<float>(i) / DRAG_STEPS);
    player.frame();
  }
  player.input.buttons[0] = false;
  frames(player, CLICK_FRAMES);
}

void play_drag(Player& player, const ScriptLine& line) {
  const auto [from, to] = way_of(line);
  drag(player, from, to);
}

void play_drag_picture(Player& player, const ScriptLine& line) {
  const auto [from, to] = way_of(line);
  drag(player, on_screen(player, from), on_screen(player, to));
}

void play_scroll(Player& player, const ScriptLine& line) {
  player.input.wheel = pair_of(line, line.value);
  player.frame();
}

/// "ctrl+shift+z": all but the last are held.
std::vector<std::string> chord_of(const ScriptLine& line) {
  std::vector<std::string> keys;
  const std::string text = text_of(line);
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t plus = std::min(text.find('+', at), text.size());
    keys.push_back(text.substr(at, plus - at));
    if (!key_number(keys.back()))
      fail(line, fmt::format("'{}': there is no such key; the nearest are {}", keys.back(),
                             fmt::join(nearest_names(keys.back(), key_names()), ", ")));
    at = plus + 1;
  }
  return keys;
}

void play_key(Player& player, const ScriptLine& line) {
  const std::vector<std::string> keys = chord_of(line);
  player.input.held.insert(keys.begin(), keys.end());
  player.input.pressed.push_back(keys.back());
  frames(player, 2);
  for (const std::string& key : keys) player.input.held.erase(key);
  player.frame();
}

void play_hold(Player& player, const ScriptLine& line) {
  const std::vector<std::string> keys = chord_of(line);
  player.input.held.insert(keys.begin(), keys.end());
  frames(player, count_of(line, line.line.value("frames", nlohmann::json(1U))));
  for (const std::string& key : keys) player.input.held.erase(key);
}

void play_type(Player& player, const ScriptLine& line) {
  player.input.text = text_of(line);
  frames(player, 2);
}

void play_clipboard(Player& player, const ScriptLine& line) {
  set_clipboard(text_of(line));
  player.frame();
}

void play_drop(Player& player, const ScriptLine& line) {
  player.input.dropped.push_back(text_of(line));
  player.frame();
}

void play_resize(Player& player, const ScriptLine& line) {
  const glm::vec2 size = pair_of(line, line.value);
  if (size.x < 1.0F || size.y < 1.0F || size.x > LARGEST_SCREEN || size.y > LARGEST_SCREEN)
    fail(line, fmt::format("resize is {}, expected 1 .. {} pixels a side", shown(line.value), LARGEST_SCREEN));
  player.resize(glm::uvec2(size));
  player.frame();
}

void play_minimise(Player& player, const ScriptLine& line) {
  const glm::uvec2 size = player.size;
  player.resize(glm::uvec2(0));
  frames(player, count_of(line, line.value));
  player.resize(size);
  player.frame();
}

bool agrees(const nlohmann::json& seen, const nlohmann::json& expected) {
  if (expected.is_string() && seen.is_string()) {
    const auto text = expected.get<std::string>();
    if (text.starts_with("~")) return seen.get<std::string>().find(text.substr(1)) != std::string::npos;
  }
  if (expected.is_object() && !expected.empty()) {  // limits
    return std::ranges::all_of(expected.items(), [&](const auto& limit) {
      if (!seen.is_number() || !limit.value().is_number()) return false;
      return limit.key() == "min" ? seen >= limit.value() : seen <= limit.value();
    });
  }
  // Most of the state's decimals are kept in single precision.
  if (seen.is_number_float() && expected.is_number_float()) return seen.get<float>() == expected.get<float>();
  return seen == expected;
}

void play_expect(Player& player, const ScriptLine& line) {
  const nlohmann::json report = player.viewer.report();
  for (const auto& [key, expected] : line.value.items()) {
    const nlohmann::json::json_pointer pointer(key);
    const nlohmann::json seen = report.contains(pointer) ? report.at(pointer) : nlohmann::json();
    if (!agrees(seen, expected))
      fail(line, fmt::format("{} is {}, expected {}", key, shown(seen), expected.dump()), Exit::check_failed);
  }
}

void play_save_picture(Player& player, const ScriptLine& line) {
  const std::uint64_t errors = player.viewer.errors();
  player.viewer.save_picture(text_of(line));
  play_until_idle(player, line);
  if (player.viewer.errors() != errors) fail(line, player.viewer.error());
}

void play_save_state(Player& player, const ScriptLine& line) {
  const std::uint64_t errors = player.viewer.errors();
  player.viewer.save_state(text_of(line));
  if (player.viewer.errors() != errors) fail(line, player.viewer.error());
}

void play_save_screen(Player& player, const ScriptLine& line) {
  constexpr std::string_view KINDS[] = {".png"};
  check_output("save_screen", text_of(line), KINDS);
  frames(player, 2);  // tables find their columns' widths in the frame after their first
  const LdrImage screen = player.screen();
  write_output(text_of(line), [&](const std::filesystem::path& file) { write_png(file, screen); });
}

constexpr std::array<std::pair<std::string_view, Play>, 18> LINES{{{"set", play_set},
                                                                   {"wait", play_wait},
                                                                   {"click", play_click},
                                                                   {"click_picture", play_click_picture},
                                                                   {"drag", play_drag},
                                                                   {"drag_picture", play_drag_picture},
                                                                   {"scroll", play_scroll},
                                                                   {"key", play_key},
                                                                   {"hold", play_hold},
                                                                   {"type", play_type},
                                                                   {"clipboard", play_clipboard},
                                                                   {"drop", play_drop},
                                                                   {"resize", play_resize},
                                                                   {"minimise", play_minimise},
                                                                   {"expect", play_expect},
                                                                   {"save_picture", play_save_picture},
                                                                   {"save_state", play_save_state},
                                                                   {"save_screen", play_save_screen}}};

/// Limits are an object of min and max, places in the report JSON pointers.
void check_expected(const ScriptLine& line) {
  for (const auto& [key, expected] : line.value.items()) {
    try {
      static_cast<void>(nlohmann::json::json_pointer(key));
    } catch (const nlohmann::json::exception&) {
      fail(line, fmt::format("expect: '{}' is no place in the report, expected one such as /shown/lights", key));
    }
    if (!expected.is_object()) continue;
    for (const auto& [limit, value] : expected.items())
      if ((limit != "min" && limit != "max") || !value.is_number())
        fail(line, fmt::format("expect: {} is {}, expected a value or numbers as min and max", key, expected.dump()));
  }
}

/// What can be known of a line before it is played.
void check_line(const ScriptLine& line) {
  if (line.what == "set" || line.what == "expect") {
    if (!line.value.is_object()) fail(line, fmt::format("{} is {}, expected an object", line.what, shown(line.value)));
  }
  if (line.what == "expect") check_expected(line);
  if (line.what != "hold" && line.line.contains("frames"))
    fail(line, fmt::format("frames: belongs to hold, not to {}", line.what));
  if (line.what == "key" || line.what == "hold") static_cast<void>(chord_of(line));
  if (line.what == "wait" && line.value != "idle") static_cast<void>(count_of(line, line.value));
  if (line.what == "drag" || line.what == "drag_picture") static_cast<void>(way_of(line));
}

ScriptLine parse_line(std::string_view text, const std::string& name) {
  ScriptLine line{.name = name, .what = {}, .value = {}, .line = parse_json(text, name)};
  std::vector<std::string_view> names;
  for (const auto& [what, play] : LINES) names.push_back(what);
  if (!line.line.is_object() || line.line.empty())
    fail(line, fmt::format("is {}, expected an object with one of {}", shown(line.line), fmt::join(names, ", ")));
  for (const auto& [key, value] : line.line.items()) {
    if (key == "frames") continue;
    if (std::ranges::find(names, key) == names.end())
      fail(line, fmt::format("'{}': there is no such thing to do; the nearest are {}", key,
                             fmt::join(nearest_names(key, names), ", ")));
    if (!line.what.empty()) fail(line, fmt::format("has {} and {}, expected one thing a line", line.what, key));
    line.what = key;
    line.value = value;
  }
  if (line.what.empty()) fail(line, fmt::format("has frames alone, expected one of {}", fmt::join(names, ", ")));
  check_line(line);
  return line;
}

}  // namespace

std::vector<ScriptLine> parse_script(std::string_view text, const std::string& name) {
  std::vector<ScriptLine> script;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    ++number;
    at = end + 1;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    script.push_back(parse_line(line, fmt::format("{}: line {}", name, number)));
  }
  return script;
}

std::vector<ScriptLine> read_script(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes =
      read_file(file, {.expected = "a script, JSON in each line", .most_bytes = std::uint64_t{1} << 24});
  return parse_script(text_of(bytes), file.string());
}

void play(Player& player, const std::vector<ScriptLine>& script) {
  for (const ScriptLine& line : script)
    std::ranges::find(LINES, std::string_view(line.what), [](const auto& row) {
      return row.first;
    })->second(player, line);
}

}  // namespace lamp::app
