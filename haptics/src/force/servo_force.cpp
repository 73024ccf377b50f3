// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/servo_force.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

bool same_shape(const ForceTool& a, const ForceTool& b) noexcept {
  return a.shape == b.shape && a.radii_mm == b.radii_mm;
}

/// How stiffly a hand is borne that presses on into clay whose energy is held back: about as a
/// coupling may be at 1 kHz.
constexpr double kBearNPerMm = 1.0;

/// The energy of a window; off the clay its table leaves some 1e-6 of either sign.
double energy_of(const ForceResult& result) noexcept { return std::max(0.0, result.energy_nmm); }

/// Leaves what is felt of a window while energy is held back, `part` of it.
void weigh(ForceResult& felt, const HeldEnergy& held, double part) noexcept {
  const double energy_nmm = energy_of(felt);
  const double contact = part * held.share(energy_nmm);
  felt.contact_n = contact * felt.contact_n;
  felt.contact_nmm = contact * felt.contact_nmm;
  felt.energy_nmm = part * held.felt(energy_nmm);
  felt.stiffness_n_per_mm *= contact;
  felt.error_n *= contact;
  felt.viscosity_n = part * felt.viscosity_n;
  felt.viscosity_nmm = part * felt.viscosity_nmm;
}

/// Adds what is felt of another window; whether the tool is outside is said by the first.
void add(ForceResult& felt, const ForceResult& other) noexcept {
  felt.contact_n += other.contact_n;
  felt.contact_nmm += other.contact_nmm;
  felt.energy_nmm += other.energy_nmm;
  felt.stiffness_n_per_mm += other.stiffness_n_per_mm;
  felt.error_n += other.error_n;
  felt.viscosity_n += other.viscosity_n;
  felt.viscosity_nmm += other.viscosity_nmm;
  felt.samples += other.samples;
}

/// How far around the tool a cut is taken out of a window: the kernel, and what the tool moves
/// until the next tick. No farther than a tool that the window was made for reaches, so that a tick
/// has a bound while a larger tool waits for its own.
double cut_reach_mm(const ForceTool& tool, const WindowSlot& window) noexcept {
  constexpr double kMostVoxels = 12.0;
  const Vec3& radii = tool.radii_mm;
  const double kernel = kKernelSupport * std::max({radii.x, radii.y, radii.z});
  return std::min(kernel, kMostVoxels * window.voxel_mm) + 2.0 * window.voxel_mm;
}

}  // namespace

ServoForce::ServoForce(WindowChannel& channel, const ForceMaterial& material, ForceLaw law,
                       ForceMethod method, const EnergyAccountOptions& account,
                       double own_cut_mm) noexcept
    : channel_(channel),
      material_(material),
      law_(law),
      method_(method),
      account_(account),
      cuts_(own_cut_mm) {}

/// All of one window at a pose, with the shape that is felt on it.
ForceResult ServoForce::query(const Felt& felt, const ForceTool& pose) const noexcept {
  ForceResult result;
  result.outside_window = true;
  if (!felt.sum) return result;
  const FieldWindowView view = channel_.read_slot(felt.place).view();
  if (felt.is_point) return point_energy_force(view, pose, material_);
  return method_ == ForceMethod::point ? point_force(view, pose, material_)
                                       : felt.sum->evaluate(view, pose);
}

/// Whether the window that is felt would fit the tool, which has another shape than is felt.
bool ServoForce::is_retooled(const ForceTool& tool) const noexcept {
  return new_.sum && !same_shape(tool, new_.tool) &&
         window().voxel_mm == choose_lattice(tool).voxel_mm;
}

bool ServoForce::may_choose() const noexcept {
  return method_ == ForceMethod::automatic && law_ == ForceLaw::energy && new_.sum.has_value();
}

/// Whether the centre is enough for the tool that is felt, where it is now.
void ServoForce::choose(const ForceTool& tool, double elapsed_s) noexcept {
  if (!may_choose()) return;
  ForceTool felt = new_.tool;
  felt.position_mm = tool.position_mm;
  choice_.tick(window().view(), felt, material_, elapsed_s);
}

/// Makes the sum fit the newest window: for the new tool when the window is meant for it, else for
/// the one that is felt. A window for neither is not summed: how many nodes of it would lie under
/// the tool would have no bound.
void ServoForce::fit(const ForceTool& tool) noexcept {
  const double voxel = window().voxel_mm;
  const bool fits_tool = voxel == choose_lattice(tool).voxel_mm;
  if (!fits_tool && (!new_.sum || voxel != new_.sum->voxel_mm())) return;
  const ForceTool& felt = fits_tool ? tool : new_.tool;
  if (new_.sum && new_.sum->voxel_mm() == voxel && same_shape(felt, new_.tool)) return;
  assert(voxel > 0.0);
  new_.tool = felt;
  new_.sum.emplace(new_.tool, material_, law_, voxel);
}

/// Begins to go over to the newest window, or to another tool, or from sum to centre, in the same
/// one. Where nothing was
/// felt before there is nothing to go over from.
void ServoForce::take_window(const ForceTool& tool) noexcept {
  old_ = new_;
  if (channel_.has_fresh()) {
    new_.place = 1 - old_.place;
    channel_.fetch(new_.place);
    cuts_.stamp_all(channel_.held_slot(new_.place), tool.position_mm, cut_reach_mm(tool, window()));
  }
  fit(tool);
  if (may_choose()) {
    ForceTool felt = new_.tool;
    felt.position_mm = tool.position_mm;
    choice_.look_again(window().view(), felt, material_);
    new_.is_point = choice_.is_point();
  }
  const bool is_first = !old_.sum || is_anew_;
  new_.held = {};
  blend_ = is_first ? 1.0 : 0.0;
  is_anew_ = is_anew_ && !new_.sum;
}

/// Goes one tick on from the old window to the new one, and holds back of the new one what the
/// account does not pay at the tool's place.
void ServoForce::exchange(const ForceTool& tool, double elapsed_s, double contact_share) noexcept {
  const double step = std::clamp(1e3 * elapsed_s / kBlendMs, 0.0, 1.0);
  const bool is_blending = blend_ < 1.0;
  const ForceResult newer = query(new_, tool);
  const ForceResult older = is_blending ? query(old_, tool) : ForceResult{};
  const double newer_nmm = energy_of(newer);
  const double older_nmm = old_.held.felt(energy_of(older));
  double before_nmm = blend_ * new_.held.felt(newer_nmm) + (1.0 - blend_) * older_nmm;
  const bool is_inside = !newer.outside_window && !(is_blending && older.outside_window);
  if (!is_inside) before_nmm = std::max(before_nmm, felt_nmm_);
  // To the hand it is the same energy when it feels another share of it.
  before_nmm *= share_ / contact_share;
  share_ = contact_share;

  // What is saved is not spent in one tick, which would be felt as a step: evenly over what is left
  // of the blend, and after it by as much of what is held back as the blend would go.
  const double left = 1.0 - blend_;
  blend_ = blend_ + step < 1.0 - 1e-9 ? blend_ + step : 1.0;  // sums of 0.2 end beside 1
  const double kept_nmm = (1.0 - blend_) * older_nmm;
  double paid_nmm = account_.saved_nmm() / contact_share;
  paid_nmm = is_blending ? paid_nmm * std::min(1.0, step / left)
                         : std::min(paid_nmm, step * std::max(0.0, newer_nmm - before_nmm));
  if (blend_ > 0.0) {
    const double clamp_n = material_.clamp_ratio * material_.surface_force_n;
    const double most_knee_nmm = clamp_n * clamp_n / kBearNPerMm;
    new_.held =
        HeldEnergy::of(newer_nmm, (before_nmm + paid_nmm - kept_nmm) / blend_, most_knee_nmm);
    // So little is not worth the sums.
    if (!is_blending && newer_nmm - new_.held.felt(newer_nmm) < 1e-6) new_.held = {};
  }
  const double after_nmm = kept_nmm + blend_ * new_.held.felt(newer_nmm);
  account_.pay(std::min(account_.saved_nmm(), contact_share * (after_nmm - before_nmm)));
  if (is_inside) felt_nmm_ = after_nmm;
}

void ServoForce::begin_tick(const ForceTool& tool, double elapsed_s,
                            double contact_share) noexcept {
  assert(contact_share > 0.0);
  account_.tick(elapsed_s, length(tool.velocity_mm_per_s));
  choose(tool, elapsed_s);
  const bool is_due = channel_.has_fresh() || is_retooled(tool) ||
                      (may_choose() && choice_.is_point() != new_.is_point);
  if (blend_ >= 1.0 && is_due) take_window(tool);
  exchange(tool, elapsed_s, contact_share);
}

void ServoForce::cut(const ForceTool& tool, double elapsed_s, bool is_cutting) noexcept {
  cuts_.move_to(tool.position_mm, elapsed_s, is_cutting);
  if (!cuts_.is_cutting()) return;
  cuts_.stamp_newest(channel_.held_slot(new_.place), cut_reach_mm(tool, window()));
  // Of a tool of another size old and new window may be one.
  if (blend_ >= 1.0 || old_.place == new_.place) return;
  const WindowSlot& older = channel_.read_slot(old_.place);
  cuts_.stamp_newest(channel_.held_slot(old_.place), cut_reach_mm(tool, older));
}

ForceResult ServoForce::at(const ForceTool& pose) const noexcept {
  ForceResult felt = query(new_, pose);
  if (blend_ >= 1.0 && new_.held.is_nothing()) return felt;
  weigh(felt, new_.held, blend_);
  if (blend_ >= 1.0) return felt;
  ForceResult older = query(old_, pose);
  weigh(older, old_.held, 1.0 - blend_);
  add(felt, older);
  return felt;
}

ForceResult ServoForce::tick(const ForceTool& tool, double elapsed_s) noexcept {
  begin_tick(tool, elapsed_s);
  return at(tool);
}

}  // namespace argil::haptics
