// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"

#include "force/query.h"
#include "force/row.h"

namespace argil::evaluation {

enum class ToolKind { ball, ellipsoid };

/// Times of the methods that read the finest lattice, by tool, radius, method and exponent.
using FinestTimes = std::map<std::string, std::vector<double>>;

/// Errors of forces smaller than this fraction of f_c0 are relative to it, so that a force near
/// zero does not count as wholly wrong.
inline constexpr double kFloorFraction = 0.05;

/// Radii, in finest voxels, of the balls whose windows are timed.
inline constexpr std::array kWindowRadii{4, 16, 64};

/// What a method should have answered: each law is judged by its own integral.
const Wrench& truth_for(const Method& method, const Reference& reference, std::size_t exponent);

/// The largest relative change of the reference force with half as many nodes again along each
/// axis; 0 where it was not checked.
struct ReferenceChange {
  double energy = 0.0;
  double blanch = 0.0;
};

/// One scene, one tool, one radius: what every method answers there.
class ForceStation {
 public:
  ForceStation(const Scene& scene, const SceneRecipe& recipe, ToolKind tool, int radius_voxels,
               bool quick, unsigned long seed);

  /// Times stencils and `fine` on the finest lattice, which is laid out whole for it.
  void time_finest_lattice(FinestTimes& times);

  /// Errors, ripple and times of all methods; those on the finest lattice take their times from
  /// `finest_times`.
  Result<std::vector<ForceRow>> measure(const FinestTimes& finest_times);

  const ReferenceChange& reference_change() const { return reference_change_; }

 private:
  struct Path;

  haptics::ForceTool shape() const;
  haptics::ForceMaterial material(std::size_t exponent) const;
  std::vector<ForceRow> empty_rows() const;
  std::string time_key(const Method& method, std::size_t exponent) const;
  haptics::ForceTool pose_at(double depth, Vec3& normal);
  int poses_per_depth() const;
  int reference_across() const;
  void note_centre(const Answer& answer, std::size_t row, std::vector<ForceRow>& rows) const;
  Result<void> measure_pose(double depth, bool is_first, std::vector<ForceRow>& rows);
  Answer timed_answer(const Query& query, const Method& method, const FieldWindowView* window,
                      const haptics::ForceTool& pose, Tally& tally) const;
  Result<void> measure_ripple(std::vector<ForceRow>& rows);
  Result<void> time_windows(std::vector<ForceRow>& rows);
  Result<void> slide(std::size_t method, Path& path, std::span<ForceRow> rows) const;
  void check_reference(const haptics::ForceTool& pose, const Reference& reference);

  const Scene& scene_;
  const SceneRecipe& recipe_;
  ToolKind tool_;
  int radius_voxels_;
  double radius_mm_;
  bool quick_;
  Random random_;
  std::vector<Method> methods_;
  std::vector<Query> queries_;  ///< a method's exponents side by side, as the rows
  ReferenceChange reference_change_;
};

}  // namespace argil::evaluation
