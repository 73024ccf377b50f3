// SPDX-License-Identifier: GPL-3.0-or-later
#include "convert/field_wall.h"

#include <algorithm>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/engine/field_sampler.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {
namespace {

constexpr double kNoWall = std::numeric_limits<double>::infinity();

/// So far under the surface the field must be inside.
constexpr double kUnderVoxels = 0.01;

class FieldWall {
 public:
  FieldWall(const TriangleMesh& surface, const Clay& clay, const RayExits& exits)
      : surface_(surface), voxel_mm_(clay.options().voxel_mm), exits_(exits), sampler_(clay) {}

  mesh::TriangleThickness thickness(std::size_t triangle, double asked_mm) {
    const mesh::Corners corners = mesh::corners_of(surface_, triangle);
    mesh::TriangleThickness found;
    found.least_mm = thickness_at(corners);
    found.at_mm = mesh::middle(corners);
    if (found.least_mm < asked_mm) found.thin_mm2 = 0.5 * length(mesh::area_normal(corners));
    return found;
  }

 private:
  double thickness_at(const mesh::Corners& corners) {
    const Vec3 middle = mesh::middle(corners);
    // The middle of a triangle lies beside a curved surface; a ray that began outside would end at
    // the near side.
    const Vec3 start = sampler_.on_surface(middle).value_or(middle);
    Vec3 inward = -normalized(sampler_.value(start).gradient);
    // At a medial axis the gradient vanishes; the triangle still faces somewhere.
    if (inward == Vec3{}) inward = -normalized(mesh::area_normal(corners));
    if (inward == Vec3{}) return kNoWall;
    const Vec3 under = start + (kUnderVoxels * voxel_mm_) * inward;
    if (sampler_.distance_mm(under) >= 0.0) return kNoWall;
    const auto exit = exits_.first_voxels(under / voxel_mm_, inward);
    return exit ? (kUnderVoxels + *exit) * voxel_mm_ : kNoWall;
  }

  const TriangleMesh& surface_;
  double voxel_mm_;
  const RayExits& exits_;
  FieldSampler sampler_;
};

}  // namespace

std::vector<mesh::TriangleThickness> field_thickness(const TriangleMesh& surface, const Clay& clay,
                                                     double asked_mm, const Pace& pace) {
  std::vector<mesh::TriangleThickness> walls(surface.triangles.size());
  const RayExits exits(clay);
  constexpr std::size_t kGrain = 1024;
  constexpr std::size_t kAtATime = 64 * kGrain;
  for (std::size_t first = 0; first < walls.size(); first += kAtATime) {
    pace.at(static_cast<double>(first) / static_cast<double>(walls.size()));
    const std::size_t last = std::min(walls.size(), first + kAtATime);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        FieldWall wall(surface, clay, exits);
                        for (std::size_t t = range.begin(); t < range.end(); ++t) {
                          walls[t] = wall.thickness(t, asked_mm);
                        }
                      });
  }
  return walls;
}

}  // namespace argil::io
