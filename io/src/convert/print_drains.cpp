// SPDX-License-Identifier: GPL-3.0-or-later
// Drains: hollow once without any to see where cavities are, then again with one at the lowest
// place of each, and more where the floor of a cavity has a second low.
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

  /// One hole into a pocket: down from its lowest place, or up from its highest for air.
  PrintHole hole(const mesh::LiquidPocket& pocket, bool is_for_air) const;
  Drain drain(const PrintHole& hole) const;
  /// Where the solid was: liquid there stands in what was hollowed, not in a bowl outside.
  bool is_inside(const Vec3& on_bed) const {
    return solid_.distance_at(frame_.to_clay(on_bed)) < -solid_.options().voxel_mm;
  }

 private:
  /// How far it is through the solid to its outside.
  double way_through(const Vec3& from, const Vec3& direction) const;

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

PrintHole Drilling::hole(const mesh::LiquidPocket& pocket, bool is_for_air) const {
  const double up = is_for_air ? 1.0 : -1.0;
  const double deep =
      std::min(options_.drain_radius_mm, 0.4 * (pocket.highest_mm.z - pocket.lowest_mm.z));
  // Within the air, so that the hole meets it however slanted it comes.
  const Vec3 from = is_for_air ? pocket.highest_mm - Vec3{0.0, 0.0, deep}
                               : pocket.lowest_mm + Vec3{0.0, 0.0, deep};
  double least = std::numeric_limits<double>::infinity();
  PrintHole best;
  for (const Vec3& way : ways_out(up)) {
    // Straight unless another way is much shorter: drops run out of it best.
    constexpr double kSlantedCost = 1.5;
    const double through = way_through(from, way);
    const double cost = through * (way.z == up ? 1.0 : kSlantedCost);
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

}  // namespace

double pocket_pitch_mm(const TriangleMesh& mesh, double drain_radius_mm) {
  const double diagonal = length(bounds(mesh).size());
  assert(diagonal > 0.0 && drain_radius_mm > 0.0);
  return std::clamp(drain_radius_mm / 1.5, diagonal / 500.0, diagonal / 150.0);
}

Result<std::vector<PrintHole>> hollow_with_drains(Clay& clay, const PrintFrame& frame,
                                                  const PreparationOptions& options,
                                                  const Pace& pace) {
  constexpr int kMostRounds = 4;
  const Clay solid = copy_of(clay);
  std::vector<PrintHole> holes;
  std::vector<Drain> drains;
  for (int round = 0;; ++round) {
    const Pace part = pace.part(round / (kMostRounds + 1.0), (round + 1) / (kMostRounds + 1.0));
    auto hollow = hollowed(solid, drains, options.wall_mm, answering(part.part(0.0, 0.5)));
    if (!hollow) return hollow.error();
    clay = std::move(hollow).value();
    if (round == kMostRounds) return holes;
    const TriangleMesh surface = surface_on_bed(clay, frame);
    const mesh::PocketOptions looked{pocket_pitch_mm(surface, options.drain_radius_mm),
                                     kLeastPocketMm3};
    const auto pockets = mesh::liquid_pockets(surface, looked, part.part(0.5, 1.0));
    const Drilling drilling(solid, frame, options, length(bounds(surface).size()));
    const std::size_t before = holes.size();
    for (const mesh::LiquidPocket& pocket : pockets) {
      if (!drilling.is_inside(pocket.lowest_mm)) continue;
      if (pocket.closed && pocket.volume_mm3 < kLeastCavityMm3) continue;
      holes.push_back(drilling.hole(pocket, false));
      if (pocket.closed && options.printer.needs_drains) {
        holes.push_back(drilling.hole(pocket, true));
      }
    }
    if (holes.size() == before) return holes;
    for (std::size_t h = before; h < holes.size(); ++h) drains.push_back(drilling.drain(holes[h]));
  }
}

}  // namespace argil::io
