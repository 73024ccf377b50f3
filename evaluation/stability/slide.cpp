// SPDX-License-Identifier: GPL-3.0-or-later
// Judges a slide by what happens across the path: along it the hand moves on purpose.
#include "stability/slide.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

namespace argil::evaluation {
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
    visit(haptics::judge_hold(positions.subspan(n, length), forces.subspan(n, length), period_s));
  }
}

double work_of(std::span<const Vec3> positions, std::span<const Vec3> forces) {
  double work_nmm = 0.0;
  for (std::size_t n = 0; n + 1 < positions.size(); ++n) {
    work_nmm += dot(forces[n], positions[n + 1] - positions[n]);
  }
  return work_nmm;
}

}  // namespace

SlideJudgement judge_slide(const haptics::HoldTestResult& run, std::size_t from, const Vec3& path,
                           double period_s) {
  assert(from < run.true_position_mm.size());
  assert(run.held_force_n.size() == run.true_position_mm.size());
  assert(std::abs(length(path) - 1.0) < 1e-9 && period_s > 0.0);
  using haptics::HoldJudgement;
  using haptics::Verdict;
  const auto all_positions = std::span<const Vec3>(run.true_position_mm).subspan(from);
  const auto all_forces = std::span<const Vec3>(run.held_force_n).subspan(from);
  const std::vector<Vec3> positions = across(all_positions, path);
  const std::vector<Vec3> forces = across(all_forces, path);
  SlideJudgement found;
  found.work_mj = work_of(all_positions, all_forces);
  found.whole = haptics::judge_hold(positions, forces, period_s);
  HoldJudgement& worst = found.worst;
  bool swings = false;
  each_piece(positions, forces, kSwingPieceS, period_s, [&](const HoldJudgement& piece) {
    // A drift without a swing.
    if (piece.frequency_hz <= 0.0) return;
    swings |= piece.position_pp_mm > haptics::kLimitCycleMm && piece.work_mw > kLeastWorkMw;
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
  } else if (worst.force_pp_n > haptics::kBuzzN) {
    worst.verdict = Verdict::buzz;
  }
  return found;
}

}  // namespace argil::evaluation
