// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/chart.h"

#include <system_error>
#include <utility>

#include "argil/io/safe_file.h"

namespace argil::cli::chart {
namespace {

namespace fs = std::filesystem;

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

Result<void> plot(const fs::path& folder, const std::string& script) {
  const auto picture = drawn_by_gnuplot(folder / script);
  if (!picture) return picture.error();
  return io::replace_text(folder / picture.value().name, picture.value().svg);
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
