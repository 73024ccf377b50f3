// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/late_plane.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/haptics/force/own_cuts.h"
#include "argil/haptics/force/servo_force.h"

namespace argil::evaluation {
namespace {

constexpr double kBlendS = 1e-3 * haptics::ServoForce::kBlendMs;
constexpr double kHalfWindowMm = 4.0;
constexpr double kHollowMm = 1.0;
/// How soon smoothing has made most of its way.
constexpr double kSmoothS = 0.05;
/// How stiffly a hand is borne that presses on into clay whose energy is held back.
constexpr double kBearNPerMm = 1.0;

bool is_near(double a, double b) { return std::abs(a - b) < 1e-9; }

}  // namespace

LatePlane::LatePlane(const HeightLaw& law, const LateCase& what, double surface_mm)
    : law_(law), what_(what), surface_mm_(surface_mm), rim_mm_(surface_mm + kHollowMm) {
  assert(what.late.period_s > 0.0 && what.late.age_s >= 0.0);
}

double LatePlane::share() const noexcept {
  return law_.tool().is_spring() ? 1.0 : haptics::contact_share(mix_, mode_.p());
}

bool LatePlane::is_outside(const Window& window, const haptics::HandleState& place) const noexcept {
  return std::abs(place.position_mm.x - window.middle_mm) > window.half_mm;
}

/// All of one window, the share of the contact left out: what is beyond its edge is not felt, what
/// is known to be cut is gone, and what is not paid for is held back.
HeightLaw::Felt LatePlane::felt_of(const Window& window,
                                   const haptics::HandleState& place) const noexcept {
  if (is_outside(window, place)) return {};
  const double surface_mm = cut_mm_ ? std::min(window.surface_mm, *cut_mm_) : window.surface_mm;
  HeightLaw::Felt felt = law_.at(place.position_mm.y - surface_mm);
  const double part = window.held.share(felt.energy_mj);
  felt.force_n *= part;
  felt.slope_n_per_mm *= part;
  felt.energy_mj = window.held.felt(felt.energy_mj);
  return felt;
}

double LatePlane::energy_at(const haptics::HandleState& handle) const noexcept {
  if (!new_) return 0.0;
  double energy_mj = blend_ * felt_of(*new_, handle).energy_mj;
  if (blend_ < 1.0) energy_mj += (1.0 - blend_) * felt_of(*old_, handle).energy_mj;
  return share() * energy_mj;
}

haptics::SceneForce LatePlane::force_at(const haptics::HandleState& handle) const noexcept {
  haptics::SceneForce out;
  if (!new_) {
    out.faults = haptics::kSceneWaiting;
    return out;
  }
  HeightLaw::Felt felt = felt_of(*new_, handle);
  if (blend_ < 1.0) {
    const HeightLaw::Felt older = felt_of(*old_, handle);
    felt = {std::lerp(older.force_n, felt.force_n, blend_), 0.0,
            std::lerp(older.slope_n_per_mm, felt.slope_n_per_mm, blend_),
            std::lerp(older.drag_n_s_per_mm, felt.drag_n_s_per_mm, blend_)};
  }
  const double drag_share = std::lerp(mix_.viscosity_passive, mix_.viscosity_active, mode_.p());
  out.force_n = -drag_share * felt.drag_n_s_per_mm * handle.velocity_mm_per_s;
  out.force_n.y += share() * felt.force_n;
  out.stiffness_n_per_m = 1e3 * share() * std::max(0.0, felt.slope_n_per_mm);
  if (is_outside(*new_, handle)) out.faults |= haptics::kSceneOutsideWindow;
  return out;
}

/// Goes on going over to the newest window, or begins to.
void LatePlane::exchange(double elapsed_s) noexcept {
  if (!new_) {
    if (coming_.empty() || coming_.front().time_s > tool_.time_s + elapsed_s + 1e-9) return;
  }
  if (blend_ >= 1.0) {
    std::optional<Window> newest;
    while (!coming_.empty() && coming_.front().time_s <= tool_.time_s + elapsed_s + 1e-9) {
      newest = coming_.front().window;
      coming_.pop_front();
    }
    if (newest) {
      old_ = new_;
      new_ = newest;
      const bool is_whole = !old_ || what_.remedy == LateRemedy::at_once;
      blend_ = is_whole ? 1.0 : 0.0;
    }
  }
  const double step = std::min(1.0, elapsed_s / kBlendS);
  const double left = 1.0 - blend_;
  const Window& older = left > 0.0 ? *old_ : *new_;
  double before_mj =
      std::lerp(felt_of(older, tool_).energy_mj, felt_of(*new_, tool_).energy_mj, blend_);
  const bool is_inside = !is_outside(*new_, tool_) && !is_outside(older, tool_);
  // A tool that had left its window is not known to feel less than it last did.
  if (!is_inside) before_mj = std::max(before_mj, felt_mj_);
  blend_ = is_near(std::min(1.0, blend_ + step), 1.0) ? 1.0 : std::min(1.0, blend_ + step);
  const bool holds_back =
      what_.remedy != LateRemedy::at_once && what_.remedy != LateRemedy::blended;
  if (holds_back) hold_back(older, left, step, before_mj * share_ / share());
  share_ = share();
  if (is_inside) felt_mj_ = energy_at(tool_) / share_;
}

/// Of the new window what is not paid for, `before_mj` having been felt: evenly over what is left
/// of the blend, and afterwards as far as the blend would go in a tick.
void LatePlane::hold_back(const Window& old, double left, double step, double before_mj) noexcept {
  Window whole = *new_;
  whole.held = {};
  const double whole_mj = felt_of(whole, tool_).energy_mj;
  const double kept_mj = (1.0 - blend_) * felt_of(old, tool_).energy_mj;
  double paid_mj = account_.saved_nmm() / share();
  paid_mj = left > 0.0 ? paid_mj * std::min(1.0, step / left)
                       : std::min(paid_mj, step * std::max(0.0, whole_mj - before_mj));
  constexpr double kMostN = 8.0;
  new_->held = haptics::HeldEnergy::of(whole_mj, (before_mj + paid_mj - kept_mj) / blend_,
                                       kMostN * kMostN / kBearNPerMm);
  const double after_mj = kept_mj + blend_ * felt_of(*new_, tool_).energy_mj;
  account_.pay(std::min(account_.saved_nmm(), share() * (after_mj - before_mj)));
}

void LatePlane::begin_tick(const haptics::HandleState& handle) noexcept {
  const double elapsed_s = has_tool_ ? handle.time_s - tool_.time_s : 0.0;
  if (!law_.tool().is_spring()) mode_.tick(handle.is_active, elapsed_s);
  account_.tick(elapsed_s, length(handle.velocity_mm_per_s));
  fastest_mm_per_s_ = std::max(fastest_mm_per_s_, std::abs(handle.velocity_mm_per_s.x));
  if (has_tool_) exchange(elapsed_s);
}

/// What the tool does to the clay where it is.
void LatePlane::work(const haptics::HandleState& tool) noexcept {
  const double y = tool.position_mm.y;
  const double elapsed_s = has_tool_ ? tool.time_s - tool_.time_s : 0.0;
  cutting_s_ = tool.is_active ? cutting_s_ + elapsed_s : 0.0;
  if (!tool.is_active) return;
  switch (what_.action) {
    case LateAction::carve: {
      surface_mm_ = std::min(surface_mm_, y - law_.cut_mm());
      if (what_.remedy != LateRemedy::stamped) break;
      const double grown = std::min(1.0, cutting_s_ / haptics::OwnCuts::kGrowS);
      cut_mm_ = std::min(cut_mm_.value_or(1e9), y - grown * law_.cut_mm());
      break;
    }
    case LateAction::add:
      surface_mm_ = std::max(surface_mm_, y + law_.tool().radius_mm);
      break;
    case LateAction::smooth:
      surface_mm_ += (rim_mm_ - surface_mm_) * (1.0 - std::exp(-elapsed_s / kSmoothS));
      break;
    case LateAction::touch:
    case LateAction::slide:
      break;
  }
}

/// A window, when one is due.
void LatePlane::answer(const haptics::HandleState& tool) {
  if (tool.time_s + 1e-9 < next_s_) return;
  next_s_ += what_.late.period_s;
  Window window;
  window.surface_mm = surface_mm_;
  window.middle_mm = tool.position_mm.x;
  window.half_mm = kHalfWindowMm;
  if (what_.remedy == LateRemedy::reaching) {
    const double until_felt_s = what_.late.age_s + what_.late.period_s + kBlendS;
    window.half_mm = std::max(kHalfWindowMm, fastest_mm_per_s_ * until_felt_s);
  }
  coming_.push_back({tool.time_s + what_.late.age_s, window});
}

void LatePlane::end_tick(const haptics::HandleState& tool) noexcept {
  work(tool);
  answer(tool);
  tool_ = tool;
  has_tool_ = true;
}

haptics::WindowStamp LatePlane::window_stamp() const noexcept {
  haptics::WindowStamp stamp;
  if (tool_.is_active && what_.action == LateAction::carve && !cut_mm_) {
    stamp.lateness_s = what_.late.age_s + 0.5 * (what_.late.period_s + kBlendS);
  }
  return stamp;
}

}  // namespace argil::evaluation
