// SPDX-License-Identifier: GPL-3.0-or-later
#include "convert/field_wall.h"

#include <cassert>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/engine/field_sampler.h"

namespace argil::io {
namespace {

constexpr double kNoWall = std::numeric_limits<double>::infinity();

/// So far under the surface the field must be inside.
constexpr double kUnderVoxels = 0.01;

class FieldWall {
 public:
  FieldWall(const TriangleMesh& surface, const Clay& clay, const RayExits& exits)
      : surface_(surface), voxel_mm_(clay.options().voxel_mm), exits_(exits), sampler_(clay) {}

  double thickness(std::size_t triangle) {
    assert(triangle < surface_.triangles.size());
    const auto& [ia, ib, ic] = surface_.triangles[triangle];
    const Vec3& a = surface_.positions[ia];
    const Vec3& b = surface_.positions[ib];
    const Vec3& c = surface_.positions[ic];
    const Vec3 middle = (a + b + c) / 3.0;
    // The middle of a triangle lies beside a curved surface; a ray that began outside would end at
    // the near side.
    const Vec3 start = sampler_.on_surface(middle).value_or(middle);
    Vec3 inward = -normalized(sampler_.value(start).gradient);
    // At a medial axis the gradient vanishes; the triangle still faces somewhere.
    if (inward == Vec3{}) inward = -normalized(cross(b - a, c - a));
    if (inward == Vec3{}) return kNoWall;
    const Vec3 under = start + (kUnderVoxels * voxel_mm_) * inward;
    if (sampler_.distance_mm(under) >= 0.0) return kNoWall;
    const auto exit = exits_.first_voxels(under / voxel_mm_, inward);
    return exit ? (kUnderVoxels + *exit) * voxel_mm_ : kNoWall;
  }

 private:
  const TriangleMesh& surface_;
  double voxel_mm_;
  const RayExits& exits_;
  FieldSampler sampler_;
};

}  // namespace

std::vector<double> field_thickness_mm(const TriangleMesh& surface, const Clay& clay) {
  std::vector<double> walls(surface.triangles.size());
  const RayExits exits(clay);
  constexpr std::size_t kGrain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, walls.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      FieldWall wall(surface, clay, exits);
                      for (std::size_t t = range.begin(); t < range.end(); ++t) {
                        walls[t] = wall.thickness(t);
                      }
                    });
  return walls;
}

}  // namespace argil::io
