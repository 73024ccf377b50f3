// SPDX-License-Identifier: GPL-3.0-or-later
// Drains: hollow once without any to see where cavities are, then again with one at the lowest
// place of each, and more where the floor of a cavity has a second low. Where a neck is hardly
// wider than two walls, two cavities may leave a film between them: a slightly thicker wall leaves
// a plug.
#include "convert/print_drains.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "argil/engine/clay_copy.h"
#include "argil/mesh/liquid_pockets.h"
#include "argil/mesh/wall_thickness.h"

namespace argil::io {
namespace {

/// Ways out of a cavity that are tried: straight, and on cones 30, 60 and 90 degrees from that.
std::vector<Vec3> ways_out(double straight_z) {
  constexpr std::array<std::pair<double, double>, 8> kAround{{{1.0, 0.0},
                                                              {0.7071, 0.7071},
                                                              {0.0, 1.0},
                                                              {-0.7071, 0.7071},
                                                              {-1.0, 0.0},
                                                              {-0.7071, -0.7071},
                                                              {0.0, -1.0},
                                                              {0.7071, -0.7071}}};
  constexpr std::array<std::pair<double, double>, 3> kCones{
      {{0.5, 0.8660}, {0.8660, 0.5}, {1.0, 0.0}}};
  std::vector<Vec3> ways{{0.0, 0.0, straight_z}};
  for (const auto& [across, along] : kCones) {
    for (const auto& [x, y] : kAround) ways.push_back({across * x, across * y, along * straight_z});
  }
  return ways;
}

class Drilling {
 public:
  Drilling(const Clay& solid, const PrintFrame& frame, const PreparationOptions& options,
           double reach_mm)
      : solid_(solid), frame_(frame), options_(options), reach_(reach_mm) {}

  Vec3 within_air(const Clay& hollow, const Vec3& end, double most_mm) const;
  /// One hole into a pocket of what was hollowed so far: down from its lowest place, or up from its
  /// highest for air.
  PrintHole hole(const Clay& hollow, const mesh::LiquidPocket& pocket, bool is_for_air) const;
  Drain drain(const PrintHole& hole) const;
  /// Where the solid was: liquid there stands in what was hollowed, not in a bowl outside.
  bool is_inside(const Vec3& on_bed) const {
    return solid_.distance_at(frame_.to_clay(on_bed)) < -solid_.options().voxel_mm;
  }

 private:
  /// How far it is through the solid to its outside.
  double way_through(const Vec3& from, const Vec3& direction) const;
  /// 1 where a hole keeps clear of the outside until it leaves it straight, less where it grazes
  /// it.
  double clearance(const Vec3& from, const Vec3& direction, double through) const;

  const Clay& solid_;
  const PrintFrame& frame_;
  const PreparationOptions& options_;
  double reach_;
};

double Drilling::way_through(const Vec3& from, const Vec3& direction) const {
  const double step = 0.5 * solid_.options().voxel_mm;
  for (double t = step; t < reach_; t += step) {
    if (solid_.distance_at(frame_.to_clay(from + t * direction)) > 0.0) return t;
  }
  return reach_;
}

double Drilling::clearance(const Vec3& from, const Vec3& direction, double through) const {
  const double enough = options_.drain_radius_mm + options_.printer.min_wall_mm;
  const double step = 0.5 * solid_.options().voxel_mm;
  double least = 1.0;
  for (double t = 0.0; t < through - step; t += step) {
    const double depth = -solid_.distance_at(frame_.to_clay(from + t * direction));
    least = std::min(least, depth / std::min(enough, through - t));
  }
  return std::max(least, 0.0);
}

/// From the end of a pocket into its air, as far as half a drain's radius from its walls: there a
/// hole meets it however slanted it comes. No farther than `most_mm`.
Vec3 Drilling::within_air(const Clay& hollow, const Vec3& end, double most_mm) const {
  const double step = 0.5 * solid_.options().voxel_mm;
  const Vec3 from = frame_.to_clay(end);
  Vec3 at = from;
  double air = hollow.distance_at(at);
  while (air < 0.5 * options_.drain_radius_mm) {
    Vec3 next = at;
    for (int way = 0; way < 27; ++way) {
      const Vec3 beside = at + step * Vec3{way / 9 - 1.0, way / 3 % 3 - 1.0, way % 3 - 1.0};
      const double there = hollow.distance_at(beside);
      if (there <= air || length(beside - from) > most_mm) continue;
      next = beside;
      air = there;
    }
    if (next == at) break;
    at = next;
  }
  return frame_.to_bed(at);
}

PrintHole Drilling::hole(const Clay& hollow, const mesh::LiquidPocket& pocket,
                         bool is_for_air) const {
  const double up = is_for_air ? 1.0 : -1.0;
  // A drain still takes in the low; air comes in somewhat below the highest place as well, where an
  // ear is thick enough for a hole.
  constexpr double kRadiiForAir = 3.0;
  const double radius = options_.drain_radius_mm;
  const Vec3 from = is_for_air ? within_air(hollow, pocket.highest_mm, kRadiiForAir * radius)
                               : within_air(hollow, pocket.lowest_mm, radius);
  double least = std::numeric_limits<double>::infinity();
  PrintHole best;
  for (const Vec3& way : ways_out(up)) {
    // Straight unless another way is much shorter: drops run out of it best.
    constexpr double kSlantedCost = 1.5;
    const double through = way_through(from, way);
    constexpr double kLeastClearance = 0.1;
    const double cost = through * (way.z == up ? 1.0 : kSlantedCost) /
                        std::max(kLeastClearance, clearance(from, way, through));
    if (cost >= least) continue;
    least = cost;
    best = {from + through * way, -way, is_for_air};
  }
  return best;
}

Drain Drilling::drain(const PrintHole& hole) const {
  // From a little before the surface, so that rounding cannot leave a skin.
  const Vec3 before = hole.mouth_mm - solid_.options().voxel_mm * hole.inward;
  return {frame_.to_clay(before), frame_.direction_to_clay(hole.inward), options_.drain_radius_mm};
}

Result<Clay> hollowed(const Clay& solid, const std::vector<Drain>& drains, double wall_mm,
                      const Progress& progress) {
  Clay hollow = copy_of(solid);
  const auto done = hollow.apply(Hollow{wall_mm, drains}, progress);
  if (!done) return Error{done.error().kind, "hollow: " + done.error().message};
  return hollow;
}

Result<std::vector<PrintHole>> drain_all(const Clay& solid, const PrintFrame& frame,
                                         const PreparationOptions& options, double wall_mm,
                                         Clay& clay, const Pace& pace) {
  constexpr int kMostRounds = 4;
  std::vector<PrintHole> holes;
  std::vector<Drain> drains;
  std::size_t drained = 0;  // holes that the clay has
  for (int round = 0;; ++round) {
    const Pace part = pace.part(round / (kMostRounds + 1.0), (round + 1) / (kMostRounds + 1.0));
    auto hollow = hollowed(solid, drains, wall_mm, answering(part.part(0.0, 0.5)));
    // Where a hole meets only an earlier one and no cavity, those before are all there can be.
    if (!hollow && round > 1 && hollow.error().kind == ErrorKind::bad_input) {
      holes.resize(drained);
      return holes;
    }
    if (!hollow) return hollow.error();
    drained = holes.size();
    clay = std::move(hollow).value();
    if (round == kMostRounds) return holes;
    const TriangleMesh surface = surface_on_bed(clay, frame);
    const mesh::PocketOptions looked{pocket_pitch_mm(surface, options.drain_radius_mm),
                                     kLeastPocketMm3};
    const auto pockets = mesh::liquid_pockets(surface, looked, part.part(0.5, 1.0));
    const Drilling drilling(solid, frame, options, length(bounds(surface).size()));
    const std::size_t before = holes.size();
    const auto drill = [&](const mesh::LiquidPocket& pocket, bool is_for_air) {
      const PrintHole hole = drilling.hole(clay, pocket, is_for_air);
      const bool is_there = std::any_of(holes.begin(), holes.end(), [&](const PrintHole& other) {
        return length(other.mouth_mm - hole.mouth_mm) < 0.5 * options.drain_radius_mm;
      });
      if (!is_there) holes.push_back(hole);
    };
    for (const mesh::LiquidPocket& pocket : pockets) {
      if (!drilling.is_inside(pocket.lowest_mm)) continue;
      if (pocket.closed && pocket.volume_mm3 < kLeastCavityMm3) continue;
      drill(pocket, false);
      if (pocket.closed && options.printer.needs_drains) drill(pocket, true);
    }
    if (holes.size() == before) return holes;
    for (std::size_t h = before; h < holes.size(); ++h) drains.push_back(drilling.drain(holes[h]));
  }
}

/// Where cavities come nearer to each other than the printer can print: how much of their surface.
/// Thin places at the outer surface are the piece's own.
double film_mm2(const Clay& hollow, const Clay& solid, const PrintFrame& frame,
                const PreparationOptions& options, const Pace& pace) {
  const double least = options.printer.min_wall_mm;
  if (!(least > 0.0)) return 0.0;
  const TriangleMesh surface = surface_on_bed(hollow, frame);
  double sum = 0.0;
  for (const mesh::TriangleThickness& wall : mesh::wall_thickness(surface, least, pace)) {
    if (wall.thin_mm2 == 0.0) continue;
    const double depth = -solid.distance_at(frame.to_clay(wall.at_mm));
    if (depth > 0.5 * options.wall_mm) sum += wall.thin_mm2;
  }
  return sum;
}

/// A clay hollowed and drained.
struct Hollowed {
  Clay clay;
  double wall_mm;
  std::vector<PrintHole> holes;
  double film_mm2;
};

}  // namespace

double pocket_pitch_mm(const TriangleMesh& mesh, double drain_radius_mm) {
  const double diagonal = length(bounds(mesh).size());
  assert(diagonal > 0.0 && drain_radius_mm > 0.0);
  return std::clamp(drain_radius_mm / 1.5, diagonal / 500.0, diagonal / 150.0);
}

Result<std::vector<PrintHole>> hollow_with_drains(Clay& clay, const PrintFrame& frame,
                                                  const PreparationOptions& options,
                                                  double& wall_mm, const Pace& pace) {
  // As much as a check counts.
  const double least_mm2 = options.printer.min_wall_mm * options.printer.min_wall_mm;
  const Clay solid = copy_of(clay);
  const auto hollow_by = [&](double thicker, const Pace& part) -> Result<Hollowed> {
    Hollowed made{copy_of(solid), options.wall_mm * (1.0 + thicker), {}, 0.0};
    auto holes = drain_all(solid, frame, options, made.wall_mm, made.clay, part.part(0.0, 0.8));
    if (!holes) return holes.error();
    made.holes = std::move(holes).value();
    made.film_mm2 = film_mm2(made.clay, solid, frame, options, part.part(0.8, 1.0));
    return made;
  };
  const auto take = [&](Hollowed& made) {
    clay = std::move(made.clay);
    wall_mm = made.wall_mm;
    return std::move(made.holes);
  };
  auto as_asked = hollow_by(0.0, pace.part(0.0, 0.25));
  if (!as_asked) return as_asked.error();
  if (as_asked.value().film_mm2 <= least_mm2) return take(as_asked.value());
  // Where the thickest does not help, those between are not worth their time.
  auto thickest = hollow_by(kMostThicker, pace.part(0.25, 0.5));
  if (!thickest && thickest.error().kind != ErrorKind::bad_input) return thickest.error();
  constexpr double kWorthIt = 0.5;
  if (!thickest || thickest.value().film_mm2 > kWorthIt * as_asked.value().film_mm2) {
    return take(as_asked.value());
  }
  for (const int third : {1, 2}) {
    auto between =
        hollow_by(kMostThicker * third / 3.0, pace.part(0.25 + 0.25 * third, 0.5 + 0.25 * third));
    if (!between && between.error().kind != ErrorKind::bad_input) return between.error();
    if (between && between.value().film_mm2 <= least_mm2) return take(between.value());
  }
  return take(thickest.value());
}

}  // namespace argil::io
