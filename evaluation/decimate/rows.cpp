// SPDX-License-Identifier: GPL-3.0-or-later
// What is lost when triangles are removed: ours, OpenMesh's and CGAL's, all held against the clay.
#include "decimate/rows.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "argil/core/hash.h"
#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/measure_error.h"
#include "argil/mesh/check.h"

#include "chart/chart.h"
#include "common/machine.h"
#include "common/output.h"
#include "common/project.h"
#include "decimate/pieces.h"
#include "rivals/decimators.h"

namespace argil::evaluation {
namespace {

/// Of the triangles of the whole surface that are left.
constexpr std::array kFractions{0.5, 0.3, 0.1, 0.03, 0.01};
constexpr std::array kDecimators{Decimator::argil, Decimator::openmesh, Decimator::cgal};

/// What is measured, and how often each time is taken.
struct Piece {
  std::string name;
  const Clay& clay;
  TriangleMesh surface;
  std::size_t runs;
};

std::uint64_t hash_of(const TriangleMesh& mesh) {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(mesh.positions)));
  hash.update(std::as_bytes(std::span(mesh.triangles)));
  return hash.digest();
}

/// The columns that tell of a mesh.
Result<void> describe_mesh(const TriangleMesh& mesh, const Piece& piece, DecimateRow& row) {
  row.piece = piece.name;
  row.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  row.voxel_mm = piece.clay.options().voxel_mm;
  row.hash = hash_of(mesh);
  const mesh::MeshVerdict verdict = mesh::check_mesh(mesh);
  row.printable = verdict.printable;
  row.self_intersections = verdict.self_intersections;
  auto error = io::measure_error(mesh, piece.surface, piece.clay);
  if (!error) return error.error();
  row.error = error.value();
  return {};
}

Result<DecimateRow> measure_decimation(Decimator decimator, const Piece& piece, double fraction) {
  assert(fraction > 0.0 && fraction < 1.0 && piece.runs > 0);
  const auto all = static_cast<double>(piece.surface.triangles.size());
  // A closed surface has an even count.
  const std::int64_t asked = 2 * std::llround(0.5 * fraction * all);
  DecimateRow row;
  row.decimator = decimator;
  row.fraction = fraction;
  std::vector<double> cpu_s;
  TriangleMesh mesh;
  for (std::size_t run = 0; run < piece.runs; ++run) {
    // Time of the processor, not of the clock: runs beside others, on any number of
    // threads, compare.
    const double before = cli::process_cpu_us();
    auto made = decimated(decimator, piece.clay, piece.surface, asked);
    cpu_s.push_back(1e-6 * (cli::process_cpu_us() - before));
    if (!made) return made.error();
    mesh = std::move(made).value();
  }
  std::sort(cpu_s.begin(), cpu_s.end());
  // The median, which a run that was disturbed does not move.
  row.cpu_s = cpu_s[cpu_s.size() / 2];
  if (auto described = describe_mesh(mesh, piece, row); !described) return described.error();
  return row;
}

Result<void> measure_piece(const std::string& name, const Clay& clay, std::size_t runs,
                           const Progress& progress, DecimateResult& result) {
  Piece piece{name, clay, extract_surface(clay), runs};
  piece.surface.normals.clear();
  DecimateRow whole;
  if (auto described = describe_mesh(piece.surface, piece, whole); !described) return described;
  result.rows.push_back(whole);
  double done = 0.0;
  for (const Decimator decimator : kDecimators) {
    for (const double fraction : kFractions) {
      if (auto go = tell(progress, name, done); !go) return go;
      auto row = measure_decimation(decimator, piece, fraction);
      done += 1.0 / (kFractions.size() * kDecimators.size());
      if (row) {
        result.rows.push_back(std::move(row).value());
      } else if (row.error().kind == ErrorKind::bad_input) {
        result.skipped.push_back(name + ", " + decimator_name(decimator) + " to " +
                                 cli::number(100.0 * fraction) + " %: " + row.error().message);
      } else {
        return row.error();
      }
    }
  }
  return {};
}

}  // namespace

const char* decimator_name(Decimator decimator) {
  switch (decimator) {
    case Decimator::argil:
      return "argil";
    case Decimator::openmesh:
      return "openmesh";
    case Decimator::cgal:
      return "cgal";
    case Decimator::meshoptimizer:
      return "meshoptimizer";
    case Decimator::none:
      break;
  }
  return "none";
}

Result<TriangleMesh> decimated(Decimator decimator, const Clay& clay, const TriangleMesh& surface,
                               std::int64_t triangles) {
  assert(decimator != Decimator::none);
  if (decimator == Decimator::argil) {
    auto made = io::decimate(surface, clay, {triangles, 0.0});
    if (!made) return made.error();
    return std::move(made.value().mesh);
  }
  if (decimator == Decimator::meshoptimizer) {
    if (has_meshoptimizer()) return meshoptimizer_decimated(surface, triangles);
    return Error{ErrorKind::bad_input,
                 "Argil was built without meshoptimizer; remedy: install libmeshoptimizer-dev, and "
                 "build it again"};
  }
  auto made = decimator == Decimator::openmesh ? openmesh_decimated(surface, triangles)
                                               : cgal_decimated(surface, triangles);
  if (made) return *std::move(made);
  return Error{ErrorKind::bad_input, "the surface is not two-manifold"};
}

double DecimateRow::mean_voxels() const noexcept {
  assert(voxel_mm > 0.0);
  return std::max(error.mesh_to_field.mean_mm, error.field_to_mesh.mean_mm) / voxel_mm;
}

Result<DecimateResult> measure_decimate(bool quick, const std::filesystem::path& project,
                                        const Progress& progress) {
  const std::size_t runs = quick ? 1 : 3;
  DecimateResult result;
  const auto add = [&](const std::string& name, const Result<Clay>& clay) -> Result<void> {
    if (!clay) return clay.error();
    return measure_piece(name, clay.value(), runs, progress, result);
  };
  if (auto added = add("wavy ball", wavy_ball(quick ? 24.0 : 64.0)); !added) return added.error();
  if (auto added = add("block", sculpted_block(quick ? 30.0 : 60.0)); !added) {
    return added.error();
  }
  if (project.empty()) return result;
  auto opened = cli::open_clay(project, "", progress);
  if (!opened) return opened.error();
  const std::string name = project.stem().string();
  if (auto measured = measure_piece(name, opened.value().clay, runs, progress, result); !measured) {
    return measured.error();
  }
  return result;
}

std::string decimate_csv(const std::vector<DecimateRow>& rows) {
  std::string text =
      "# Removal of triangles on " + cli::machine_name() +
      "; errors against the clay's field in finest voxels; CPU time of all threads, median of the "
      "runs; share 1 is the whole surface\n"
      "piece,decimator,share,triangles,mean_to_field,rms_to_field,max_to_field,mean_to_mesh,"
      "rms_to_mesh,max_to_mesh,printable,self_intersections,cpu_s,hash\n";
  for (const DecimateRow& row : rows) {
    text.append(row.piece).append(",").append(decimator_name(row.decimator));
    text.append(",")
        .append(cli::number(row.fraction))
        .append(",")
        .append(std::to_string(row.triangles));
    for (const mesh::DistanceSummary& direction :
         {row.error.mesh_to_field, row.error.field_to_mesh}) {
      for (const double mm : {direction.mean_mm, direction.rms_mm, direction.max_mm}) {
        text.append(",").append(cli::number(mm / row.voxel_mm));
      }
    }
    text.append(row.printable ? ",yes," : ",no,").append(std::to_string(row.self_intersections));
    text.append(",")
        .append(cli::number(row.cpu_s))
        .append(",")
        .append(cli::hex(row.hash))
        .append("\n");
  }
  return text;
}

}  // namespace argil::evaluation
