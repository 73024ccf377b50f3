// SPDX-License-Identifier: GPL-3.0-or-later
// One operator of Blender on meshes: writes what made_mesh.py reads, and reads what that answers.
#include "blender/made_mesh.h"

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

/// `what`: "Blender's remesher".
Error operator_failed(const std::string& what, const std::string& why) {
  return {ErrorKind::internal, what + " failed (" + why + ")"};
}

Result<BlenderMesh> read_answer(const std::string& what, const cli::ScratchFolder& scratch) {
  const json answer = json::parse(text_in(scratch / "answer"), nullptr, false);
  if (!answer.is_object()) return operator_failed(what, last_said(scratch));
  if (answer.contains("error")) return operator_failed(what, answer["error"].get<std::string>());
  BlenderMesh made;
  std::vector<double> wall_ms;
  std::vector<double> cpu_ms;
  for (const json& run : answer["runs"]) {
    wall_ms.push_back(run[0].get<double>());
    cpu_ms.push_back(run[1].get<double>());
  }
  made.wall_us = 1e3 * median_of(std::move(wall_ms));
  made.cpu_us = 1e3 * median_of(std::move(cpu_ms));
  auto mesh = read_mesh_files(scratch / "result");
  if (!mesh) return operator_failed(what, "its result is cut off");
  made.positions = std::move(mesh->positions);
  made.triangles = std::move(mesh->triangles);
  return made;
}

/// Runs the script in a folder that has its meshes, with what `job` says besides.
Result<BlenderMesh> run_operator(const std::string& what, const cli::ScratchFolder& scratch,
                                 json job, const Progress& progress) {
  for (const char* name : {"result", "answer"}) job[name] = (scratch / name).string();
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{"make.py", made_mesh_script()},
        {"job.json", job.dump()}}) {
    if (auto done = io::replace_text(scratch / name, text); !done) return done.error();
  }
  if (auto ended = run_blender_child(
          {scratch, "make.py", "job.json", "", kPatienceS, [] { return 0.0; }}, progress);
      !ended) {
    return ended.error();
  }
  return read_answer(what, scratch);
}

}  // namespace

std::string made_mesh_obstacle() {
  constexpr std::array kNeeded{NeededProgram{"blender", "blender"}};
  return blender_obstacle(kNeeded);
}

Result<BlenderMesh> blender_remesh(const TriangleMesh& surface_mm, double voxel_mm, int runs,
                                   const Progress& progress) {
  assert(voxel_mm > 0.0 && runs >= 1 && !surface_mm.triangles.empty());
  const auto made = cli::ScratchFolder::make();
  if (!made) return made.error();
  const cli::ScratchFolder& scratch = made.value();
  if (auto done = write_mesh_files(scratch / "body", surface_mm); !done) return done.error();
  return run_operator(
      "Blender's remesher", scratch,
      {{"body", (scratch / "body").string()}, {"voxel_mm", voxel_mm}, {"runs", runs}}, progress);
}

Result<BlenderMesh> blender_union(const TriangleMesh& a_mm, const TriangleMesh& b_mm, int runs,
                                  const Progress& progress) {
  assert(runs >= 1 && !a_mm.triangles.empty() && !b_mm.triangles.empty());
  const auto made = cli::ScratchFolder::make();
  if (!made) return made.error();
  const cli::ScratchFolder& scratch = made.value();
  for (const auto& [name, mesh] : {std::pair{"body", &a_mm}, {"other", &b_mm}}) {
    if (auto done = write_mesh_files(scratch / name, *mesh); !done) return done.error();
  }
  return run_operator("Blender's union", scratch,
                      {{"body", (scratch / "body").string()},
                       {"other", (scratch / "other").string()},
                       {"runs", runs}},
                      progress);
}

}  // namespace argil::evaluation
