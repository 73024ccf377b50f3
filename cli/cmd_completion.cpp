// SPDX-License-Identifier: GPL-3.0-or-later
// argil completion SHELL: a script that completes command lines, made from these very commands.
#include <memory>
#include <utility>

#include "commands.h"
#include "shell/completion.h"

namespace argil::cli {
namespace {

Result<Outcome> run_completion(const CLI::App& app, const std::string& shell) {
  const DescribedCommand program = describe(app);
  Outcome outcome;
  outcome.text = shell == "bash" ? bash_completion(program) : zsh_completion(program);
  outcome.json["shell"] = shell;
  outcome.json["script"] = outcome.text;
  return outcome;
}

}  // namespace

void add_completion(CLI::App& app, Selected& selected) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      add_command(app, selected, "completion", "print a script that completes command lines",
                  [&app, shell](const Progress&) { return run_completion(app, *shell); });
  command->add_option("SHELL", *shell, "the shell that is to read it")
      ->required()
      ->type_name("bash|zsh")
      ->check([](const std::string& name) {
        return name == "bash" || name == "zsh" ? std::string()
                                               : "SHELL is '" + name + "'; must be bash or zsh";
      });
}

}  // namespace argil::cli
