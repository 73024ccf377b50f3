// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles are halved across their longest side as long as something opposite may be near, down to
// parts of half the asked thickness; of each the middle is asked.
#include "argil/mesh/wall_thickness.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/mesh/triangle_geometry.h"

#include "measure/opposite_surface.h"

namespace argil::mesh {
namespace {

using Through = OppositeSurface::Through;

/// Of what is asked, the longest side of a part.
constexpr double kPartOfAsked = 0.5;
/// With more the parts grow.
constexpr double kMostParts = 4e6;
/// Triangles that are so many parts long are first cut into pieces, so that threads share them.
constexpr double kPieceParts = 16.0;

class ThicknessMeasure {
 public:
  ThicknessMeasure(const TriangleMesh& mesh, Through through, double asked_mm);
  std::vector<TriangleThickness> run(const Pace& pace);

 private:
  struct Piece {
    std::uint32_t triangle;
    Corners corners;
    TriangleThickness found;
  };

  Vec3 way_of(std::size_t triangle) const noexcept {
    return sign_ * normalized(area_normal(corners_of(mesh_, triangle)));
  }
  bool may_be_thin(const Corners& corners, const Vec3& way) const;
  template <class Visit>
  void for_each_part(const Corners& corners, const Vec3& way, double longest,
                     const Visit& visit) const;
  void add_parts(const Corners& corners, const Vec3& way, TriangleThickness& found) const;
  void measure(std::size_t triangle);
  void cut(std::size_t triangle);

  const TriangleMesh& mesh_;
  double sign_;
  double asked_mm_;
  double part_mm_;
  OppositeSurface opposite_;
  std::vector<TriangleThickness> found_;
  std::vector<Piece> pieces_;
};

ThicknessMeasure::ThicknessMeasure(const TriangleMesh& mesh, Through through, double asked_mm)
    : mesh_(mesh),
      sign_(through == Through::solid ? -1.0 : 1.0),
      asked_mm_(asked_mm),
      // A part whose sides are a quarter to one of the longest has about a quarter of its square.
      part_mm_(std::max(kPartOfAsked * asked_mm, 2.0 * std::sqrt(surface_area(mesh) / kMostParts))),
      opposite_(mesh, through),
      found_(mesh.triangles.size()) {
  assert(asked_mm > 0.0);
}

/// Whether the ball of a place of these may reach something opposite.
bool ThicknessMeasure::may_be_thin(const Corners& corners, const Vec3& way) const {
  const Vec3 at = middle(corners);
  double reach = 0.0;
  for (const Vec3& corner : corners) reach = std::max(reach, length(corner - at));
  const double half = 0.5 * asked_mm_;
  return opposite_.comes_near(at + half * way, half + reach, way);
}

/// Parts with sides up to `longest`, but for those of which none is thin.
template <class Visit>
void ThicknessMeasure::for_each_part(const Corners& corners, const Vec3& way, double longest,
                                     const Visit& visit) const {
  if (longest_side(corners) <= longest) {
    visit(corners);
    return;
  }
  if (!may_be_thin(corners, way)) return;
  for (const Corners& half : halved(corners)) for_each_part(half, way, longest, visit);
}

void ThicknessMeasure::add_parts(const Corners& corners, const Vec3& way,
                                 TriangleThickness& found) const {
  for_each_part(corners, way, part_mm_, [&](const Corners& part) {
    const Vec3 at = middle(part);
    const double ball = opposite_.ball_mm(at, way, asked_mm_);
    if (ball >= asked_mm_) return;
    found.thin_mm2 += 0.5 * length(area_normal(part));
    if (ball >= found.least_mm) return;
    found.least_mm = ball;
    found.at_mm = at;
  });
}

/// Where nothing is thin, what a ray says.
void ThicknessMeasure::measure(std::size_t triangle) {
  const Vec3 way = way_of(triangle);
  if (way == Vec3{}) return;
  const Corners corners = corners_of(mesh_, triangle);
  TriangleThickness& found = found_[triangle];
  if (longest_side(corners) <= kPieceParts * part_mm_) add_parts(corners, way, found);
  if (found.least_mm < asked_mm_) return;
  const double ray = opposite_.ray_mm(middle(corners), way);
  if (ray < asked_mm_) return;  // what ends it is not opposite
  found.least_mm = ray;
  found.at_mm = middle(corners);
}

/// Long triangles, into pieces.
void ThicknessMeasure::cut(std::size_t triangle) {
  const Corners corners = corners_of(mesh_, triangle);
  const double longest = kPieceParts * part_mm_;
  if (longest_side(corners) <= longest) return;
  const Vec3 way = way_of(triangle);
  if (way == Vec3{}) return;
  for_each_part(corners, way, longest, [&](const Corners& piece) {
    pieces_.push_back({static_cast<std::uint32_t>(triangle), piece, {}});
  });
}

/// Calls work(n) for n below `count` on all threads, and tells how far it is.
template <class Work>
void in_turns(std::size_t count, std::size_t at_a_time, const Pace& pace, const Work& work) {
  for (std::size_t begin = 0; begin < count; begin += at_a_time) {
    pace.at(static_cast<double>(begin) / static_cast<double>(count));
    tbb::parallel_for(begin, std::min(count, begin + at_a_time), work);
  }
}

std::vector<TriangleThickness> ThicknessMeasure::run(const Pace& pace) {
  constexpr std::size_t kAtATime = 2048;
  in_turns(found_.size(), kAtATime, pace.part(0.0, 0.6), [&](std::size_t t) { measure(t); });
  for (std::size_t t = 0; t < found_.size(); ++t) cut(t);
  in_turns(pieces_.size(), kAtATime, pace.part(0.6, 1.0), [&](std::size_t n) {
    Piece& piece = pieces_[n];
    add_parts(piece.corners, way_of(piece.triangle), piece.found);
  });
  for (const Piece& piece : pieces_) {
    TriangleThickness& whole = found_[piece.triangle];
    whole.thin_mm2 += piece.found.thin_mm2;
    if (piece.found.least_mm >= whole.least_mm) continue;
    whole.least_mm = piece.found.least_mm;
    whole.at_mm = piece.found.at_mm;
  }
  return std::move(found_);
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
