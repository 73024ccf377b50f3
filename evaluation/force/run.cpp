// SPDX-License-Identifier: GPL-3.0-or-later
// All scenes, radii and tools of the force chart, one after the other. Each has a seed of its own,
// so that its poses do not depend on how many the others drew.
#include "force/run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "chart/chart.h"
#include "scene/scene.h"

namespace argil::evaluation {
namespace {

std::vector<int> radii_of(const ForceRun& run) {
  return run.quick ? std::vector<int>{4, 16} : std::vector<int>{4, 8, 16, 32, 64, 128};
}

/// The scenes of the run, the plane first: it is where the finest lattice is timed.
std::vector<SceneRecipe> scenes_of(const ForceRun& run, std::vector<std::string>& skipped) {
  std::vector<SceneRecipe> recipes = formula_scenes();
  if (run.quick) {
    std::erase_if(recipes, [](const SceneRecipe& recipe) {
      return recipe.name != "plane" && recipe.name != "torus" && recipe.name != "edge";
    });
    return recipes;
  }
  std::string missing;
  if (auto bunny = bunny_scene(missing)) {
    recipes.push_back(std::move(*bunny));
  } else {
    skipped.push_back(missing);
  }
  return recipes;
}

/// All of one scene: every radius and tool.
class SceneRun {
 public:
  SceneRun(const ForceRun& run, const SceneRecipe& recipe, std::size_t scene_number,
           FinestTimes& finest_times)
      : run_(run), recipe_(recipe), scene_number_(scene_number), finest_times_(finest_times) {}

  /// `go_on` is told how much of the scene is done.
  Result<void> measure(const std::function<Result<void>(double)>& go_on, ForceRunResult& result) {
    const std::vector<int> radii = radii_of(run_);
    for (std::size_t r = 0; r < radii.size(); ++r) {
      const double done = static_cast<double>(r) / static_cast<double>(radii.size());
      if (auto go = go_on(done); !go) return go;
      if (auto made = make(radii[r] * kVoxelMm); !made) return made.error();
      for (const ToolKind tool : {ToolKind::ball, ToolKind::ellipsoid}) {
        if (auto measured = measure_tool(radii[r], tool, result); !measured)
          return measured.error();
      }
    }
    return {};
  }

 private:
  Result<void> make(double radius_mm) {
    if (scene_ && !recipe_.scales) return {};
    scene_.reset();
    auto made = recipe_.make(radius_mm);
    if (!made) return made.error();
    scene_.emplace(std::move(made).value());
    return {};
  }

  Result<void> measure_tool(int radius_voxels, ToolKind tool, ForceRunResult& result) {
    // Decimal fields: scene below 100, radius below 1000, tool below 10.
    const unsigned long seed = (run_.seed * 100 + scene_number_) * 10000 +
                               static_cast<unsigned long>(radius_voxels) * 10 +
                               static_cast<unsigned long>(tool);
    ForceStation station(*scene_, recipe_, tool, radius_voxels, run_.quick, seed);
    if (recipe_.name == "plane") station.time_finest_lattice(finest_times_);
    auto rows = station.measure(finest_times_);
    if (!rows) return rows.error();
    for (ForceRow& row : rows.value()) result.rows.push_back(std::move(row));
    ReferenceChange& change = result.reference_change;
    change.energy = std::max(change.energy, station.reference_change().energy);
    change.blanch = std::max(change.blanch, station.reference_change().blanch);
    return {};
  }

  const ForceRun& run_;
  const SceneRecipe& recipe_;
  std::size_t scene_number_;
  FinestTimes& finest_times_;
  std::optional<Scene> scene_;
};

}  // namespace

Result<ForceRunResult> run_force_chart(const ForceRun& run, const Progress& progress) {
  ForceRunResult result;
  FinestTimes finest_times;
  const std::vector<SceneRecipe> recipes = scenes_of(run, result.skipped);
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    const auto go_on = [&](double done) {
      return tell(progress, "measuring " + recipes[i].name,
                  (static_cast<double>(i) + done) / static_cast<double>(recipes.size()));
    };
    SceneRun scene(run, recipes[i], i, finest_times);
    if (auto done = scene.measure(go_on, result); !done) return done.error();
  }
  return result;
}

}  // namespace argil::evaluation
