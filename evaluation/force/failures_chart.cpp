// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart failures: where the definition of the volume force fails, and what helps.
#include <memory>
#include <sstream>

#include "chart/chart.h"
#include "chart/kinds.h"
#include "force/failures.h"

namespace argil::evaluation {
namespace {

constexpr const char* kCsv = "force_failures.csv";
constexpr const char* kScript = "force_failures.gp";
constexpr const char* kPicture = "force_failures.svg";

/// One block a series, as gnuplot's `index` counts them: two empty lines between blocks.
std::string failures_csv(const std::vector<Panel>& panels) {
  std::ostringstream text;
  text << "# panel;series;x;y\n";
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      for (const auto& [x, y] : series.points) {
        text << panel.title << ';' << series.name << ';' << x << ';' << y << '\n';
      }
      text << "\n\n";
    }
  }
  return text.str();
}

std::string script_text(const std::vector<Panel>& panels) {
  std::ostringstream text;
  text << "# SPDX-License-Identifier: GPL-3.0-or-later\n"
       << "set terminal svg size 1180,1180 font 'Helvetica,13' background 'white'\n"
       << "set output '" << kPicture << "'\n"
       << "set datafile separator ';'\n"
       << "set multiplot layout 3,2\n"
       << "set grid lc '#dddddd'\nset bmargin 7\nset key below samplen 2 font ',11'\n"
       << "set linetype 1 lc '#1b6ca8' lw 2\nset linetype 2 lc '#c0392b' lw 2\n"
       << "set linetype 3 lc '#e08e0b' lw 2\nset linetype 4 lc '#2e8b57' lw 2\n"
       << "set linetype 5 lc '#7d3c98' lw 2\nset linetype cycle 5\n";
  std::size_t block = 0;
  for (const Panel& panel : panels) {
    text << "set title \"" << panel.title << "\" font ',14'\nset xlabel offset 0,0.6 '"
         << panel.x_label << "'\nset ylabel '" << panel.y_label << "'\nplot ";
    const char* comma = "";
    for (const Series& series : panel.series) {
      text << comma << "'" << kCsv << "' index " << block++ << " using 3:4 with lines title \""
           << series.name << "\"";
      comma = ", ";
    }
    text << '\n';
  }
  text << "unset multiplot\n";
  return text.str();
}

Result<cli::Outcome> make_failures_chart(const ChartOptions& options) {
  auto files = ChartFiles::in(options.folder);
  if (!files) return files.error();
  const std::vector<Panel> panels = force_failures();
  std::size_t rows = 0;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) rows += series.points.size();
  }
  cli::Outcome outcome;
  outcome.json["rows"] = rows;
  const Script script{kScript, kPicture, script_text(panels)};
  if (auto written = write_chart(files.value(), kCsv, failures_csv(panels), script, outcome);
      !written) {
    return written.error();
  }
  return outcome;
}

}  // namespace

void add_chart_failures(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  CLI::App* command = cli::add_command(
      chart, selected, "failures", "where the definition of the volume force fails",
      [options](const Progress&) { return make_failures_chart(*options); });
  command->add_option("-o", options->folder, "the folder to write to; default charts")
      ->type_name("DIR");
}

}  // namespace argil::evaluation
