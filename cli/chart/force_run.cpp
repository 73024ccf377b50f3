// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/force_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "chart/scene.h"

namespace argil::cli::chart {
namespace {

std::vector<int> radii_of(const ForceRun& run) {
  return run.quick ? std::vector<int>{4, 16} : std::vector<int>{4, 8, 16, 32, 64, 128};
}

/// The scenes of the run, the plane first: it is where the finest lattice is timed.
std::vector<SceneKind> scenes_of(const ForceRun& run, std::vector<std::string>& skipped) {
  std::vector<SceneKind> kinds = formula_scenes();
  if (run.quick) {
    std::erase_if(kinds, [](const SceneKind& kind) {
      return kind.name != "plane" && kind.name != "torus" && kind.name != "edge";
    });
    return kinds;
  }
  std::string missing;
  if (auto bunny = bunny_scene(missing)) {
    kinds.push_back(std::move(*bunny));
  } else {
    skipped.push_back(missing);
  }
  return kinds;
}

/// All of one scene: every radius and tool.
class SceneRun {
 public:
  SceneRun(const ForceRun& run, const SceneKind& kind, std::size_t scene_number,
           FinestTimes& finest_times)
      : run_(run), kind_(kind), scene_number_(scene_number), finest_times_(finest_times) {}

  Result<void> measure(const std::function<bool(double)>& proceed, ForceRunResult& result) {
    const std::vector<int> radii = radii_of(run_);
    for (std::size_t r = 0; r < radii.size(); ++r) {
      if (!proceed(static_cast<double>(r) / static_cast<double>(radii.size()))) {
        return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
      }
      if (auto made = make(radii[r] * kVoxelMm); !made) return made.error();
      for (const ToolKind tool : {ToolKind::ball, ToolKind::ellipsoid}) {
        if (auto done = measure_tool(radii[r], tool, result); !done) return done.error();
      }
    }
    return {};
  }

 private:
  Result<void> make(double radius_mm) {
    if (scene_ && !kind_.scales) return {};
    scene_.reset();
    auto made = kind_.make(radius_mm);
    if (!made) return made.error();
    scene_.emplace(std::move(made).value());
    return {};
  }

  Result<void> measure_tool(int radius_voxels, ToolKind tool, ForceRunResult& result) {
    const unsigned long seed = (run_.seed * 100 + scene_number_) * 10000 +
                               static_cast<unsigned long>(radius_voxels) * 10 +
                               static_cast<unsigned long>(tool);
    ForceStation station(*scene_, kind_, tool, radius_voxels, run_.quick, seed);
    if (kind_.name == "plane") station.time_finest_lattice(finest_times_);
    auto rows = station.measure(finest_times_);
    if (!rows) return rows.error();
    for (ForceRow& row : rows.value()) result.rows.push_back(std::move(row));
    ReferenceChange& change = result.reference_change;
    change.energy = std::max(change.energy, station.reference_change().energy);
    change.blanch = std::max(change.blanch, station.reference_change().blanch);
    return {};
  }

  const ForceRun& run_;
  const SceneKind& kind_;
  std::size_t scene_number_;
  FinestTimes& finest_times_;
  std::optional<Scene> scene_;
};

}  // namespace

Result<ForceRunResult> run_force_chart(const ForceRun& run, const Progress& progress) {
  ForceRunResult result;
  FinestTimes finest_times;
  const std::vector<SceneKind> kinds = scenes_of(run, result.skipped);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const auto proceed = [&](double share) {
      return !progress ||
             progress("measuring " + kinds[i].name,
                      (static_cast<double>(i) + share) / static_cast<double>(kinds.size()));
    };
    SceneRun scene(run, kinds[i], i, finest_times);
    if (auto done = scene.measure(proceed, result); !done) return done.error();
  }
  return result;
}

}  // namespace argil::cli::chart
