// SPDX-License-Identifier: GPL-3.0-or-later
// Blender's voxel remesher: writes what blender_remesh.py reads, and reads what that answers.
#include "surface/blender.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include <nlohmann/json.hpp>

#include "argil/io/safe_file.h"

#include "blender/child.h"
#include "blender/mesh_files.h"
#include "blender/script.h"
#include "common/scratch_folder.h"

namespace argil::evaluation {
namespace {

using nlohmann::json;

constexpr double kPatienceS = 600.0;

double median_of(std::vector<double> values) {
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Error remesh_failed(const std::string& why) {
  return {ErrorKind::internal, "Blender's remesher failed (" + why + ")"};
}

Result<BlenderRemesh> read_answer(const cli::ScratchFolder& scratch) {
  const json answer = json::parse(text_in(scratch / "answer"), nullptr, false);
  if (!answer.is_object()) return remesh_failed(last_said(scratch));
  if (answer.contains("error")) return remesh_failed(answer["error"].get<std::string>());
  BlenderRemesh made;
  std::vector<double> wall_ms;
  std::vector<double> cpu_ms;
  for (const json& run : answer["runs"]) {
    wall_ms.push_back(run[0].get<double>());
    cpu_ms.push_back(run[1].get<double>());
  }
  made.wall_us = 1e3 * median_of(std::move(wall_ms));
  made.cpu_us = 1e3 * median_of(std::move(cpu_ms));
  auto mesh = read_mesh_files(scratch / "result");
  if (!mesh) return remesh_failed("its result is cut off");
  made.positions = std::move(mesh->positions);
  made.triangles = std::move(mesh->triangles);
  return made;
}

}  // namespace

std::string remesh_obstacle() {
  constexpr std::array kNeeded{NeededProgram{"blender", "blender"}};
  return blender_obstacle(kNeeded);
}

Result<BlenderRemesh> blender_remesh(const TriangleMesh& surface_mm, double voxel_mm, int runs,
                                     const Progress& progress) {
  assert(voxel_mm > 0.0 && runs >= 1 && !surface_mm.triangles.empty());
  const auto made = cli::ScratchFolder::make();
  if (!made) return made.error();
  const cli::ScratchFolder& scratch = made.value();
  const auto path = [&](const char* name) { return (scratch / name).string(); };
  if (auto done = write_mesh_files(scratch / "body", surface_mm); !done) return done.error();
  const json job{{"positions", path("body.positions")},
                 {"triangles", path("body.triangles")},
                 {"voxel_mm", voxel_mm},
                 {"runs", runs},
                 {"result", path("result")},
                 {"answer", path("answer")}};
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{"remesh.py", remesh_script()},
        {"job.json", job.dump()}}) {
    if (auto done = io::replace_text(path(name), text); !done) return done.error();
  }
  if (auto ended = run_blender_child(
          {scratch, "remesh.py", "job.json", "", kPatienceS, [] { return 0.0; }}, progress);
      !ended) {
    return ended.error();
  }
  return read_answer(scratch);
}

}  // namespace argil::evaluation
