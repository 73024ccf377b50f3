// SPDX-License-Identifier: GPL-3.0-or-later
// How exact a whole surface is and what it costs: ours, OpenVDB's and Blender's, on bodies whose
// distance is known.
#include "surface/rows.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <utility>

#include "argil/core/hash.h"
#include "argil/engine/surface.h"

#include "blender/made_mesh.h"
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

/// One run: the mesh, and what it took.
struct Extraction {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  double cpu_us = 0.0;
  double wall_us = 0.0;
};

Extraction extract(Mesher mesher, const Clay& clay) {
  if (mesher == Mesher::openvdb) {
    OpenvdbMesh mesh = openvdb_mesh(clay);
    return {std::move(mesh.positions), std::move(mesh.triangles), mesh.cpu_us, mesh.wall_us};
  }
  const cli::Stopwatch wall;
  const double before = cli::process_cpu_us();
  TriangleMesh mesh = extract_surface(clay);
  const double cpu_us = cli::process_cpu_us() - before;
  return {std::move(mesh.positions), std::move(mesh.triangles), cpu_us, 1e6 * wall.seconds()};
}

VertexKind vertex_kind_of(const Vec3& p) {
  constexpr double kRounding = 1e-6;
  int on_lattice = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = p[a] / kVoxelMm;
    if (std::abs(at - std::round(at)) < kRounding) ++on_lattice;
  }
  // On an edge of the lattice two coordinates are those of nodes.
  return on_lattice < 2 ? VertexKind::off_edge : VertexKind::on_edge;
}

/// The least angle of a triangle, degrees.
double least_angle_deg(const std::array<Vec3, 3>& corners) {
  double largest_cosine = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = normalized(corners[(i + 1) % 3] - corners[i]);
    const Vec3 b = normalized(corners[(i + 2) % 3] - corners[i]);
    largest_cosine = std::max(largest_cosine, dot(a, b));
  }
  return std::acos(std::min(1.0, largest_cosine)) * 180.0 / std::numbers::pi;
}

void measure_triangles(const Extraction& made, SurfaceRow& row) {
  constexpr double kSliverDeg = 5.0;
  row.least_angle_deg = 180.0;
  for (const Triangle& t : made.triangles) {
    const double angle =
        least_angle_deg({made.positions[t[0]], made.positions[t[1]], made.positions[t[2]]});
    row.least_angle_deg = std::min(row.least_angle_deg, angle);
    if (angle < kSliverDeg) row.sliver_fraction += 1.0;
  }
  row.sliver_fraction /= static_cast<double>(made.triangles.size());
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
    if (kind == static_cast<std::size_t>(VertexKind::off_edge)) row.off_edge_fraction += 1.0;
  }
  const auto count = static_cast<double>(positions.size());
  row.error_rms = std::sqrt(squares / count);
  row.off_edge_fraction /= count;
}

SurfaceRow row_of(const Body& body, Mesher mesher) {
  SurfaceRow row;
  row.scene = body.scene;
  row.mesher = mesher;
  row.detail = body.detail;
  row.curvature_voxels = body.curvature_mm / kVoxelMm;
  return row;
}

void look_at(const Body& body, const Extraction& made, SurfaceRow& row) {
  row.vertices = static_cast<std::int64_t>(made.positions.size());
  row.triangles = static_cast<std::int64_t>(made.triangles.size());
  Hash64 hash;
  hash.update(std::as_bytes(std::span(made.positions)));
  row.hash = hash.digest();
  measure_errors(body, made.positions, row);
  measure_triangles(made, row);
}

SurfaceRow measure_clay(const Body& body, Mesher mesher, const Clay& clay) {
  SurfaceRow row = row_of(body, mesher);
  std::array<double, kRuns> cpu_us{};
  std::array<double, kRuns> wall_us{};
  for (std::size_t run = 0; run < kRuns; ++run) {
    const Extraction made = extract(mesher, clay);
    cpu_us[run] = made.cpu_us;
    wall_us[run] = made.wall_us;
    // All runs give the same bits; the last is looked at.
    if (run + 1 == kRuns) look_at(body, made, row);
  }
  row.cpu_us = median(cpu_us);
  row.wall_us = median(wall_us);
  return row;
}

/// Another program's trouble is told and leaves the rest as it is.
Result<void> measure_blender(const Body& body, const Clay& clay, const Progress& progress,
                             SurfaceResult& result) {
  auto made = blender_remesh(extract_surface(clay), kVoxelMm, kRuns, progress);
  if (!made && made.error().kind != ErrorKind::internal) return made.error();
  if (!made) {
    result.skipped.push_back("blender_remesh, " + body.scene + ", R/h " + cli::number(body.detail) +
                             ": " + made.error().message);
    return {};
  }
  BlenderMesh& remesh = made.value();
  SurfaceRow row = row_of(body, Mesher::blender);
  row.cpu_us = remesh.cpu_us;
  row.wall_us = remesh.wall_us;
  look_at(body, {std::move(remesh.positions), std::move(remesh.triangles), 0.0, 0.0}, row);
  result.rows.push_back(row);
  return {};
}

Result<void> measure_body(const Body& body, bool has_blender, const Progress& progress,
                          SurfaceResult& result) {
  const Clay uniform = uniform_clay(body.distance, body.bounds_mm, kVoxelMm);
  result.rows.push_back(measure_clay(body, Mesher::argil, uniform));
  result.rows.push_back(measure_clay(body, Mesher::openvdb, uniform));
  if (has_blender) {
    if (auto done = measure_blender(body, uniform, progress, result); !done) return done;
  }
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  auto kept = Clay::from_distance(body.distance, body.bounds_mm, options);
  if (!kept) return kept.error();
  result.rows.push_back(measure_clay(body, Mesher::adaptive, kept.value()));
  return {};
}

}  // namespace

const char* mesher_name(Mesher mesher) {
  switch (mesher) {
    case Mesher::argil:
      return "argil";
    case Mesher::openvdb:
      return "openvdb";
    case Mesher::blender:
      return "blender_remesh";
    case Mesher::adaptive:
      break;
  }
  return "argil_adaptive";
}

Result<SurfaceResult> measure_surface(bool quick, const Progress& progress) {
  const std::vector<int> details =
      quick ? std::vector<int>{16, 32, 64} : std::vector<int>{16, 32, 64, 128, 256};
  SurfaceResult result;
  const std::string obstacle = made_mesh_obstacle();
  if (!obstacle.empty()) result.skipped.push_back(obstacle);
  double done = 0.0;
  for (const char* scene : {"ball", "torus"}) {
    for (const int detail : details) {
      if (auto go = tell(progress, "extracting", done); !go) return go.error();
      if (auto measured =
              measure_body(make_body(scene, detail), obstacle.empty(), progress, result);
          !measured) {
        return measured.error();
      }
      done += 0.5 / static_cast<double>(details.size());
    }
  }
  return result;
}

std::string surface_csv(const std::vector<SurfaceRow>& rows) {
  std::string text =
      "# Extraction of a whole surface on " + cli::machine_name() +
      "; errors of vertices in h^2/R_curv, CPU time of all threads, median of 5 runs (of Blender, "
      "as many as 2 s hold)\n"
      "scene,mesher,detail,curvature_voxels,vertices,triangles,error_max,error_rms,"
      "error_max_voxels,on_edge_error_max,off_edge_error_max,off_edge_share,least_angle_deg,"
      "sliver_share,cpu_ms,cpu_us_per_vertex,wall_ms,hash\n";
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
    for (const double value :
         {row.kind_error_max[0], row.kind_error_max[1], row.off_edge_fraction}) {
      text.append(",").append(is_ours ? cli::number(value) : "");
    }
    for (const double value : {row.least_angle_deg, row.sliver_fraction}) {
      text.append(",").append(cli::number(value));
    }
    for (const double value : {1e-3 * row.cpu_us, row.cpu_us_per_vertex(), 1e-3 * row.wall_us}) {
      text.append(",").append(cli::number(value));
    }
    text.append(",").append(cli::hex(row.hash)).append("\n");
  }
  return text;
}

}  // namespace argil::evaluation
