// SPDX-License-Identifier: GPL-3.0-or-later
// How true real meshes come through: read, scaled, closed, imported, extracted; then the distance
// of every vertex of the file to the surface that came out.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/import.h"
#include "argil/engine/mesh_distance.h"
#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

#include "support/effort.h"
#include "support/measure/solid_winding.h"
#include "support/models.h"

namespace argil {
namespace {

constexpr double kSizeMm = 80.0;
const double kImportVoxelMm = test::effort(0.4, 0.25);
const std::size_t kStride = test::effort(8U, 1U);  // of so many vertices one is measured
constexpr double kThinGapVoxels = 0.5;             // beyond what a right-angled edge has

struct Model {
  const char* file;
  double max_voxels;  ///< at sharp edges; 1 elsewhere
  // Of all vertices:
  std::size_t thin_allowed;    ///< on tips thinner than two voxels, farther than max_voxels
  std::size_t buried_allowed;  ///< within the solid
};

std::ostream& operator<<(std::ostream& out, const Model& model) { return out << model.file; }

/// Scaled so that the largest side of the bounds is kSizeMm.
TriangleMesh sized(TriangleMesh mesh) {
  const Vec3 size = bounds(mesh).size();
  const double scale = kSizeMm / std::max({size.x, size.y, size.z});
  for (Vec3& p : mesh.positions) p *= scale;
  return mesh;
}

std::vector<std::uint32_t> used_vertices(const TriangleMesh& mesh) {
  std::set<std::uint32_t> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  return {used.begin(), used.end()};
}

/// How far a point is from all balls of two voxels across that fit into the solid, in voxels: 0 on
/// a smooth surface, 0.41 on a right-angled edge, much on a tip or sheet thinner than two voxels.
double gap_to_balls(const MeshDistance& input, const test::SolidWinding& winding, const Vec3& p) {
  constexpr int kReach = 16;  // quarters of a voxel
  const double step = 0.25 * kImportVoxelMm;
  double nearest = kReach * step;
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      for (int k = -kReach; k <= kReach; ++k) {
        const Vec3 offset{i * step, j * step, k * step};
        if (length(offset) >= nearest || length(offset) < 0.98 * kImportVoxelMm) continue;
        if (input.closest(p + offset, kImportVoxelMm).distance < 0.98 * kImportVoxelMm) continue;
        if (winding.at(p + offset) > 0.5) nearest = length(offset);
      }
    }
  }
  return nearest / kImportVoxelMm - 1.0;
}

/// Whether both sides of the surface are the solid's: a wall between overlapping parts.
bool is_buried(const test::SolidWinding& winding, const Vec3& p) {
  const double around = 0.1 * kImportVoxelMm;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 offset{(corner & 1) != 0 ? around : -around, (corner & 2) != 0 ? around : -around,
                      (corner & 4) != 0 ? around : -around};
    if (winding.at(p + offset) <= 0.5) return false;
  }
  return true;
}

/// Vertices of edges whose faces turn by more than 30 degrees.
std::vector<char> sharp_vertices(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> first;
  std::vector<char> sharp(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3 n = normalized(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax(t[i], t[(i + 1) % 3]);
      const auto [at, fresh] = first.try_emplace(edge, n);
      if (!fresh && dot(at->second, n) < std::sqrt(0.75)) sharp[t[i]] = sharp[t[(i + 1) % 3]] = 1;
    }
  }
  return sharp;
}

/// Places on the rims of the holes, close enough together to measure a distance to them.
std::vector<Vec3> rim_places(const TriangleMesh& mesh) {
  std::vector<Vec3> positions = mesh.positions;
  const std::vector<Triangle> cones = boundary_cones(positions, mesh.triangles);
  std::vector<Vec3> places;
  for (const Triangle& t : cones) {
    for (int i = 0; i <= 4; ++i) {
      const double s = 0.25 * i;
      places.push_back(positions[t[0]] * (1.0 - s) + positions[t[1]] * s);
    }
  }
  return places;
}

double nearest(const std::vector<Vec3>& places, const Vec3& p) {
  double best = 1e300;
  for (const Vec3& q : places) best = std::min(best, length(q - p));
  return best;
}

struct Outcome {
  std::vector<double> clear;  ///< sorted: vertices away from all below
  std::vector<double> sharp;  ///< sorted: at sharp edges, neither thin nor buried
  double max_all = 0.0;
  std::size_t thin = 0;
  std::size_t buried = 0;
};

void print(const char* what, const Vec3& p, double voxels) {
  std::cout << "  " << what << " at " << p.x << ' ' << p.y << ' ' << p.z << " mm: " << voxels
            << " voxels\n";
}

Outcome measure(const TriangleMesh& input, const TriangleMesh& solid, const TriangleMesh& surface,
                double max_voxels) {
  const MeshDistance to_surface(surface.positions, surface.triangles);
  const MeshDistance to_input(input.positions, input.triangles);
  const test::SolidWinding winding(solid);
  const std::vector<Vec3> rims = rim_places(input);
  const std::vector<char> sharp = sharp_vertices(input);
  Outcome out;
  const std::vector<std::uint32_t> vertices = used_vertices(input);
  for (std::size_t n = 0; n < vertices.size(); n += kStride) {
    const std::uint32_t v = vertices[n];
    const Vec3& p = input.positions[v];
    const double voxels = to_surface.closest(p, kSizeMm).distance / kImportVoxelMm;
    out.max_all = std::max(out.max_all, voxels);
    if (is_buried(winding, p)) {
      ++out.buried;
    } else if (voxels > max_voxels && gap_to_balls(to_input, winding, p) > kThinGapVoxels) {
      ++out.thin;
      print("thin", p, voxels);
    } else if (nearest(rims, p) > 2.0 * kImportVoxelMm) {
      if (voxels > max_voxels) print("far", p, voxels);
      (sharp[v] != 0 ? out.sharp : out.clear).push_back(voxels);
    }
  }
  std::sort(out.clear.begin(), out.clear.end());
  std::sort(out.sharp.begin(), out.sharp.end());
  return out;
}

/// The share of what is allowed among all vertices that falls to those measured.
std::size_t of_measured(std::size_t allowed) { return (allowed + kStride - 1) / kStride; }

double part(const std::vector<double>& sorted, std::size_t percent) {
  return sorted[(sorted.size() - 1) * percent / 100];
}

bool is_closed(const TriangleMesh& mesh) {
  std::vector<Vec3> positions = mesh.positions;
  return !mesh.triangles.empty() && boundary_cones(positions, mesh.triangles).empty();
}

void expect_within_a_voxel(const Model& model) {
  ARGIL_MODEL_OR_SKIP(path, model.file);
  const auto read = io::read_mesh(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const TriangleMesh input = sized(read.value());
  const auto closed = mesh::close_mesh(input);
  ASSERT_TRUE(closed.ok()) << closed.error().message;
  EXPECT_TRUE(closed.value().report.closed);
  const auto imported = import_mesh(closed.value().mesh, {kImportVoxelMm, 0.1});
  ASSERT_TRUE(imported.ok()) << imported.error().message;
  const TriangleMesh surface = extract_surface(imported.value().clay);
  EXPECT_TRUE(is_closed(surface));
  const Outcome out = measure(input, closed.value().mesh, surface, model.max_voxels);
  ASSERT_FALSE(out.clear.empty());
  std::vector<double> both = out.clear;
  both.insert(both.end(), out.sharp.begin(), out.sharp.end());
  std::sort(both.begin(), both.end());
  const double max_sharp = out.sharp.empty() ? 0.0 : out.sharp.back();
  std::cout << "  " << model.file << ": p50 " << part(out.clear, 50) << ", p99 "
            << part(out.clear, 99) << ", max " << out.clear.back() << " voxels; sharp edges "
            << max_sharp << ", with them p99 " << part(both, 99) << " (" << out.sharp.size()
            << " vertices); " << out.thin << " thin, " << out.buried << " buried; max of all "
            << out.max_all << '\n';
  EXPECT_LE(part(out.clear, 99), 0.25);
  EXPECT_LE(out.clear.back(), 1.0);
  EXPECT_LE(max_sharp, model.max_voxels);
  EXPECT_LE(out.thin, of_measured(model.thin_allowed));
  EXPECT_LE(out.buried, of_measured(model.buried_allowed));
}

class ImportModels : public ::testing::TestWithParam<Model> {};
class ImportModelsSlow : public ::testing::TestWithParam<Model> {};

TEST_P(ImportModels, ComeThroughWithinAVoxel) { expect_within_a_voxel(GetParam()); }
TEST_P(ImportModelsSlow, ComeThroughWithinAVoxel) { expect_within_a_voxel(GetParam()); }

/// Has sharp edges, thin tips and walls within.
const Model kCow{"cow.obj", 1.0, 12, 30};
const auto name_of_file = [](const auto& given) { return test::name_of_model(given.param.file); };
INSTANTIATE_TEST_SUITE_P(Shared, ImportModels, ::testing::Values(kCow), name_of_file);
INSTANTIATE_TEST_SUITE_P(Shared, ImportModelsSlow,
                         ::testing::Values(Model{"stanford-bunny.obj", 1.0, 0, 0},
                                           Model{"spot.obj", 1.0, 0, 0},
                                           Model{"rocker-arm.obj", 1.0, 0, 5}, kCow,
                                           Model{"fandisk.obj", 1.5, 0, 0}),
                         name_of_file);

void expect_teapot_is_one_solid(double voxel_mm) {
  ARGIL_MODEL_OR_SKIP(path, "teapot.obj");
  const auto read = io::read_mesh(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const TriangleMesh input = sized(read.value());
  const auto closed = mesh::close_mesh(input);
  ASSERT_TRUE(closed.ok()) << closed.error().message;
  for (const TriangleMesh* mesh : {&input, &closed.value().mesh}) {
    const auto imported = import_mesh(*mesh, {voxel_mm, 0.1});
    ASSERT_TRUE(imported.ok()) << imported.error().message;
    const TriangleMesh surface = extract_surface(imported.value().clay);
    EXPECT_TRUE(is_closed(surface));
    const double volume = signed_volume(surface);
    std::cout << "  teapot: bridged " << imported.value().report.bridged_nodes << " nodes, volume "
              << volume << " mm3, lost vertices " << imported.value().report.lost_vertices << '\n';
    EXPECT_GT(volume, 40000.0);
    EXPECT_LT(volume, 60000.0);
  }
}

TEST(ImportTeapot, BecomesOneClosedSolid) { expect_teapot_is_one_solid(3.0 * kImportVoxelMm); }
TEST(ImportTeapotSlow, BecomesOneClosedSolid) { expect_teapot_is_one_solid(kImportVoxelMm); }

}  // namespace
}  // namespace argil
