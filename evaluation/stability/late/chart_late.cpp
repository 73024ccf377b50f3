// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/chart_late.h"

#include "stability/late/plot_late.h"

namespace argil::evaluation {

Result<cli::Outcome> make_late_chart(const ChartOptions& options, const Progress& progress) {
  auto made = ChartFiles::in(options.folder);
  if (!made) return made.error();
  ChartFiles& files = made.value();
  auto measured = measure_late(options.quick, progress, 0.0, 1.0);
  if (!measured) return measured.error();
  const LateResult& late = measured.value();
  for (const auto& written :
       {files.write("stability_late.csv", late_csv(late.rows)),
        files.write("stability_late_spring.csv", late_spring_csv(late.springs)),
        files.write("stability_late_limit.csv", late_limit_csv(late.limits))}) {
    if (!written) return written.error();
  }
  for (const Script& script : {late_script(late), late_map_script(late)}) {
    if (auto drawn = files.draw(script); !drawn) return drawn.error();
  }
  cli::Outcome outcome;
  outcome.json["rows"] = late.rows.size() + late.springs.size() + late.limits.size();
  outcome.json["files"] = files.written();
  outcome.text = "wrote " + std::to_string(files.written().size()) + " files to " +
                 options.folder.string() + "\n";
  if (!files.has_pictures()) {
    outcome.text += "no pictures: install the package gnuplot-nox and run again\n";
  }
  return outcome;
}

}  // namespace argil::evaluation
