// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart failures: where the definition of the volume force fails, and what helps.
#include <memory>
#include <sstream>

#include "argil/io/safe_file.h"

#include "chart/chart.h"
#include "chart/force_failures.h"
#include "chart/machine.h"

namespace argil::cli::chart {
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

Result<Outcome> make_failures_chart(const ChartOptions& options) {
  if (auto made = make_folder(options.folder); !made) return made.error();
  const std::vector<Panel> panels = force_failures();
  std::size_t rows = 0;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) rows += series.points.size();
  }
  for (const auto& written : {io::replace_text(options.folder / kCsv, failures_csv(panels)),
                              io::replace_text(options.folder / kScript, script_text(panels))}) {
    if (!written) return written.error();
  }
  Outcome outcome;
  outcome.json["rows"] = rows;
  outcome.json["files"] = {(options.folder / kCsv).string(), (options.folder / kScript).string()};
  if (!has_gnuplot()) {
    outcome.text = "no picture: install the package gnuplot-nox and run again\n";
    return outcome;
  }
  if (auto drawn = plot(options.folder, kScript); !drawn) return drawn.error();
  outcome.json["files"].push_back((options.folder / kPicture).string());
  outcome.text = "wrote " + (options.folder / kPicture).string() + "\n";
  return outcome;
}

}  // namespace

void add_chart_failures(CLI::App& chart, Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  CLI::App* command =
      add_command(chart, selected, "failures", "where the definition of the volume force fails",
                  [options](const Progress&) { return make_failures_chart(*options); });
  command->add_option("-o", options->folder, "the folder to write to; default charts")
      ->type_name("DIR");
}

}  // namespace argil::cli::chart
