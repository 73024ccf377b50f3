// SPDX-License-Identifier: GPL-3.0-or-later
// Blender's voxel remesher: writes what blender_remesh.py reads, and reads what that answers.
#include "surface/blender.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

#include "argil/io/safe_file.h"

#include "blender/child.h"
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

Result<void> write_surface(const TriangleMesh& surface, const cli::ScratchFolder& scratch) {
  std::vector<float> positions;
  positions.reserve(3 * surface.positions.size());
  for (const Vec3& p : surface.positions) {
    for (std::size_t a = 0; a < 3; ++a) positions.push_back(static_cast<float>(p[a]));
  }
  if (auto done = write_values(scratch / "positions", positions); !done) return done;
  return write_values(scratch / "triangles", surface.triangles);
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
  const auto coordinates = read_values<float>(scratch / "result.positions");
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    made.positions.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  }
  made.triangles = read_values<Triangle>(scratch / "result.triangles");
  const auto is_there = [&](std::uint32_t corner) { return corner < made.positions.size(); };
  const bool is_whole =
      !made.triangles.empty() &&
      std::all_of(made.triangles.begin(), made.triangles.end(),
                  [&](const Triangle& t) { return std::all_of(t.begin(), t.end(), is_there); });
  if (!is_whole) return remesh_failed("its result is cut off");
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
  if (auto done = write_surface(surface_mm, scratch); !done) return done.error();
  const json job{{"positions", path("positions")}, {"triangles", path("triangles")},
                 {"voxel_mm", voxel_mm},           {"runs", runs},
                 {"result", path("result")},       {"answer", path("answer")}};
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
