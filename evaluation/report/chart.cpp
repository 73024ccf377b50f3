// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart report: the figures and numbers of both reports, made again.
#include "chart/chart.h"

#include <cstdio>
#include <memory>
#include <utility>

#include "chart/kinds.h"
#include "report/parts.h"

namespace argil::evaluation {
namespace {

/// Runs of one part are a fraction of their own each; told is how many figures are there.
Result<ReportFigures> report_figures(bool quick, const Progress& progress) {
  constexpr double kFigures = 19.0;
  ReportFigures figures;
  const Progress inner = [&](std::string_view, double) {
    return !progress || progress("report", static_cast<double>(figures.size()) / kFigures);
  };
  auto cubes = cubes_figure();
  if (!cubes) return cubes.error();
  figures.push_back(std::move(cubes).value());
  append(figures, force_figures());
  auto mechanics = mechanics_figures(inner);
  if (!mechanics) return mechanics.error();
  append(figures, std::move(mechanics).value());
  auto scenes = scene_figures(inner);
  if (!scenes) return scenes.error();
  append(figures, std::move(scenes).value());
  auto damping = damping_figure(inner);
  if (!damping) return damping.error();
  figures.push_back(std::move(damping).value());
  auto couplings = coupling_figure(quick, inner);
  if (!couplings) return couplings.error();
  figures.push_back(std::move(couplings).value());
  return figures;
}

std::string report_summary(const ReportFigures& figures) {
  std::string text;
  for (const ReportFigure& figure : figures) {
    text += figure.title + "\n";
    for (const ReportNumber& number : figure.numbers) {
      char line[200];
      std::snprintf(line, sizeof line, "  %-42s %-24s %.4g %s\n", number.name.c_str(),
                    number.printed.empty() ? "-" : number.printed.c_str(), number.ours,
                    number.unit.c_str());
      text += line;
    }
  }
  return text;
}

Result<cli::Outcome> make_report(const ChartOptions& options, const Progress& progress) {
  auto made = ChartFiles::in(options.folder);
  if (!made) return made.error();
  ChartFiles& files = made.value();
  const auto measured = report_figures(options.quick, progress);
  if (!measured) return measured.error();
  const ReportFigures& figures = measured.value();
  for (const ReportFigure& figure : figures) {
    if (auto drawn = files.draw(figure.script); !drawn) return drawn.error();
  }
  if (auto written = files.write("report.csv", report_csv(figures)); !written) {
    return written.error();
  }
  const std::string page = report_page(figures, files.has_pictures());
  if (auto written = files.write("report.html", page); !written) return written.error();
  cli::Outcome outcome;
  outcome.text = report_summary(figures) + "wrote " + files.written().back() + "\n";
  outcome.json["figures"] = figures.size();
  for (const ReportFigure& figure : figures) {
    for (const ReportNumber& number : figure.numbers) {
      outcome.json["numbers"].push_back(
          {{"picture", figure.script.name.substr(0, figure.script.name.rfind('.'))},
           {"name", number.name},
           {"printed", number.printed},
           {"ours", number.ours},
           {"unit", number.unit}});
    }
  }
  outcome.json["files"] = files.written();
  return outcome;
}

}  // namespace

void add_chart_report(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ChartOptions>();
  add_kind(chart, selected, "report", "every figure of the two reports behind this program",
           *options,
           [options](const Progress& progress) { return make_report(*options, progress); });
}

}  // namespace argil::evaluation
