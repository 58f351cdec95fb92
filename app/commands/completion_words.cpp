// Finds the words that go on with a line: commands, options, and the values of those whose values are names.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>
#include <span>

#include "bench/suite.h"
#include "commands/command_line.h"
#include "commands/completion.h"
#include "commands/pictures.h"
#include "commands/request.h"
#include "commands/view_state.h"
#include "lamplight/method.h"
#include "scene/builtin.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

using Words = std::vector<std::string>;

Words copied(std::span<const std::string_view> names) { return {names.begin(), names.end()}; }

Words method_words() {
  Words words{"auto"};
  for (const Method& method : methods()) words.emplace_back(method.name);
  return words;
}

Words scene_words() {
  Words words;
  for (const BuiltinScene& scene : builtin_scenes()) words.emplace_back(scene.name);
  return words;
}

/// "tile=" for each option of the method; with a key already there, "tile=8" and so on.
Words setting_words(const std::string& method, std::string_view begun) {
  const auto found = find_method(method);
  if (!found.ok()) return {};
  Words words;
  for (const OptionSpec& spec : found.value()->options) {
    const std::string key = std::string(spec.key) + "=";
    if (!begun.starts_with(key)) words.push_back(key);
    if (begun.starts_with(key))
      for (const std::string_view choice : spec.choices) words.push_back(key + std::string(choice));
  }
  return words;
}

/// "tiled:tile=8,bounds=", the word of `lamp compare`.
Words method_word_words(const std::string& begun) {
  const std::size_t colon = begun.find(':');
  if (colon == std::string::npos) return method_words();
  const std::size_t last = begun.find_last_of(":,") + 1;
  Words words = setting_words(begun.substr(0, colon), std::string_view(begun).substr(last));
  for (std::string& word : words) word.insert(0, begun, 0, last);
  return words;
}

/// A line's words behind the program's name; the last is the one that is being typed.
Words split(std::string_view line) {
  Words words;
  bool inside = false;
  for (const char letter : line) {
    const bool blank = letter == ' ' || letter == '\t';
    if (!blank && !inside) words.emplace_back();
    if (!blank) words.back() += letter;
    inside = !blank;
  }
  if (!inside) words.emplace_back();
  if (!words.empty()) words.erase(words.begin());
  return words;
}

/// "--method=tiled" as two words.
Words values_apart(const Words& words) {
  Words apart;
  for (const std::string& word : words) {
    const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    apart.push_back(word.substr(0, equals));
    if (equals != std::string::npos) apart.push_back(word.substr(equals + 1));
  }
  return apart;
}

const CLI::Option* option_of(const CLI::App& command, const std::string& word) {
  return word.starts_with("-") ? command.get_option_no_throw(word) : nullptr;
}

/// The command's words, and where in them the one that is being typed stands.
struct Typed {
  const CLI::App& command;
  std::span<const std::string> before;
  std::string last;

  [[nodiscard]] bool has(std::string_view word) const { return std::ranges::find(before, word) != before.end(); }
  /// What an option was given; empty: nothing.
  [[nodiscard]] std::string value_of(std::string_view option) const {
    const auto found = std::ranges::find(before, option);
    return found == before.end() || found + 1 == before.end() ? std::string() : *(found + 1);
  }
};

/// The option that the last word is a value of, if it is one; and how many words before belong to no option.
struct Place {
  const CLI::Option* option = nullptr;
  std::size_t arguments = 0;
};

Place place_of(const Typed& typed) {
  Place place;
  int values = 0;  // that are still to come of the option
  for (const std::string& word : typed.before) {
    if (values != 0) {
      --values;
      continue;
    }
    place.option = option_of(typed.command, word);
    values = place.option == nullptr ? 0 : place.option->get_items_expected_min();
    if (place.option == nullptr && !word.starts_with("-")) ++place.arguments;
  }
  if (values == 0) place.option = nullptr;
  return place;
}

/// The values of an option or argument, by its name; none: they are no names.
Words values_of(const Typed& typed, const std::string& name) {
  const std::string command = typed.command.get_name();
  if (name == "--scene" || name == "scene") {
    Words words = scene_words();
    if (command != "bench") return words;
    for (const std::string& suite : suite_names()) words.push_back(suite);
    return words;
  }
  if (typed.has("--panels") && (name == "a" || name == "b")) return name == "a" ? scene_words() : Words{};
  if (name == "a" || name == "b") return method_word_words(typed.last);
  if (name == "--method") return method_words();
  if (name == "name" && (typed.has("methods") || typed.has("pipelines"))) return method_words();
  if (name == "--option") return setting_words(typed.value_of("--method"), typed.last);
  if (name == "--path") return copied(path_names());
  if (name == "--brdf") return copied(brdf_names());
  if (name == "--projection") return copied(projection_names());
  if (name == "--shadows") return copied(shadow_names());
  if (name == "--probes-show") return copied(probes_show_names());
  if (name == "--heatmap-of") return copied(heat_names());
  if (name == "--still-lists") return copied(still_lists_names());
  if (name == "--mirror-lists") return copied(mirror_list_names());
  if (name == "--point-shadows") return copied(point_shadow_names());
  if (name == "--shadow-raster") return copied(shadow_raster_names());
  if (name == "--shadow-blur") return copied(shadow_blur_names());
  if (name == "--depth") return copied(depth_names());
  if (name == "--depth-samples") return {"1", "2", "4", "8"};
  if (name == "--verifier") return copied(verifier_names());
  if (name == "--lights-as") return {"npy", "json"};
  if (name == "what") return {"methods", "lookups", "scenes", "suites", "devices", "pipelines"};
  if (name == "shell") return {"bash", "zsh", "fish"};
  return {};
}

Words command_words(const CLI::App& app) {
  Words words;
  for (const CLI::App* command : app.get_subcommands({})) words.push_back(command->get_name());
  return words;
}

Words option_words(const CLI::App& command) {
  Words words;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  return words;
}

/// The name of the argument at that place; empty: there is none.
std::string argument_name(const CLI::App& command, std::size_t place) {
  for (const CLI::Option* option :
       command.get_options([](const CLI::Option* candidate) { return candidate->get_positional(); }))
    if (place-- == 0) return option->get_name(/*positional=*/true);
  return {};
}

Words in_command(const CLI::App& app, const Typed& typed) {
  const Place place = place_of(typed);
  if (place.option != nullptr) return values_of(typed, place.option->get_name());
  if (typed.last.starts_with("-")) return option_words(typed.command);
  const std::string argument = argument_name(typed.command, place.arguments);
  return argument == "command" ? command_words(app) : values_of(typed, argument);
}

}  // namespace

std::vector<std::string> completions(const CLI::App& app, std::string_view line) {
  Words words = values_apart(split(line));
  if (words.empty()) return {};
  const std::string typed = split(line).back();
  const std::string last = words.back();
  const std::string option = typed.substr(0, typed.size() - last.size());  // "--method=", or nothing
  words.pop_back();
  Words found;
  if (words.empty()) {
    found = last.starts_with("-") ? option_words(app) : command_words(app);
  } else if (const CLI::App* command = find_command(app, words.front()); command != nullptr) {
    found = in_command(app, {.command = *command, .before = std::span(words).subspan(1), .last = last});
  }
  std::erase_if(found, [&](const std::string& word) { return !word.starts_with(last); });
  for (std::string& word : found) word.insert(0, option);
  return found;
}

}  // namespace lamp::app
