// lamp-view: looks at light culling while it runs. One command line, one place where errors end.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <string>

#include "commands/command_line.h"
#include "commands/complain.h"
#include "commands/view_state.h"
#include "lamplight/version.h"
#include "system/console.h"
#include "system/print.h"
#include "system/signals.h"
#include "view/headless.h"
#include "view/settings.h"
#include "view/window.h"

namespace {

using namespace lamp::app;

struct ViewOptions {
  ViewState state;
  bool headless = false;
  bool validate = false;
  std::string script;
  std::string bookmarks;
  std::string screen = "1280x720";
};

void add_options(CLI::App& app, ViewOptions& o) {
  add_state_option(app, o.state);
  add_common_options(app, o.state.request);
  add_depth_options(app, o.state.request);
  add_picture_options(app, o.state.request);
  add_exposure_option(app, o.state.exposure);
  app.add_flag("--headless", o.headless, "draw on a screen that nobody sees, for --script")->group("Window");
  app.add_option("--script", o.script, "do what the lines of this file say, then end (docs/viewer.md)")
      ->type_name("FILE")
      ->group("Window");
  app.add_option("--bookmarks", o.bookmarks, "open the bookmarks that lamp-view saved in this file")
      ->type_name("FILE")
      ->group("Window");
  app.add_option("--screen", o.screen, "size of the window, or of the screen that nobody sees, in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->group("Window")
      ->capture_default_str();
  app.add_flag("--validate", o.validate, "end with exit code 1 if Vulkan's validation layer says something")
      ->group("Device");
}

std::vector<Bookmark> bookmarks_of(const ViewOptions& o) {
  return o.bookmarks.empty() ? std::vector<Bookmark>() : load_bookmarks(o.bookmarks);
}

/// In a window, as the user had it last, where neither options nor a script say otherwise.
void show(const CLI::App& app, const ViewOptions& o, const std::vector<ScriptLine>& script,
          ContextInfo::Validation validation) {
  WindowInfo info{.state = o.state,
                  .bookmarks = bookmarks_of(o),
                  .script = script,
                  .plays = !o.script.empty(),
                  .size = parse_size(o.screen, "--screen"),
                  .validation = validation};
  if (!info.plays) {
    try {
      const Settings settings = load_settings(settings_file());
      if (app.get_option("--state")->count() == 0) apply(settings, info.state);
      if (app.get_option("--screen")->count() == 0) info.size = settings.screen;
    } catch (const Error& error) {
      info.said = std::string("settings were not read: ") + error.what();
    }
    info.closed = [](const ViewState& state, glm::uvec2 size) {
      if (size.x != 0 && size.y != 0) save_settings(settings_file(), settings_of(state, size));
    };
  }
  run_window(info);
}

Exit run(int argc, char** argv) {
  CLI::App app("Lamplight's window: see which lights are in which cells, and why", "lamp-view");
  app.set_version_flag("--version", "lamp-view " + std::string(lamp::version()), "Print the version and exit");
  app.footer(
      "Examples:\n"
      "  lamp-view atrium --lights 4096\n"
      "  lamp-view --state lamp-view.json\n"
      "  lamp-view --headless --script demo.jsonl\n"
      "Exit codes: 0 done, 1 a script's expectation was not met, 2 bad input or output that cannot be written,\n"
      "3 no usable device or display");
  ViewOptions o;
  add_options(app, o);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw parse_error(app, error);
    write_out(error.get_name() == "CallForVersion" ? app.version() + "\n" : help_text(app));
    return Exit::done;
  }
  check_repeats(app);
  check_values(app);
  check_state(o.state);
  if (o.headless && o.script.empty()) throw Error("--headless: nobody sees that screen, expected --script with it");
  const ContextInfo::Validation validation = o.validate ? ContextInfo::Validation::on : ContextInfo::Validation::off;
  const std::vector<ScriptLine> script = o.script.empty() ? std::vector<ScriptLine>() : read_script(o.script);
  if (o.headless) {
    Context context({.device = o.state.request.device, .validation = validation});
    run_headless(context, {.state = o.state, .screen = parse_size(o.screen, "--screen"), .bookmarks = bookmarks_of(o)},
                 [&](Player& player) { play(player, script); });
  } else {
    show(app, o, script, validation);
  }
  return Exit::done;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  watch_signals();
  const Exit exit = run_or_complain("lamp-view", [&] { return run(argc, argv); });
  if (output_problem() != 0)
    return static_cast<int>(complain("lamp-view", "standard output: cannot be written", Exit::bad_input));
  return static_cast<int>(exit);
}
