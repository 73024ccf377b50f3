// SPDX-License-Identifier: GPL-3.0-or-later
// OpenVDB's tools for level sets, used as its manual has them.
#include "rivals/openvdb_levels.h"

#include <cassert>
#include <utility>
#include <vector>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/LevelSetRebuild.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

#include "rivals/openvdb_turned.h"

namespace argil::evaluation {
namespace {

using openvdb::FloatGrid;

constexpr float kOpenvdbHalfWidth = 3.0F;

FloatGrid::Ptr level_set_of(const TriangleMesh& mesh, double voxel_mm) {
  std::vector<openvdb::Vec3s> points;
  points.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) points.emplace_back(openvdb::Vec3d(p.x, p.y, p.z));
  std::vector<openvdb::Vec3I> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  return openvdb::tools::meshToLevelSet<FloatGrid>(
      *openvdb::math::Transform::createLinearTransform(voxel_mm), points, triangles,
      kOpenvdbHalfWidth);
}

openvdb::math::Transform::Ptr placed_transform(const FloatGrid& grid, const Placement& placement) {
  const Quat& q = placement.orientation;
  const Vec3& p = placement.position_mm;
  auto rigid =
      openvdb::math::rotation<openvdb::Mat4d>(openvdb::math::Quat<double>(q.x, q.y, q.z, q.w));
  rigid.setTranslation({p.x, p.y, p.z});
  auto transform = grid.transform().copy();
  transform->postMult(rigid);
  return transform;
}

}  // namespace

struct OpenvdbLevels::Grid {
  FloatGrid::Ptr levels;
};

OpenvdbLevels::OpenvdbLevels(const TriangleMesh& mesh_mm, double voxel_mm)
    : grid_(std::make_unique<Grid>(Grid{level_set_of(mesh_mm, voxel_mm)})) {}
OpenvdbLevels::OpenvdbLevels(std::unique_ptr<Grid> grid) : grid_(std::move(grid)) {}
OpenvdbLevels::OpenvdbLevels(OpenvdbLevels&&) noexcept = default;
OpenvdbLevels& OpenvdbLevels::operator=(OpenvdbLevels&&) noexcept = default;
OpenvdbLevels::~OpenvdbLevels() = default;

OpenvdbLevels OpenvdbLevels::copy() const {
  return OpenvdbLevels(std::make_unique<Grid>(Grid{grid_->levels->deepCopy()}));
}

void OpenvdbLevels::offset(double distance_mm) {
  // It adds to the distances, so that more is inward.
  openvdb::tools::LevelSetFilter<FloatGrid>(*grid_->levels)
      .offset(static_cast<float>(-distance_mm));
}

void OpenvdbLevels::unite_with_copy(const Placement& placement) {
  FloatGrid& levels = *grid_->levels;
  const FloatGrid::Ptr moved = levels.copy();  // the same values in another place
  moved->setTransform(placed_transform(levels, placement));
  const FloatGrid::Ptr on_lattice = transformed_to(levels.transform(), *moved);
  openvdb::tools::csgUnion(levels, *on_lattice);
}

void OpenvdbLevels::resample(double voxel_mm) {
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_mm);
  // What resampleToMatch does with a level set, whose header is not for C++20 (openvdb_turned.cpp).
  grid_->levels = openvdb::tools::levelSetRebuild(*grid_->levels, 0.0F, kOpenvdbHalfWidth,
                                                  kOpenvdbHalfWidth, transform.get());
}

void OpenvdbLevels::hollow(double wall_mm) {
  OpenvdbLevels inside = copy();
  inside.offset(-wall_mm);
  openvdb::tools::csgDifference(*grid_->levels, *inside.grid_->levels);
}

TriangleMesh OpenvdbLevels::surface() const {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid_->levels, points, triangles, quads);
  assert(!points.empty());
  TriangleMesh mesh;
  mesh.positions.reserve(points.size());
  for (const openvdb::Vec3s& p : points) {
    mesh.positions.push_back(
        {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())});
  }
  mesh.triangles.reserve(triangles.size() + 2 * quads.size());
  // Seen from outside it turns them clockwise.
  for (const openvdb::Vec3I& t : triangles) mesh.triangles.push_back({t.x(), t.z(), t.y()});
  for (const openvdb::Vec4I& q : quads) {
    mesh.triangles.push_back({q.x(), q.z(), q.y()});
    mesh.triangles.push_back({q.x(), q.w(), q.z()});
  }
  return mesh;
}

}  // namespace argil::evaluation
