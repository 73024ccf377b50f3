// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

#include "common/machine.h"
#include "common/output.h"
#include "operations/body.h"
#include "operations/truth.h"
#include "scene/scene.h"

namespace argil::evaluation {

/// What is done to a body, in this order: the others begin with what the import made.
enum class Task { import, outward, inward, deep_inward, unite, resample, hollow };
inline constexpr std::array kTasks{Task::import, Task::outward,  Task::inward, Task::deep_inward,
                                   Task::unite,  Task::resample, Task::hollow};
/// As it stands in the table: "offset +2".
const char* task_name(Task task);

inline constexpr double kNearMm = 2.0 * kVoxelMm;       ///< of `outward` and `inward`
inline constexpr double kDeepMm = 8.0 * kVoxelMm;       ///< of `deep_inward`
inline constexpr double kWallMm = 8.0 * kVoxelMm;       ///< of `hollow`
inline constexpr double kResampledMm = 1.3 * kVoxelMm;  ///< of `resample`

/// How far an offset goes, outward positive.
double offset_mm(Task task);

Truth truth_of(Task task, const WorkedBody& body);

/// CPU time of all threads, and of the clock.
struct RunTime {
  double cpu_s = 0.0;
  double wall_s = 0.0;
};

/// Runs from when it is made.
class RunClock {
 public:
  RunTime read() const { return {1e-6 * (cli::process_cpu_us() - cpu_us_), wall_.seconds()}; }

 private:
  double cpu_us_ = cli::process_cpu_us();
  cli::Stopwatch wall_;
};

/// What does the tasks: ours or a rival.
class OperationMethod {
 public:
  OperationMethod() = default;
  OperationMethod(const OperationMethod&) = delete;
  OperationMethod& operator=(const OperationMethod&) = delete;
  virtual ~OperationMethod() = default;

  virtual const char* name() const = 0;
  /// The largest body, in million vertices, for which a task ends in a minute or so; 0 where it has
  /// nothing of the kind.
  virtual double most_million(Task task) const = 0;
  /// The next tasks are on this body, which outlives them.
  virtual void take(const WorkedBody& body) = 0;
  /// Once, and what it took: copies that leave the body for the next run do not count.
  /// Errors  interrupted; anything else is told, and the rest is measured.
  virtual Result<RunTime> run(Task task) = 0;
  /// Of the last run, as triangles.
  virtual TriangleMesh result() = 0;
};

/// The body as clay, with edges as sharp as its voxels allow.
/// Errors  as import_mesh.
Result<Clay> clay_of(const WorkedBody& body, double tolerance_voxels);

/// Clay, as coarse as the usual tolerance allows (ClayOptions), and with the least tolerance.
std::unique_ptr<OperationMethod> argil_method();
std::unique_ptr<OperationMethod> fine_argil_method();
/// Level sets of half width 3 (rivals/openvdb_levels.h).
std::unique_ptr<OperationMethod> openvdb_method();
/// alpha_wrap_3 for the import, corefinement for the union, from mesh to mesh.
std::unique_ptr<OperationMethod> cgal_method();
/// The voxel remesher for the import, the modifier Boolean for the union, of which the operator
/// alone is timed.
std::unique_ptr<OperationMethod> blender_method(const Progress& progress);

}  // namespace argil::evaluation
