// SPDX-License-Identifier: GPL-3.0-or-later
// Judges a slide by what happens across the path: along it the hand moves on purpose.
#include "argil/haptics/analysis/slide_judgement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "math/unit.h"

namespace argil::haptics {
namespace {

constexpr double kSwingPieceS = 0.2;
constexpr double kForcePieceS = 0.05;
/// Below it a hand that sinks in and turns back looks like a swing.
constexpr double kLeastWorkMw = 2.0;

std::vector<Vec3> across(std::span<const Vec3> series, const Vec3& path) {
  std::vector<Vec3> rest;
  rest.reserve(series.size());
  for (const Vec3& value : series) rest.push_back(value - dot(value, path) * path);
  return rest;
}

/// Judges each whole piece of that length; what is left over at the end is not judged.
template <class Visit>
void each_piece(std::span<const Vec3> positions, std::span<const Vec3> forces, double piece_s,
                double period_s, const Visit& visit) {
  const auto length = static_cast<std::size_t>(std::lround(piece_s / period_s));
  for (std::size_t n = 0; n + length <= positions.size(); n += length) {
    visit(judge_hold(positions.subspan(n, length), forces.subspan(n, length), period_s));
  }
}

/// What the servo gives, in all and at most from any moment on.
void add_up(std::span<const Vec3> positions, std::span<const Vec3> forces, SlideJudgement& found) {
  double least_nmm = 0.0;
  for (std::size_t n = 0; n + 1 < positions.size(); ++n) {
    found.work_mj += dot(forces[n], positions[n + 1] - positions[n]);
    least_nmm = std::min(least_nmm, found.work_mj);
    found.most_given_mj = std::max(found.most_given_mj, found.work_mj - least_nmm);
  }
}

}  // namespace

SlideJudgement judge_slide(std::span<const Vec3> position_mm, std::span<const Vec3> force_n,
                           const Vec3& path, double period_s) {
  assert(position_mm.size() == force_n.size() && position_mm.size() >= 3);
  assert(is_unit(path) && period_s > 0.0);
  const std::vector<Vec3> positions = across(position_mm, path);
  const std::vector<Vec3> forces = across(force_n, path);
  SlideJudgement found;
  add_up(position_mm, force_n, found);
  found.whole = judge_hold(positions, forces, period_s);
  HoldJudgement& worst = found.worst;
  bool swings = false;
  each_piece(positions, forces, kSwingPieceS, period_s, [&](const HoldJudgement& piece) {
    // A drift without a swing.
    if (piece.frequency_hz <= 0.0) return;
    swings |= piece.position_pp_mm > kLimitCycleMm && piece.work_mw > kLeastWorkMw;
    if (piece.position_pp_mm <= worst.position_pp_mm) return;
    worst.position_pp_mm = piece.position_pp_mm;
    worst.frequency_hz = piece.frequency_hz;
    worst.work_mw = piece.work_mw;
  });
  each_piece(positions, forces, kForcePieceS, period_s, [&](const HoldJudgement& piece) {
    worst.force_pp_n = std::max(worst.force_pp_n, piece.force_pp_n);
  });
  if (swings) {
    worst.verdict = Verdict::limit_cycle;
  } else if (worst.force_pp_n > kBuzzN) {
    worst.verdict = Verdict::buzz;
  }
  return found;
}

}  // namespace argil::haptics
