// SPDX-License-Identifier: GPL-3.0-or-later
// How exact a whole surface is and what it costs: ours and OpenVDB's, on bodies whose distance is
// known.
#include "surface/rows.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "argil/core/hash.h"
#include "argil/engine/surface.h"

#include "chart/chart.h"
#include "common/machine.h"
#include "common/output.h"
#include "rivals/openvdb_mesh.h"
#include "rivals/whole_levels.h"
#include "scene/distance.h"
#include "scene/scene.h"

namespace argil::evaluation {
namespace {

constexpr std::size_t kRuns = 5;
/// Cuts keep so far from the ends of their edge, as a fraction of it (docs/surface.md).
constexpr double kCutClamp = 0.02;

/// A body at the finest voxel, off the lattice and askew to it.
struct Body {
  std::string scene;
  double detail = 0.0;
  double curvature_mm = 0.0;
  Distance distance;
  Box3 bounds_mm;
};

Body make_body(const std::string& scene, double detail) {
  constexpr double kTubeOfRing = 0.4;  // of the ring
  assert(detail > 0.0);
  // Off the lattice, so that no symmetry of the body is one of the lattice as well.
  const Vec3 center = kVoxelMm * Vec3{0.137, 0.291, 0.423};
  const double radius = kVoxelMm * detail;
  const bool is_ball = scene == "ball";
  const double tube = kTubeOfRing * radius;
  const Distance shape =
      is_ball ? ball(radius) : turned(normalized(Quat{0.9, 0.3, 0.25, 0.2}), torus(radius, tube));
  const double half = (is_ball ? radius : radius + tube) + 2.0 * kVoxelMm;
  const Vec3 corner{half, half, half};
  return {scene,
          detail,
          is_ball ? radius : tube,
          [=](const Vec3& p) { return shape(p - center); },
          {center - corner, center + corner}};
}

double median(std::array<double, kRuns> values) {
  std::sort(values.begin(), values.end());
  return values[kRuns / 2];
}

/// One run: the vertices, and what it took.
struct Extraction {
  std::vector<Vec3> positions;
  std::int64_t triangles = 0;
  double cpu_us = 0.0;
  double wall_us = 0.0;
};

Extraction extract(Mesher mesher, const Clay& clay) {
  if (mesher == Mesher::openvdb) {
    OpenvdbMesh mesh = openvdb_mesh(clay);
    return {std::move(mesh.positions), mesh.triangles, mesh.cpu_us, mesh.wall_us};
  }
  const cli::Stopwatch wall;
  const double before = cli::process_cpu_us();
  TriangleMesh mesh = extract_surface(clay);
  const double cpu_us = cli::process_cpu_us() - before;
  return {std::move(mesh.positions), static_cast<std::int64_t>(mesh.triangles.size()), cpu_us,
          1e6 * wall.seconds()};
}

VertexKind vertex_kind_of(const Vec3& p) {
  constexpr double kRounding = 1e-6;
  int on_lattice = 0;
  bool at_clamp = false;
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = p[a] / kVoxelMm;
    const double off = std::abs(at - std::round(at));
    if (off < kRounding) ++on_lattice;
    at_clamp |= std::abs(off - kCutClamp) < kRounding;
  }
  // A cut lies on an edge of the lattice: two of its coordinates are those of nodes.
  if (on_lattice < 2) return VertexKind::centre;
  return at_clamp ? VertexKind::clamped : VertexKind::cut;
}

void measure_errors(const Body& body, const std::vector<Vec3>& positions, SurfaceRow& row) {
  assert(!positions.empty() && body.curvature_mm > 0.0);
  // The error of a linear interpolation over a cell, but for a constant: in this unit a method of
  // second order is level.
  const double unit_mm = kVoxelMm * kVoxelMm / body.curvature_mm;
  double squares = 0.0;
  for (const Vec3& p : positions) {
    const double error = std::abs(body.distance(p)) / unit_mm;
    squares += error * error;
    row.error_max = std::max(row.error_max, error);
    const auto kind = static_cast<std::size_t>(vertex_kind_of(p));
    row.kind_error_max[kind] = std::max(row.kind_error_max[kind], error);
    row.kind_fraction[kind] += 1.0;
  }
  const auto count = static_cast<double>(positions.size());
  row.error_rms = std::sqrt(squares / count);
  for (double& fraction : row.kind_fraction) fraction /= count;
}

SurfaceRow measure_body(const Body& body, Mesher mesher, const Clay& clay) {
  SurfaceRow row;
  row.scene = body.scene;
  row.mesher = mesher;
  row.detail = body.detail;
  row.curvature_voxels = body.curvature_mm / kVoxelMm;
  std::array<double, kRuns> cpu_us{};
  std::array<double, kRuns> wall_us{};
  for (std::size_t run = 0; run < kRuns; ++run) {
    const Extraction made = extract(mesher, clay);
    cpu_us[run] = made.cpu_us;
    wall_us[run] = made.wall_us;
    // All runs give the same bits; the last is looked at.
    if (run + 1 < kRuns) continue;
    row.vertices = static_cast<std::int64_t>(made.positions.size());
    row.triangles = made.triangles;
    Hash64 hash;
    hash.update(std::as_bytes(std::span(made.positions)));
    row.hash = hash.digest();
    measure_errors(body, made.positions, row);
  }
  row.cpu_us = median(cpu_us);
  row.wall_us = median(wall_us);
  return row;
}

Result<void> measure_body(const Body& body, std::vector<SurfaceRow>& rows) {
  const Clay uniform = uniform_clay(body.distance, body.bounds_mm, kVoxelMm);
  rows.push_back(measure_body(body, Mesher::argil, uniform));
  rows.push_back(measure_body(body, Mesher::openvdb, uniform));
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  auto kept = Clay::from_distance(body.distance, body.bounds_mm, options);
  if (!kept) return kept.error();
  rows.push_back(measure_body(body, Mesher::adaptive, kept.value()));
  return {};
}

}  // namespace

const char* mesher_name(Mesher mesher) {
  switch (mesher) {
    case Mesher::argil:
      return "argil";
    case Mesher::openvdb:
      return "openvdb";
    case Mesher::adaptive:
      break;
  }
  return "argil_adaptive";
}

Result<std::vector<SurfaceRow>> measure_surface(bool quick, const Progress& progress) {
  const std::vector<int> details =
      quick ? std::vector<int>{16, 32, 64} : std::vector<int>{16, 32, 64, 128, 256};
  std::vector<SurfaceRow> rows;
  double done = 0.0;
  for (const char* scene : {"ball", "torus"}) {
    for (const int detail : details) {
      if (auto go = tell(progress, "extracting", done); !go) return go.error();
      if (auto measured = measure_body(make_body(scene, detail), rows); !measured) {
        return measured.error();
      }
      done += 0.5 / static_cast<double>(details.size());
    }
  }
  return rows;
}

std::string surface_csv(const std::vector<SurfaceRow>& rows) {
  std::string text =
      "# Extraction of a whole surface on " + cli::machine_name() +
      "; errors of vertices in h^2/R_curv, CPU time of all threads, median of 5 runs\n"
      "scene,mesher,detail,curvature_voxels,vertices,triangles,error_max,error_rms,"
      "error_max_voxels,cut_error_max,clamped_error_max,centre_error_max,clamped_share,"
      "centre_share,cpu_ms,cpu_us_per_vertex,wall_ms,hash\n";
  for (const SurfaceRow& row : rows) {
    text.append(row.scene).append(",").append(mesher_name(row.mesher));
    for (const double value : {row.detail, row.curvature_voxels}) {
      text.append(",").append(cli::number(value));
    }
    text.append(",").append(std::to_string(row.vertices));
    text.append(",").append(std::to_string(row.triangles));
    for (const double value : {row.error_max, row.error_rms, row.error_voxels()}) {
      text.append(",").append(cli::number(value));
    }
    const bool is_ours = row.mesher == Mesher::argil;
    for (const double value : {row.kind_error_max[0], row.kind_error_max[1], row.kind_error_max[2],
                               row.kind_fraction[1], row.kind_fraction[2]}) {
      text.append(",").append(is_ours ? cli::number(value) : "");
    }
    for (const double value : {1e-3 * row.cpu_us, row.cpu_us_per_vertex(), 1e-3 * row.wall_us}) {
      text.append(",").append(cli::number(value));
    }
    text.append(",").append(cli::hex(row.hash)).append("\n");
  }
  return text;
}

}  // namespace argil::evaluation
