// lamp completion: scripts with which shells complete command lines of `lamp`, and the words that those ask it for.
// SPDX-License-Identifier: Apache-2.0
#include "commands/completion.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>

#include "bench/embedded_files.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "system/print.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 4> SHELLS{"bash", "zsh", "fish", "words"};

Exit completion(const CLI::App& app, const std::string& shell, const std::string& line) {
  if (shell == "words") {
    for (const std::string& word : completions(app, line)) write_out(word + "\n");
    return Exit::done;
  }
  if (!line.empty()) throw Error(fmt::format("argument '{}': was not expected; see lamp completion --help", line));
  write_out(std::ranges::find(completion_files(), "lamp." + shell, &EmbeddedFile::name)->text);
  return Exit::done;
}

}  // namespace

Run add_completion(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completion", "Print a script that completes commands in a shell");
  auto shell = std::make_shared<std::string>();
  auto line = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish; or words: what may end a line, for the scripts themselves")
      ->check([](const std::string& text) { return one_of(text, SHELLS); })
      ->type_name("SHELL")
      ->required();
  command->add_option("line", *line, "with words: the line up to the cursor")->type_name("LINE");
  command->footer(
      "Examples:\n"
      "  lamp completion bash > ~/.local/share/bash-completion/completions/lamp\n"
      "  lamp completion zsh > ~/.zfunc/_lamp          (a folder of your $fpath)\n"
      "  lamp completion fish > ~/.config/fish/completions/lamp.fish");
  return [&app, shell, line] { return completion(app, *shell, *line); };
}

}  // namespace lamp::app
