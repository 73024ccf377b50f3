// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart stability: where a held tool vibrates, and what helps.
#include "chart/chart.h"

#include <memory>

#include "chart/kinds.h"
#include "stability/adaptive/chart_damping.h"
#include "stability/cases.h"
#include "stability/late/chart_late.h"
#include "stability/plot.h"

namespace argil::evaluation {
namespace {

struct StabilityOptions : ChartOptions {
  bool is_late = false;
  bool is_damping = false;
};

struct Measured {
  std::vector<StiffnessRow> stiffness;
  std::vector<WallRow> walls;
  std::vector<FilterRow> filters;
  VolumeResult volume;
  std::vector<CaseRow> cases;
  SampledResult sampled;
  std::vector<CoggingRow> cogging;
};

Result<Measured> measure_all(bool quick, const Progress& progress) {
  Measured all;
  // Fractions of the progress of the whole chart, by the time that each part takes.
  auto stiffness = measure_stiffness(quick, progress, 0.0, 0.15);
  if (!stiffness) return stiffness.error();
  all.stiffness = std::move(stiffness).value();
  auto walls = measure_walls(quick, progress, 0.15, 0.2);
  if (!walls) return walls.error();
  all.walls = std::move(walls).value();
  auto filters = measure_filters(quick, progress, 0.2, 0.25);
  if (!filters) return filters.error();
  all.filters = std::move(filters).value();
  auto volume = measure_volume(quick, progress, 0.25, 0.3);
  if (!volume) return volume.error();
  all.volume = std::move(volume).value();
  auto cases = measure_cases(progress, 0.3, 0.31);
  if (!cases) return cases.error();
  all.cases = std::move(cases).value();
  auto sampled = measure_sampled(quick, progress, 0.31, 0.92);
  if (!sampled) return sampled.error();
  all.sampled = std::move(sampled).value();
  auto cogging = measure_cogging(quick, progress, 0.92, 1.0);
  if (!cogging) return cogging.error();
  all.cogging = std::move(cogging).value();
  return all;
}

Result<cli::Outcome> make_stability_chart(const ChartOptions& options, const Progress& progress) {
  auto made = ChartFiles::in(options.folder);
  if (!made) return made.error();
  ChartFiles& files = made.value();
  auto measured = measure_all(options.quick, progress);
  if (!measured) return measured.error();
  const Measured& all = measured.value();
  for (const auto& written :
       {files.write("stability_stiffness.csv", stiffness_csv(all.stiffness)),
        files.write("stability_wall.csv", wall_csv(all.walls)),
        files.write("stability_filter.csv", filter_csv(all.filters)),
        files.write("stability_volume.csv", volume_csv(all.volume.rows)),
        files.write("stability_volume_limit.csv", volume_limit_csv(all.volume.limits)),
        files.write("stability_cases.csv", case_csv(all.cases)),
        files.write("stability_sampled.csv", sampled_csv(all.sampled.rows)),
        files.write("stability_sampled_limit.csv", sampled_limit_csv(all.sampled.limits)),
        files.write("stability_cogging.csv", cogging_csv(all.cogging))}) {
    if (!written) return written.error();
  }
  for (const Script& script :
       {stiffness_script(all.stiffness), wall_script(all.walls), filter_script(all.filters),
        volume_script(all.volume), sampled_script(all.sampled, all.cogging)}) {
    if (auto drawn = files.draw(script); !drawn) return drawn.error();
  }
  cli::Outcome outcome;
  outcome.json["rows"] = all.stiffness.size() + all.walls.size() + all.filters.size() +
                         all.volume.rows.size() + all.volume.limits.size() + all.cases.size() +
                         all.sampled.rows.size() + all.sampled.limits.size() + all.cogging.size();
  outcome.json["files"] = files.written();
  outcome.text = "wrote " + std::to_string(files.written().size()) + " files to " +
                 options.folder.string() + "\n";
  if (!files.has_pictures()) {
    outcome.text += "no pictures: install the package gnuplot-nox and run again\n";
  }
  return outcome;
}

}  // namespace

void add_chart_stability(CLI::App& chart, cli::Selected& selected) {
  auto options = std::make_shared<StabilityOptions>();
  CLI::App* command =
      add_kind(chart, selected, "stability", "where a held tool vibrates, and what helps", *options,
               [options](const Progress& progress) {
                 if (options->is_late) return make_late_chart(*options, progress);
                 if (options->is_damping) return make_damping_chart(*options, progress);
                 return make_stability_chart(*options, progress);
               });
  CLI::Option* late = command->add_flag(
      "--late", options->is_late,
      "instead: what clay does that is felt late, by age and period of its windows");
  command
      ->add_flag("--damping", options->is_damping,
                 "instead: what adaptive damping holds still beside fixed, and how it feels")
      ->excludes(late);
}

}  // namespace argil::evaluation
