// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of a clay: fewer triangles, by those whom `argil chart decimate` compares, and files. Held
// against the clay itself, both ways.
#include <cmath>
#include <cstdint>
#include <utility>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"
#include "argil/io/export.h"
#include "argil/io/measure_error.h"

#include "common/output.h"
#include "common/scratch_folder.h"
#include "decimate/rows.h"
#include "operations/run.h"

namespace argil::evaluation {
namespace {

constexpr double kLeftShare = 0.1;  // of the triangles

/// The largest body, in million vertices, for which one ends in a minute or so.
double most_million(Decimator decimator) {
  return decimator == Decimator::argil || decimator == Decimator::meshoptimizer ? 10.0 : 0.6;
}

class MeshesOfClay {
 public:
  MeshesOfClay(const WorkedBody& body, const Clay& clay, int most_runs, OperationsResult& result)
      : body_(body), clay_(clay), most_runs_(most_runs), result_(result) {}

  Result<void> decimate(Decimator decimator, const TriangleMesh& surface) {
    OperationRow row = row_of("decimate", decimator_name(decimator));
    if (body_.million > most_million(decimator)) {
      skip_row(row, "not run beyond " + cli::number(most_million(decimator)) + " million", result_);
      return {};
    }
    // A closed surface has an even count.
    const std::int64_t asked =
        2 * std::llround(0.5 * kLeftShare * static_cast<double>(surface.triangles.size()));
    TriangleMesh made;
    const auto once = [&]() -> Result<RunTime> {
      const RunClock clock;
      auto mesh = decimated(decimator, clay_, surface, asked);
      const RunTime time = clock.read();
      if (!mesh) return mesh.error();
      made = std::move(mesh).value();
      return time;
    };
    if (auto timed = time_runs(most_runs_, once, row); !timed) {
      if (timed.error().kind == ErrorKind::interrupted) return timed;
      skip_row(row, timed.error().message, result_);
      return {};
    }
    auto error = io::measure_error(made, surface, clay_);
    if (!error) return error.error();
    row.error.rms = error.value().rms_mm() / kVoxelMm;
    row.error.max = error.value().max_mm() / kVoxelMm;
    describe_result(made, row);
    result_.rows.push_back(std::move(row));
    return {};
  }

  /// `ending`: "stl".
  Result<void> write(const std::string& ending, const TriangleMesh& surface) {
    const auto scratch = cli::ScratchFolder::make();
    if (!scratch) return scratch.error();
    OperationRow row = row_of("export " + ending, "argil");
    io::ExportReport report;
    const auto once = [&]() -> Result<RunTime> {
      const RunClock clock;
      auto written = io::export_mesh(scratch.value() / ("body." + ending), clay_);
      const RunTime time = clock.read();
      if (!written) return written.error();
      report = std::move(written).value();
      return time;
    };
    if (auto timed = time_runs(most_runs_, once, row); !timed) return timed;
    row.error.rms = report.rms_error_mm / kVoxelMm;
    row.error.max = report.max_error_mm / kVoxelMm;
    describe_result(surface, row);
    result_.rows.push_back(std::move(row));
    return {};
  }

 private:
  OperationRow row_of(const std::string& operation, const std::string& method) const {
    OperationRow row;
    row.operation = operation;
    row.body = body_.name;
    row.method = method;
    row.million = body_.million;
    return row;
  }

  const WorkedBody& body_;
  const Clay& clay_;
  int most_runs_;
  OperationsResult& result_;
};

}  // namespace

Result<void> measure_meshes_of_clay(const WorkedBody& body, int most_runs,
                                    OperationsResult& result) {
  auto imported = clay_of(body, ClayOptions{}.tolerance_voxels);
  if (!imported) return imported.error();
  const Clay& clay = imported.value();
  TriangleMesh surface = extract_surface(clay);
  surface.normals.clear();
  MeshesOfClay meshes(body, clay, most_runs, result);
  for (const Decimator decimator :
       {Decimator::argil, Decimator::openmesh, Decimator::cgal, Decimator::meshoptimizer}) {
    if (auto done = meshes.decimate(decimator, surface); !done) return done;
  }
  for (const char* ending : {"stl", "3mf"}) {
    if (auto done = meshes.write(ending, surface); !done) return done;
  }
  return {};
}

}  // namespace argil::evaluation
