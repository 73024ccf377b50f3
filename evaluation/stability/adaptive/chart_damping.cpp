// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/adaptive/chart_damping.h"

#include "stability/adaptive/plot_damping.h"

namespace argil::evaluation {

Result<cli::Outcome> make_damping_chart(const ChartOptions& options, const Progress& progress) {
  auto made = ChartFiles::in(options.folder);
  if (!made) return made.error();
  ChartFiles& files = made.value();
  auto measured = measure_damping(options.quick, progress, 0.0, 1.0);
  if (!measured) return measured.error();
  const DampingResult& all = measured.value();
  for (const auto& written :
       {files.write("stability_damping.csv", damped_wall_csv(all.walls)),
        files.write("stability_damping_period.csv", damped_period_csv(all.periods)),
        files.write("stability_damping_contact.csv", damped_contact_csv(all.contacts)),
        files.write("stability_damping_motion.csv", damped_motion_csv(all.motions))}) {
    if (!written) return written.error();
  }
  for (const Script& script :
       {damping_map_script(all.walls), damping_script(all.walls, all.periods)}) {
    if (auto drawn = files.draw(script); !drawn) return drawn.error();
  }
  cli::Outcome outcome;
  outcome.json["rows"] =
      all.walls.size() + all.periods.size() + all.contacts.size() + all.motions.size();
  outcome.json["files"] = files.written();
  outcome.text = "wrote " + std::to_string(files.written().size()) + " files to " +
                 options.folder.string() + "\n";
  if (!files.has_pictures()) {
    outcome.text += "no pictures: install the package gnuplot-nox and run again\n";
  }
  return outcome;
}

}  // namespace argil::evaluation
