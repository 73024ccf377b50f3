// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_clay.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// A tick that rounds to just before a sample's time still takes it.
constexpr double kClockSlackS = 1e-9;

/// How long a fast motion and a late window are remembered.
constexpr double kRememberedS = 0.3;

double margin_of(const ClaySceneOptions& options) noexcept {
  return options.margin_mm.value_or(resting_margin_mm(options.tool));
}

/// The window that a resting tool needs.
ToolSample request_for(const ClaySceneOptions& options) noexcept {
  const Lattice lattice = choose_lattice(options.tool);
  ToolSample request;
  request.orientation = options.tool.orientation;
  request.voxel_mm = lattice.voxel_mm;
  request.reach_mm = std::min(window_reach_mm(options.tool, lattice, margin_of(options)),
                              kMostWindowReachVoxels * lattice.voxel_mm);
  request.depth_mm = window_depth_mm(options.tool, options.material, lattice);
  request.wants_detail = options.texture.has_value();
  return request;
}

}  // namespace

ClayScene::ClayScene(const ClaySceneOptions& options, ToolSampleRing& ring,
                     WindowChannel& channel) noexcept
    : options_(options),
      ring_(ring),
      servo_(channel, options.material, options.law, options.method, options.account,
             options.own_cut_mm),
      request_(request_for(options)),
      blend_(options.mix_ramp_s),
      is_cut_(options.samples_before > 0),
      samples_(options.samples_before),
      answered_(options.samples_before) {
  assert(options.sample_period_s > 0.0 && options.stale_after_s > 0.0 && margin_of(options) >= 0.0);
  assert(is_finite(options.offset_mm) && validate(options.mix).ok());
  if (options.texture) texture_.emplace(*options.texture);
}

/// The tool at a handle of the device, in the clay's frame; it does not turn.
ForceTool ClayScene::tool_at(const HandleState& handle) const noexcept {
  ForceTool tool = options_.tool;
  tool.position_mm = handle.position_mm + options_.offset_mm;
  tool.velocity_mm_per_s = handle.velocity_mm_per_s;
  tool.angular_velocity_rad_per_s = {};
  return tool;
}

/// Half of what the clay gathers between two samples, the mean age of what is felt, and half of the
/// exchange.
double ClayScene::lateness_s() const noexcept {
  if (!was_active_ || options_.own_cut_mm > 0.0 || age_s_ < 0.0) return 0.0;
  return 0.5 * options_.sample_period_s + age_s_ + 0.5e-3 * ServoForce::kBlendMs;
}

/// The speed and the age that the next window has to hold the tool at.
void ClayScene::learn(const HandleState& handle) noexcept {
  const double kept = std::max(0.0, 1.0 - passed_s_ / kRememberedS);
  fastest_mm_per_s_ = std::max(kept * fastest_mm_per_s_, length(handle.velocity_mm_per_s));
  oldest_s_ = std::max(kept * oldest_s_, age_s_);
}

/// In whole voxels, so that a window is not wanted anew for every change of the speed.
double ClayScene::reach_mm() const noexcept {
  // A hand that starts off has left a small margin before late clay has heard of it.
  constexpr double kPromptS = 0.02;
  constexpr double kLateMarginMm = 4.0;
  const double moving_mm = fastest_mm_per_s_ * (oldest_s_ + 1e-3 * ServoForce::kBlendMs);
  const double margin_mm = std::max(moving_mm, oldest_s_ > kPromptS ? kLateMarginMm : 0.0);
  const double resting_mm = margin_of(options_);
  if (margin_mm <= resting_mm) return request_.reach_mm;
  const double voxel_mm = request_.voxel_mm;
  const double more_mm = voxel_mm * std::ceil((margin_mm - resting_mm) / voxel_mm);
  return std::min(request_.reach_mm + more_mm, kMostWindowReachVoxels * voxel_mm);
}

/// Due on a fixed grid of the servo's clock, so that what the clay hears does not depend on the
/// rate of the ticks; and at once when the hand starts or stops working.
bool ClayScene::is_sample_due(const HandleState& tool) noexcept {
  const bool is_edge = tool.is_active != was_active_;
  was_active_ = tool.is_active;
  if (tool.time_s + kClockSlackS < next_sample_s_) return is_edge;
  next_sample_s_ += options_.sample_period_s;
  // After the first tick or a gap of the servo the grid starts over.
  if (next_sample_s_ <= tool.time_s) next_sample_s_ = tool.time_s + options_.sample_period_s;
  return true;
}

void ClayScene::push_sample(const HandleState& tool) noexcept {
  assert(is_finite(tool.position_mm));  // the clay's thread takes it for a pose
  ToolSample sample = request_;
  sample.index = ++samples_;
  sample.reach_mm = reach_mm();
  sample.time_s = tool.time_s;
  sample.position_mm = tool.position_mm + options_.offset_mm;
  sample.is_active = tool.is_active && !is_cut_;
  sample.pressure = sample.is_active ? 1.0 : 0.0;
  if (samples_ == answered_ + 1) oldest_unanswered_s_ = tool.time_s;
  // A drop is counted there, and answered with a later sample.
  if (ring_.push(sample)) is_cut_ = false;
}

/// The clock went back: what is answered now was asked by another, whose times mean nothing here.
/// Otherwise the age of what is unanswered keeps growing, whatever was forgotten.
void ClayScene::start_clock(double now_s) noexcept {
  next_sample_s_ = now_s;
  clock_start_s_ = now_s;
  clock_start_sample_ = samples_;
  oldest_unanswered_s_ = now_s;
}

/// Only a stroke that is open has to be cut.
void ClayScene::forget_motion() noexcept {
  servo_.forget_motion();
  if (texture_) texture_->forget_motion();
  has_tool_ = false;
  is_cut_ = is_cut_ || was_active_;
}

void ClayScene::end_stroke() noexcept {
  if (!was_active_) return;
  was_active_ = false;
  HandleState tool;
  tool.position_mm = tool_mm_;
  tool.time_s = last_tick_s_;
  push_sample(tool);
}

/// The sample after the one answered is not older than that one: its time stands for it, which
/// makes the age at most one period too large and needs no list of unanswered samples.
void ClayScene::hear_answer() noexcept {
  const WindowSlot& slot = servo_.window();
  const bool is_of_this_clock = slot.answers > clock_start_sample_;
  age_s_ = is_of_this_clock ? std::max(0.0, last_tick_s_ - slot.time_s) : -1.0;
  if (slot.answers <= answered_) return;
  answered_ = slot.answers;
  oldest_unanswered_s_ = answered_ > clock_start_sample_ ? slot.time_s : clock_start_s_;
}

void ClayScene::judge(double now_s) noexcept {
  const bool is_stale =
      samples_ > answered_ && !(now_s - oldest_unanswered_s_ <= options_.stale_after_s);
  const bool has_stopped =
      options_.heartbeat != nullptr && !options_.heartbeat->alive.load(std::memory_order_acquire);
  faults_ = (is_stale ? kSceneWindowStale : kSceneSound) |
            (has_stopped ? kSceneClayStopped : kSceneSound);
}

void ClayScene::begin_tick(const HandleState& handle) noexcept {
  if (!has_ticked_ || handle.time_s < last_tick_s_) {
    start_clock(handle.time_s);
    last_tick_s_ = handle.time_s;
    has_ticked_ = true;
  }
  passed_s_ = handle.time_s - last_tick_s_;
  assert(!(passed_s_ < 0.0));
  last_tick_s_ = handle.time_s;
  blend_.tick(handle.is_active, passed_s_);
  // The tool is where the last tick left it: deep in the clay the handle itself may have no window.
  HandleState tool = handle;
  if (has_tool_) tool.position_mm = tool_mm_;
  servo_.begin_tick(tool_at(tool), passed_s_, contact_share(options_.mix, blend_.p()));
  if (texture_) feel_texture(tool_at(tool));
  hear_answer();
  learn(handle);
  judge(handle.time_s);
}

/// The texture stays as it is from here to the end of the tick, so that a search for the proxy
/// meets one force for one place.
void ClayScene::feel_texture(const ForceTool& tool) noexcept {
  const bool is_touching = servo_.at(tool).contact_n != Vec3{};
  texture_->tick(window().detail, tool.position_mm, is_touching, passed_s_);
}

void ClayScene::end_tick(const HandleState& tool) noexcept {
  tool_mm_ = tool.position_mm;
  has_tool_ = true;
  servo_.cut(tool_at(tool), passed_s_, tool.is_active && !is_cut_);
  if (is_sample_due(tool)) push_sample(tool);
}

SceneForce ClayScene::force_at(const HandleState& handle) const noexcept {
  const ForceResult felt = servo_.at(tool_at(handle));
  SceneForce force;
  const double p = blend_.p();
  const Vec3 contact_n = texture_ ? texture_->added_to(felt.contact_n) : felt.contact_n;
  force.force_n = mix_forces(options_.mix, contact_n, felt.viscosity_n, p);
  force.stiffness_n_per_m = 1e3 * contact_share(options_.mix, p) * felt.stiffness_n_per_mm;
  force.faults = faults_;
  if (window().sequence == 0) {
    force.faults |= kSceneWaiting;
  } else if (felt.outside_window) {
    force.faults |= kSceneOutsideWindow;
  }
  return force;
}

Vec3 ClayScene::touch_n(const HandleState& handle) const noexcept {
  return contact_share(options_.mix, 0.0) * servo_.at(tool_at(handle)).contact_n;
}

double ClayScene::energy_at(const HandleState& handle) const noexcept {
  return contact_share(options_.mix, blend_.p()) * servo_.at(tool_at(handle)).energy_nmm;
}

}  // namespace argil::haptics
