// SPDX-License-Identifier: GPL-3.0-or-later
// What is lost when triangles are removed: ours, OpenMesh's and CGAL's, all held against the clay.
#include "chart/decimate_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "argil/core/hash.h"
#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/mesh_check.h"

#include "chart/decimate_pieces.h"
#include "chart/decimators/decimators.h"
#include "chart/machine.h"
#include "output.h"
#include "project.h"

namespace argil::cli::chart {
namespace {

constexpr std::array kShares{0.5, 0.3, 0.1, 0.03, 0.01};
constexpr std::array kDecimators{Decimator::argil, Decimator::openmesh, Decimator::cgal};

/// What is measured, and how often each time is taken.
struct Piece {
  std::string name;
  const Clay& clay;
  TriangleMesh surface;
  std::size_t runs;
};

Result<TriangleMesh> decimated(Decimator decimator, const Piece& piece, std::int64_t triangles) {
  if (decimator == Decimator::argil) {
    auto made = io::decimate(piece.surface, piece.clay, {triangles, 0.0});
    if (!made) return made.error();
    return std::move(made.value().mesh);
  }
  auto made = decimator == Decimator::openmesh ? openmesh_decimated(piece.surface, triangles)
                                               : cgal_decimated(piece.surface, triangles);
  if (made) return *std::move(made);
  return Error{ErrorKind::bad_input, "the surface is not two-manifold"};
}

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
  const io::MeshVerdict verdict = io::check_mesh(mesh);
  row.printable = verdict.printable;
  row.self_intersections = verdict.self_intersections;
  auto error = io::measure_error(mesh, piece.surface, piece.clay);
  if (!error) return error.error();
  row.error = error.value();
  return {};
}

Result<DecimateRow> measure_decimation(Decimator decimator, const Piece& piece, double share) {
  const auto all = static_cast<double>(piece.surface.triangles.size());
  // A closed surface has an even count.
  const std::int64_t asked = 2 * std::llround(0.5 * share * all);
  DecimateRow row;
  row.decimator = decimator;
  row.share = share;
  std::vector<double> cpu_s;
  TriangleMesh mesh;
  for (std::size_t run = 0; run < piece.runs; ++run) {
    const double before = process_cpu_us();
    auto made = decimated(decimator, piece, asked);
    cpu_s.push_back(1e-6 * (process_cpu_us() - before));
    if (!made) return made.error();
    mesh = std::move(made).value();
  }
  std::sort(cpu_s.begin(), cpu_s.end());
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
    for (const double share : kShares) {
      if (progress && !progress(name, done)) {
        return Error{ErrorKind::interrupted, "the chart was interrupted"};
      }
      auto row = measure_decimation(decimator, piece, share);
      done += 1.0 / (kShares.size() * kDecimators.size());
      if (row) {
        result.rows.push_back(std::move(row).value());
      } else if (row.error().kind == ErrorKind::bad_input) {
        result.skipped.push_back(name + ", " + decimator_name(decimator) + " to " +
                                 number(100.0 * share) + " %: " + row.error().message);
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
    case Decimator::none:
      break;
  }
  return "none";
}

double DecimateRow::mean_voxels() const noexcept {
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
  auto opened = open_project(project, progress);
  if (!opened) return opened.error();
  const std::string name = project.stem().string();
  if (auto measured = measure_piece(name, opened.value().clay, runs, progress, result); !measured) {
    return measured.error();
  }
  return result;
}

std::string decimate_csv(const std::vector<DecimateRow>& rows) {
  std::string text =
      "# Removal of triangles on " + machine_name() +
      "; errors against the clay's field in finest voxels; CPU time of all threads, median of the "
      "runs; share 1 is the whole surface\n"
      "piece,decimator,share,triangles,mean_to_field,rms_to_field,max_to_field,mean_to_mesh,"
      "rms_to_mesh,max_to_mesh,printable,self_intersections,cpu_s,hash\n";
  for (const DecimateRow& row : rows) {
    text.append(row.piece).append(",").append(decimator_name(row.decimator));
    text.append(",").append(number(row.share)).append(",").append(std::to_string(row.triangles));
    for (const io::DistanceSummary& way : {row.error.mesh_to_field, row.error.field_to_mesh}) {
      for (const double mm : {way.mean_mm, way.rms_mm, way.max_mm}) {
        text.append(",").append(number(mm / row.voxel_mm));
      }
    }
    text.append(row.printable ? ",yes," : ",no,").append(std::to_string(row.self_intersections));
    text.append(",").append(number(row.cpu_s)).append(",").append(hex(row.hash)).append("\n");
  }
  return text;
}

}  // namespace argil::cli::chart
