// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart force: what each method of summing the force costs, and how wrong it is.
#include "chart/chart.h"

#include <cstdio>
#include <memory>

#include "chart/kinds.h"
#include "common/command.h"
#include "common/machine.h"
#include "common/output.h"
#include "force/plot.h"
#include "force/run.h"

namespace argil::evaluation {
namespace {

struct ForceChartOptions {
  ChartOptions shared;
  ForceRun run;
};

std::string percent(double fraction) { return cli::number(100.0 * fraction) + " %"; }

/// A line for one method in one scene.
std::string summary_line(const ForceRow& row) {
  char text[256];
  const Tally& t = row.tally;
  std::snprintf(text, sizeof text, "%-11s %8.3f %9.3f %8.3f %8.3f %8.3f %8.3f %7.1f %8.2f %8.2f\n",
                row.scene.c_str(), 100.0 * quantile(t.error, 0.95),
                100.0 * quantile(t.shallow_error, 0.95), quantile(t.direction_deg, 0.99),
                100.0 * quantile(t.torque, 0.95), 100.0 * quantile(t.ripple_rms, 0.95),
                100.0 * quantile(t.ripple_pp, 1.0), 100.0 * mean(t.bound_held),
                quantile(t.cpu_us, 0.5), quantile(t.cpu_us, 0.99));
  return text;
}

std::string force_summary(const ForceRunResult& result, const std::vector<ForceRow>& by_scene) {
  std::string text = "errors p95 in %, direction p99 in degrees, time in us\n";
  for (const char* method : {"lod", "servo"}) {
    text += std::string(method) +
            "\nscene          error   shallow direct.  torque rip.rms  rip.p-p  bound   cpu p50  "
            "cpu p99\n";
    for (const ForceRow& row : by_scene) {
      if (row.method == method) text += summary_line(row);
    }
  }
  text += "half as many nodes again change the reference by at most " +
          percent(result.reference_change.energy) + " (energy), " +
          percent(result.reference_change.blanch) + " (blanch)\n";
  for (const std::string& scene : result.skipped) text += "skipped " + scene + "\n";
  return text;
}

Result<cli::Outcome> make_force_chart(const ForceChartOptions& options, const Progress& progress) {
  ForceRun run = options.run;
  run.quick = options.shared.quick;
  auto made = ChartFiles::in(options.shared.folder);
  if (!made) return made.error();
  ChartFiles& files = made.value();
  const ReadRates rates{cli::read_bandwidth(64U << 10U), cli::read_bandwidth(1U << 20U)};
  auto measured = run_force_chart(run, progress);
  if (!measured) return measured.error();
  const ForceRunResult& result = measured.value();
  const std::vector<ForceRow> by_scene = pooled_by_scene(result.rows);
  const std::vector<ForceRow> by_radius = pooled_by_radius(result.rows);

  const std::string machine = cli::machine_name();
  std::string hash;
  std::string pooled_hash;
  for (const auto& written :
       {files.write("force.csv", csv_text(result.rows, machine, run.seed, hash)),
        files.write("force_by_scene.csv", csv_text(by_scene, machine, run.seed, pooled_hash))}) {
    if (!written) return written.error();
  }
  for (const Script& script : force_scripts(by_scene, by_radius, rates, machine)) {
    if (auto drawn = files.draw(script); !drawn) return drawn.error();
  }
  cli::Outcome outcome;
  outcome.json["rows"] = result.rows.size();
  outcome.json["files"] = files.written();
  outcome.json["hash"] = hash;
  outcome.json["skipped"] = result.skipped;
  outcome.json["reference_change"] = {{"energy", result.reference_change.energy},
                                      {"blanch", result.reference_change.blanch}};
  outcome.text = force_summary(result, by_scene);
  if (!files.has_pictures())
    outcome.text += "no pictures: install the package gnuplot-nox and run again\n";
  return outcome;
}

}  // namespace

void add_chart_force(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<ForceChartOptions>();
  add_kind(chart, selected, "force", "error, ripple and time of every way to sum the force",
           options->shared,
           [options](const Progress& progress) { return make_force_chart(*options, progress); });
}

}  // namespace argil::evaluation
