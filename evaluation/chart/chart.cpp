// SPDX-License-Identifier: GPL-3.0-or-later
// What all charts have in common: their options, their folder, data as CSV and pictures by gnuplot
// where it is installed.
#include "chart/chart.h"

#include <cassert>
#include <system_error>
#include <utility>

#include "argil/io/safe_file.h"

#include "common/gnuplot.h"

namespace argil::evaluation {

namespace fs = std::filesystem;

CLI::App* add_kind(CLI::App& chart, cli::Selected& selected, const std::string& name,
                   const std::string& description, ChartOptions& options, cli::Work work) {
  CLI::App* command = cli::add_command(chart, selected, name, description, std::move(work));
  command->add_option("-o", options.folder, "the folder to write to; default charts")
      ->type_name("DIR");
  command->add_flag("--quick", options.quick, "a small selection in less than a minute");
  return command;
}

Result<void> tell(const Progress& progress, std::string_view stage, double fraction) {
  assert(fraction >= 0.0 && fraction <= 1.0 + 1e-9);  // sums of steps end a rounding beyond 1
  if (!progress || progress(stage, fraction)) return {};
  return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
}

ChartFiles::ChartFiles(fs::path folder)
    : folder_(std::move(folder)), has_pictures_(cli::has_gnuplot()) {}

Result<ChartFiles> ChartFiles::in(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder)) return ChartFiles(folder);
  return Error{ErrorKind::disk, "cannot make the folder '" + folder.string() +
                                    "'; check the name and who may write there"};
}

Result<void> ChartFiles::write(const std::string& name, const std::string& text) {
  assert(fs::path(name).filename() ==
         name);  // beside its siblings: scripts name data without a path
  auto written = io::replace_text(folder_ / name, text);
  if (written) written_.push_back((folder_ / name).string());
  return written;
}

Result<void> ChartFiles::draw(const Script& script) {
  if (auto written = write(script.name, script.text); !written) return written;
  if (!has_pictures_) return {};
  const auto drawn = cli::drawn_by_gnuplot(folder_ / script.name);
  if (!drawn) return drawn.error();
  assert(drawn.value().name == script.picture);
  return write(script.picture, drawn.value().svg);
}

Result<void> write_chart(ChartFiles& files, const std::string& csv_name, const std::string& csv,
                         const Script& script, cli::Outcome& outcome) {
  if (auto written = files.write(csv_name, csv); !written) return written;
  if (auto drawn = files.draw(script); !drawn) return drawn;
  outcome.json["files"] = files.written();
  outcome.text += files.has_pictures()
                      ? "wrote " + files.written().back() + "\n"
                      : "no picture: install the package gnuplot-nox and run again\n";
  return {};
}

}  // namespace argil::evaluation
