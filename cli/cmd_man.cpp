// SPDX-License-Identifier: GPL-3.0-or-later
// argil man [COMMAND]: manual pages, made from these very commands.
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "argil/io/safe_file.h"

#include "commands.h"
#include "common/options.h"
#include "shell/manual_page.h"

namespace argil::cli {
namespace {

namespace fs = std::filesystem;

struct ManOptions {
  std::string command;
  fs::path folder;
};

Result<Outcome> print_page(const DescribedCommand& program, const std::string& name) {
  Outcome outcome;
  // Without a name the page is that of the program.
  const DescribedCommand* command = &program;
  for (const DescribedCommand& each : program.commands) {
    if (each.name == name) command = &each;
  }
  outcome.text = manual_page(program, *command);
  outcome.json["name"] = page_name(*command);
  outcome.json["page"] = outcome.text;
  return outcome;
}

Result<Outcome> write_pages(const DescribedCommand& program, const fs::path& folder) {
  Outcome outcome;
  std::vector<const DescribedCommand*> with_page{&program};
  for (const DescribedCommand& each : program.commands) with_page.push_back(&each);
  for (const DescribedCommand* command : with_page) {
    const fs::path file = folder / (page_name(*command) + ".1");
    if (auto room = check_output(file); !room) return room.error();
    if (auto written = io::replace_text(file, manual_page(program, *command)); !written) {
      return written.error();
    }
    outcome.json["files"].push_back(file.string());
    outcome.text += file.string() + "\n";
  }
  return outcome;
}

Result<Outcome> run_man(const CLI::App& app, const ManOptions& options) {
  const DescribedCommand program = describe(app);
  return options.folder.empty() ? print_page(program, options.command)
                                : write_pages(program, options.folder);
}

std::string check_command(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return "";
  }
  return "COMMAND is '" + name + "'; must be a command that 'argil --help' lists";
}

}  // namespace

void add_man(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ManOptions>();
  CLI::App* command =
      add_command(app, selected, "man", "print a manual page, for `man -l -`",
                  [&app, options](const Progress&) { return run_man(app, *options); });
  CLI::Option* one =
      command->add_option("COMMAND", options->command, "of this command; default argil itself")
          ->type_name("COMMAND")
          ->check([&app](const std::string& name) { return check_command(app, name); });
  command->add_option("-o,--output", options->folder, "write all pages into this folder instead")
      ->type_name("FOLDER")
      ->excludes(one);
}

}  // namespace argil::cli
