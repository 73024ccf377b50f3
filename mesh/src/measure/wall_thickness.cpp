// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles are cut into parts of about half the asked thickness where something opposite may be
// near; of each the middle is asked.
#include "argil/mesh/wall_thickness.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "argil/mesh/triangle_geometry.h"

#include "measure/mesh_pieces.h"
#include "measure/opposite_surface.h"

namespace argil::mesh {
namespace {

using Through = OppositeSurface::Through;

/// Of what is asked; a part's sides are up to one and a half times as long.
constexpr double kPartOfAsked = 1.0 / 3.0;
/// With more the parts grow.
constexpr double kMostParts = 4e6;
/// Pieces of long triangles are so many parts long.
constexpr double kPieceParts = 4.0;
constexpr double kMostPieces = 1e6;

class ThicknessMeasure {
 public:
  ThicknessMeasure(const TriangleMesh& mesh, Through through, double asked_mm)
      : mesh_(mesh),
        sign_(through == Through::solid ? -1.0 : 1.0),
        asked_mm_(asked_mm),
        part_mm_(step_for(mesh, kPartOfAsked * asked_mm, kMostParts)),
        pieces_(mesh, kPieceParts * part_mm_, kMostPieces),
        opposite_(pieces_, through) {
    assert(asked_mm > 0.0);
  }
  std::vector<TriangleThickness> run(const Pace& pace);

 private:
  Vec3 way_of(std::size_t triangle) const noexcept {
    return sign_ * normalized(area_normal(corners_of(mesh_, triangle)));
  }
  bool may_be_thin(const Corners& corners, const Vec3& way) const;
  void add_parts(const Corners& corners, const Vec3& way, TriangleThickness& found) const;
  void add_ray(std::size_t triangle, TriangleThickness& found) const;

  const TriangleMesh& mesh_;
  double sign_;
  double asked_mm_;
  double part_mm_;
  MeshPieces pieces_;
  OppositeSurface opposite_;
};

/// Whether the ball of a place of these may reach something opposite.
bool ThicknessMeasure::may_be_thin(const Corners& corners, const Vec3& way) const {
  const Vec3 at = middle(corners);
  double reach = 0.0;
  for (const Vec3& corner : corners) reach = std::max(reach, length(corner - at));
  const double half = 0.5 * asked_mm_;
  return opposite_.comes_near(at + half * way, half + reach, way);
}

void ThicknessMeasure::add_parts(const Corners& corners, const Vec3& way,
                                 TriangleThickness& found) const {
  if (is_longer_than_a_part(corners, part_mm_) && !may_be_thin(corners, way)) return;
  for_each_part(corners, part_mm_, [&](const Corners& part) {
    const Vec3 at = middle(part);
    const double ball = opposite_.ball_mm(at, way, asked_mm_);
    if (ball >= asked_mm_) return;
    found.thin_mm2 += 0.5 * length(area_normal(part));
    if (ball >= found.least_mm) return;
    found.least_mm = ball;
    found.at_mm = at;
  });
}

/// Where nothing is thin, what a ray from the middle says.
void ThicknessMeasure::add_ray(std::size_t triangle, TriangleThickness& found) const {
  if (found.least_mm < asked_mm_) return;
  const Vec3 way = way_of(triangle);
  if (way == Vec3{}) return;
  const Vec3 at = middle(corners_of(mesh_, triangle));
  const double end = opposite_.ray(at, way).end_mm;
  if (end < asked_mm_) return;  // what ends it is not opposite
  found.least_mm = end;
  found.at_mm = at;
}

/// Calls work(n) for n below `count` on all threads, and tells how far it is.
template <class Work>
void in_turns(std::size_t count, const Pace& pace, const Work& work) {
  constexpr std::size_t kAtATime = 4096;
  for (std::size_t begin = 0; begin < count; begin += kAtATime) {
    pace.at(static_cast<double>(begin) / static_cast<double>(count));
    tbb::parallel_for(begin, std::min(count, begin + kAtATime), work);
  }
}

std::vector<TriangleThickness> ThicknessMeasure::run(const Pace& pace) {
  std::vector<TriangleThickness> of_pieces(pieces_.count());
  in_turns(of_pieces.size(), pace.part(0.0, 0.7), [&](std::size_t n) {
    const Vec3 way = way_of(pieces_.triangle(n));
    if (way != Vec3{}) add_parts(pieces_.corners(n), way, of_pieces[n]);
  });
  std::vector<TriangleThickness> found(mesh_.triangles.size());
  for (std::size_t n = 0; n < of_pieces.size(); ++n) {
    const TriangleThickness& piece = of_pieces[n];
    TriangleThickness& whole = found[pieces_.triangle(n)];
    whole.thin_mm2 += piece.thin_mm2;
    if (piece.least_mm >= whole.least_mm) continue;
    whole.least_mm = piece.least_mm;
    whole.at_mm = piece.at_mm;
  }
  in_turns(found.size(), pace.part(0.7, 1.0), [&](std::size_t t) { add_ray(t, found[t]); });
  return found;
}

std::vector<TriangleThickness> measured(const TriangleMesh& mesh, Through through, double asked_mm,
                                        const Pace& pace) {
  if (mesh.triangles.empty()) return {};
  return ThicknessMeasure(mesh, through, asked_mm).run(pace);
}

}  // namespace

std::vector<TriangleThickness> wall_thickness(const TriangleMesh& mesh, double asked_mm,
                                              const Pace& pace) {
  return measured(mesh, Through::solid, asked_mm, pace);
}

std::vector<TriangleThickness> gap_width(const TriangleMesh& mesh, double asked_mm,
                                         const Pace& pace) {
  return measured(mesh, Through::air, asked_mm, pace);
}

}  // namespace argil::mesh
