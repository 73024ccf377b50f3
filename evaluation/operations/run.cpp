// SPDX-License-Identifier: GPL-3.0-or-later
// What is measured, in its order: sizes, bodies, methods, tasks. One method at a time holds a body.
#include "operations/run.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

#include "argil/core/no_throw.h"

#include "blender/made_mesh.h"
#include "chart/chart.h"
#include "common/output.h"

namespace argil::evaluation {
namespace {

double median_of_runs(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

class OperationsRun {
 public:
  OperationsRun(const OperationsOptions& options, const Progress& progress)
      : options_(options), progress_(progress) {
    const std::string obstacle = made_mesh_obstacle();
    if (!obstacle.empty()) result_.skipped.push_back(obstacle);
    methods_.push_back(argil_method());
    methods_.push_back(fine_argil_method());
    methods_.push_back(openvdb_method());
    methods_.push_back(cgal_method());
    if (obstacle.empty()) methods_.push_back(blender_method(progress));
  }

  Result<void> run() {
    for (const double million : options_.million) {
      for (const auto& make : {wavy_body, block_body}) {
        if (auto done = measure(make(million)); !done) return done;
      }
    }
    return {};
  }

  OperationsResult take() { return std::move(result_); }

 private:
  Result<void> measure(const WorkedBody& body) {
    for (const auto& method : methods_) {
      method->take(body);
      for (const Task task : kTasks) {
        if (auto done = measure(body, *method, task); !done) return done;
      }
    }
    // Levels need not stay while meshes are made.
    for (const auto& method : methods_) method->take(body);
    if (auto go = tell_next(body.name + ", meshes"); !go) return go;
    return measure_meshes_of_clay(body, options_.most_runs, result_);
  }

  Result<void> measure(const WorkedBody& body, OperationMethod& method, Task task) {
    if (auto go = tell_next(body.name + ", " + method.name() + " " + task_name(task)); !go) {
      return go;
    }
    if (method.most_million(task) == 0.0) return {};
    OperationRow row;
    row.operation = task_name(task);
    row.body = body.name;
    row.method = method.name();
    row.million = body.million;
    if (body.million > method.most_million(task)) {
      skip_row(row, "not run beyond " + cli::number(method.most_million(task)) + " million",
               result_);
      return {};
    }
    if (auto timed = time_runs(
            options_.most_runs,
            [&] { return no_throw(row.method, [&] { return method.run(task); }); }, row);
        !timed) {
      if (timed.error().kind == ErrorKind::interrupted) return timed;
      skip_row(row, timed.error().message, result_);
      return {};
    }
    const TriangleMesh made = method.result();
    describe_result(made, row);
    row.error = error_of(made, body, truth_of(task, body));
    result_.rows.push_back(std::move(row));
    return {};
  }

  /// A step of as many as there are: a method's tasks on each body, and the meshes of its clay.
  Result<void> tell_next(const std::string& what) {
    const std::size_t steps = 2 * options_.million.size() * (methods_.size() * kTasks.size() + 1);
    const double fraction = static_cast<double>(told_++) / static_cast<double>(steps);
    return tell(progress_, what, fraction);
  }

  const OperationsOptions& options_;
  const Progress& progress_;
  std::vector<std::unique_ptr<OperationMethod>> methods_;
  OperationsResult result_;
  std::size_t told_ = 0;
};

}  // namespace

Result<void> time_runs(int most, const std::function<Result<RunTime>()>& once, OperationRow& row) {
  constexpr double kEnoughS = 5.0;
  assert(most >= 1);
  std::vector<double> cpu_s;
  std::vector<double> wall_s;
  double all_s = 0.0;
  while (cpu_s.size() < static_cast<std::size_t>(most) && all_s < kEnoughS) {
    const auto time = once();
    if (!time) return time.error();
    cpu_s.push_back(time.value().cpu_s);
    wall_s.push_back(time.value().wall_s);
    all_s += time.value().cpu_s;
  }
  row.runs = static_cast<int>(cpu_s.size());
  const auto [least, most_s] = std::minmax_element(cpu_s.begin(), cpu_s.end());
  row.least_cpu_s = *least;
  row.most_cpu_s = *most_s;
  row.cpu_s = median_of_runs(cpu_s);
  row.wall_s = median_of_runs(wall_s);
  return {};
}

void skip_row(const OperationRow& row, const std::string& why, OperationsResult& result) {
  result.skipped.push_back(row.method + ", " + row.operation + ", " + row.body + " of " +
                           cli::number(row.million) + " million: " + why);
}

Result<OperationsResult> measure_operations(const OperationsOptions& options,
                                            const Progress& progress) {
  OperationsRun run(options, progress);
  if (auto done = run.run(); !done) return done.error();
  return run.take();
}

}  // namespace argil::evaluation
