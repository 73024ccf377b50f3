// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_volume.h"

#include "argil/io/project_file.h"
#include "argil/io/volume_file.h"

#include "options.h"
#include "output.h"
#include "project.h"

namespace argil::cli {

Result<Outcome> export_volume(const std::string& project, const std::filesystem::path& file,
                              const Progress& progress) {
  const Stopwatch watch;
  const auto opened = open_project(project, progress);
  if (!opened) return opened.error();
  std::error_code none;
  if (std::filesystem::equivalent(project, file, none)) {
    return Error{ErrorKind::bad_input, "'" + file.string() +
                                           "' is the project itself, which its field would "
                                           "replace; give another name"};
  }
  if (io::holds_project(file)) {
    return Error{ErrorKind::bad_input, "'" + file.string() +
                                           "' is a project, which a field would replace for good; "
                                           "give another name, or remove it first"};
  }
  const Clay& clay = opened.value().clay;
  const auto written = io::export_volume(file, clay, progress);
  if (!written) return written.error();
  const io::VolumeReport& report = written.value();
  Outcome outcome;
  outcome.json["voxel_mm"] = report.voxel_mm;
  outcome.json["active_voxels"] = report.active_voxels;
  outcome.json["leaves"] = report.leaves;
  outcome.json["bytes"] = report.bytes;
  outcome.json["file_bytes"] = std::filesystem::file_size(file);
  outcome.json["clay_hash"] = hex(clay.hash());
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  outcome.json["seconds"] = watch.seconds();
  outcome.text = grouped(report.active_voxels) + " voxels of " + number(report.voxel_mm) +
                 " mm in one level set, in mm\nsaved '" + file.string() + "'\n";
  return outcome;
}

}  // namespace argil::cli
