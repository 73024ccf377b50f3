// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart force: what each way of summing the force costs, and how wrong it is.
#include <cstdio>
#include <memory>

#include "argil/io/safe_file.h"

#include "chart/chart.h"
#include "chart/force_plot.h"
#include "chart/force_run.h"
#include "chart/machine.h"
#include "output.h"

namespace argil::cli::chart {
namespace {

struct ForceChartOptions {
  ChartOptions shared;
  ForceRun run;
};

/// Every file of the chart as it is written.
class Output {
 public:
  explicit Output(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Result<void> write(const std::string& name, const std::string& text) {
    auto written = io::replace_text(folder_ / name, text);
    if (written) files_.push_back((folder_ / name).string());
    return written;
  }

  /// Scripts are written in any case, their pictures when gnuplot is there.
  Result<void> draw(const std::vector<Script>& scripts, bool with_pictures) {
    for (const Script& script : scripts) {
      if (auto written = write(script.name, script.text); !written) return written;
      if (!with_pictures) continue;
      if (auto drawn = plot(folder_, script.name); !drawn) return drawn;
      files_.push_back((folder_ / script.picture).string());
    }
    return {};
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::string> files_;
};

std::string percent(double share) { return number(100.0 * share) + " %"; }

/// The default's line for each scene.
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
  std::string text =
      "method lod, errors p95 in %, direction p99 in degrees, time in us\n"
      "scene          error   shallow direct.  torque rip.rms  rip.p-p  bound   cpu p50  cpu p99\n";
  for (const ForceRow& row : by_scene) {
    if (row.method == "lod") text += summary_line(row);
  }
  text += "half as many nodes again change the reference by at most " +
          percent(result.reference_change.energy) + " (energy), " +
          percent(result.reference_change.blanch) + " (blanch)\n";
  for (const std::string& scene : result.skipped) text += "skipped " + scene + "\n";
  return text;
}

Result<Outcome> make_force_chart(const ForceChartOptions& options, const Progress& progress) {
  ForceRun run = options.run;
  run.quick = options.shared.quick;
  if (auto made = make_folder(options.shared.folder); !made) return made.error();
  const Floor floor{read_bandwidth(64U << 10U), read_bandwidth(1U << 20U)};
  auto measured = run_force_chart(run, progress);
  if (!measured) return measured.error();
  const ForceRunResult& result = measured.value();
  const std::vector<ForceRow> by_scene = pooled_by_scene(result.rows);
  const std::vector<ForceRow> by_radius = pooled_by_radius(result.rows);

  const std::string machine = machine_name();
  std::string hash;
  std::string pooled_hash;
  Output output(options.shared.folder);
  const bool pictures = has_gnuplot();
  for (const auto& written :
       {output.write("force.csv", csv_text(result.rows, machine, run.seed, hash)),
        output.write("force_by_scene.csv", csv_text(by_scene, machine, run.seed, pooled_hash)),
        output.draw(force_scripts(by_scene, by_radius, floor, machine), pictures)}) {
    if (!written) return written.error();
  }
  Outcome outcome;
  outcome.json["rows"] = result.rows.size();
  outcome.json["files"] = output.files();
  outcome.json["hash"] = hash;
  outcome.json["skipped"] = result.skipped;
  outcome.json["reference_change"] = {{"energy", result.reference_change.energy},
                                      {"blanch", result.reference_change.blanch}};
  outcome.text = force_summary(result, by_scene);
  if (!pictures) outcome.text += "no pictures: install the package gnuplot-nox and run again\n";
  return outcome;
}

}  // namespace

void add_chart_force(CLI::App& chart, Selected& selected) {
  auto options = std::make_shared<ForceChartOptions>();
  add_kind(chart, selected, "force", "error, ripple and time of every way to sum the force",
           options->shared,
           [options](const Progress& progress) { return make_force_chart(*options, progress); });
}

}  // namespace argil::cli::chart
