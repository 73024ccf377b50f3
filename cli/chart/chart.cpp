// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/chart.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "argil/io/safe_file.h"

namespace argil::cli::chart {
namespace {

namespace fs = std::filesystem;

/// A path as one word of a shell's command line.
std::string shell_quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The shell's exit status, and what the command printed.
int run_shell(const std::string& command, std::string& output) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return -1;
  std::array<char, 512> line{};
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
    output += line.data();
  }
  return ::pclose(pipe);
}

}  // namespace

CLI::App* add_kind(CLI::App& chart, Selected& selected, const std::string& name,
                   const std::string& description, ChartOptions& options, Work work) {
  CLI::App* command = add_command(chart, selected, name, description, std::move(work));
  command->add_option("-o", options.folder, "the folder to write to; default charts")
      ->type_name("DIR");
  command->add_flag("--quick", options.quick, "a small selection in less than a minute");
  return command;
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder)) return {};
  return Error{ErrorKind::disk, "cannot make the folder '" + folder.string() +
                                    "'; check the name and who may write there"};
}

bool has_gnuplot() {
  std::string ignored;
  return run_shell("gnuplot --version 2>/dev/null", ignored) == 0;
}

Result<void> plot(const fs::path& folder, const std::string& script) {
  std::string said;
  const std::string command =
      "cd " + shell_quoted(folder.string()) + " && gnuplot " + shell_quoted(script) + " 2>&1";
  if (run_shell(command, said) == 0) return {};
  return Error{ErrorKind::internal, "gnuplot failed on '" + script + "' (" + said + ")"};
}

Result<void> write_chart(const fs::path& folder, const std::string& csv_name,
                         const std::string& csv, const Script& script, Outcome& outcome) {
  for (const auto& [name, text] : {std::pair(csv_name, csv), std::pair(script.name, script.text)}) {
    if (auto written = io::replace_text(folder / name, text); !written) return written;
    outcome.json["files"].push_back((folder / name).string());
  }
  if (!has_gnuplot()) {
    outcome.text += "no picture: install the package gnuplot-nox and run again\n";
    return {};
  }
  if (auto drawn = plot(folder, script.name); !drawn) return drawn;
  outcome.json["files"].push_back((folder / script.picture).string());
  outcome.text += "wrote " + (folder / script.picture).string() + "\n";
  return {};
}

}  // namespace argil::cli::chart
