// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/falcon_session.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "falcon/falcon_boot.h"

namespace argil::haptics {
namespace {

constexpr int kProbes = 25;
constexpr double kProbeS = 0.02;
constexpr int kAttempts = 10;
constexpr double kGoodbyeS = 0.02;
/// A hand moves the tip at up to 3 m/s, 75 ticks a millisecond at the most; less is no jump.
constexpr double kMostTicksPerS = 1e5;
constexpr double kTicksOfNoise = 10.0;
/// What an exchange takes at the most, of the time that the gate's limits count by: after a longer
/// one the force grows no further in a packet than after this.
constexpr double kMostGateS = 3e-3;
/// For two packets of the chip, which sends one each millisecond.
constexpr double kPacketsS = 5e-3;
constexpr double kRoundTripWeight = 0.05;  ///< of a new one in the mean

static_assert(kFalconMostPeriodS < FalconSession::kServoLateS, "or it fades between two ticks");

SafetyOptions gate_options(const FalconOptions& options) {
  SafetyOptions safety;
  safety.most_force_n = options.most_force_n;
  safety.most_slew_n_per_s = options.most_slew_n_per_s;
  return safety;
}

/// The grip's buttons as a Device has them: the large one in its centre works the clay.
std::uint32_t device_buttons(std::uint32_t grip) noexcept {
  constexpr std::uint32_t kCentre = 4U;
  const std::uint32_t right_and_front = grip & 3U;
  return ((grip & kCentre) != 0 ? 1U : 0U) | right_and_front << 1U | (grip & 8U);
}

}  // namespace

FalconSession::FalconSession(const FalconOptions& options, std::optional<FalconFirmware> firmware,
                             LinkClock& clock, FalconMailbox& mailbox)
    : options_(options),
      firmware_(std::move(firmware)),
      clock_(clock),
      mailbox_(mailbox),
      kinematics_(options.calibration.geometry),
      gate_(gate_options(options)) {}

// Opening and closing.

FalconFault FalconSession::open() {
  close();
  status_ = {};
  is_located_ = is_late_ = false;
  awaited_ = 0;
  wanted_ = {};
  parser_ = {};
  auto opened = FalconLink::open(options_.serial, clock_);
  if (!opened) return fail(opened.error());
  link_ = std::move(opened).value();
  enter(FalconState::probing);
  return FalconFault::none;
}

FalconFault FalconSession::connect() {
  if (state() != FalconState::probing) return status_.fault;
  FalconFault fault = start_running();
  if (fault == FalconFault::no_firmware && firmware_) fault = upload();
  if (fault != FalconFault::none) return fail(fault);
  if (is_stopped_) return FalconFault::none;
  reply_s_ = settled_s_ = gate_s_ = clock_.now_s();
  enter(FalconState::unhomed);
  return FalconFault::none;
}

FalconFault FalconSession::home() {
  if (state() != FalconState::fault) return FalconFault::none;
  if (const FalconFault fault = open(); fault != FalconFault::none) return fault;
  return connect();
}

/// no_firmware when nothing answers.
FalconFault FalconSession::start_running() {
  assert(link_);
  if (const FalconFault fault = enter_run_mode(*link_, options_.flushes_at_packet_end);
      fault != FalconFault::none) {
    return fault;
  }
  if (answers() || is_stopped_) return FalconFault::none;
  return link_->failure() != FalconFault::none ? link_->failure() : FalconFault::no_firmware;
}

/// One lost reply says nothing: asked with zero words again and again.
bool FalconSession::answers() {
  for (int n = 0; n < kProbes && !is_stopped_; ++n) {
    if (!link_->is_sending()) {
      awaited_ = 0;
      if (send({}) != FalconFault::none) return false;
    }
    const double until_s = clock_.now_s() + kProbeS;
    while (clock_.now_s() < until_s) {
      if (link_->wait_until(until_s) != FalconFault::none) return false;
      take_bytes();
      if (awaited_ == 0) return true;
    }
  }
  return false;
}

/// Several attempts are usual; each but the first opens the device again.
FalconFault FalconSession::upload() {
  assert(link_ && firmware_);
  FalconFault fault = FalconFault::none;
  for (status_.attempt = 1; status_.attempt <= kAttempts && !is_stopped_; ++status_.attempt) {
    status_.uploaded = 0.0;
    enter(FalconState::uploading);
    if (status_.attempt > 1) {
      link_.reset();
      auto opened = FalconLink::open(options_.serial, clock_);
      if (!opened) return opened.error();
      link_ = std::move(opened).value();
    }
    fault = upload_falcon_firmware(*link_, clock_, *firmware_, [this](double share) {
      status_.uploaded = share;
      publish();
      return !is_stopped_;
    });
    if (fault == FalconFault::none) fault = start_running();
    if (fault == FalconFault::none || fault == FalconFault::unplugged) return fault;
    if (fault == FalconFault::no_firmware) fault = FalconFault::not_started;
  }
  status_.attempt = std::min(status_.attempt, kAttempts);
  return fault;
}

void FalconSession::close() noexcept {
  say_goodbye();
  link_.reset();
  say_not_ready();
  enter(FalconState::closed);
}

/// Zero words, if there is still a link: one on which something failed may well carry them, and the
/// motors hold what they were told last.
void FalconSession::say_goodbye() noexcept {
  status_.force_n = {};
  status_.word = {};
  if (link_) link_->send_last(encode(command_of({})), kGoodbyeS);
}

FalconFault FalconSession::fail(FalconFault fault) noexcept {
  say_goodbye();
  link_.reset();
  status_.fault = fault;
  status_.is_pulled_out = false;
  say_not_ready();
  enter(FalconState::fault);
  return fault;
}

void FalconSession::enter(FalconState state) noexcept {
  status_.state = state;
  publish();
}

void FalconSession::publish() noexcept {
  status_.dropped_bytes = parser_.dropped_bytes();
  if (link_) status_.has_line_error = link_->has_line_error();
  mailbox_.statuses.write_slot() = status_;
  mailbox_.statuses.publish();
}

void FalconSession::say_not_ready() noexcept {
  mailbox_.readings.write_slot() = {{{}, 0, false}, status_.round_trip_s};
  mailbox_.readings.publish();
}

// Running.

void FalconSession::run_until(double time_s) {
  while (clock_.now_s() < time_s && !is_stopped_) {
    const bool is_running = state() == FalconState::unhomed || state() == FalconState::active;
    if (is_running) {
      if (const FalconFault fault = exchange_until(time_s); fault != FalconFault::none) fail(fault);
    } else if (const double wait_s = clock_.wait_s(time_s); wait_s > 0.0) {
      std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    }
  }
}

/// One look at the link: sends when a packet is due, takes what arrived, and watches for lost
/// replies.
FalconFault FalconSession::exchange_until(double time_s) {
  assert(link_ && awaited_ >= 0);
  if (mailbox_.forces.fetch()) wanted_ = mailbox_.forces.read_slot();
  const bool is_due = awaited_ == 0 || is_forsaken();
  if (is_due && !link_->is_sending()) {
    if (const FalconFault fault = send(force_now()); fault != FalconFault::none) return fault;
    if (!is_finite(wanted_.force_n)) return FalconFault::force_not_finite;
  }
  const FalconFault fault = link_->wait_until(std::min(time_s, next_look_s()));
  if (fault != FalconFault::none) return fault;
  take_bytes();
  const double now_s = clock_.now_s();
  if (awaited_ > 0 && now_s >= sent_s_ + kReplyS) {
    if (now_s >= reply_s_ + kSilenceS) return FalconFault::silent;
    return ask_again();
  }
  return FalconFault::none;
}

/// When something is due though nothing happens: a reply is lost, or a force is to be let go.
double FalconSession::next_look_s() const noexcept {
  const double lost_s = sent_s_ + kReplyS;
  return holds_force() && !link_->is_sending() ? std::min(lost_s, gone_s()) : lost_s;
}

/// Whether the motors push: they go on with what they were told last.
bool FalconSession::holds_force() const noexcept {
  return status_.word != std::array<std::int16_t, 3>{};
}

/// Whether they push by a word of a servo that has fallen silent. Then no reply is waited for: it
/// may be lost, which is known only after kReplyS.
bool FalconSession::is_forsaken() const noexcept {
  return holds_force() && clock_.now_s() >= gone_s();
}

/// After a reply that did not come: sends zero words, and gives no force until a reply comes. Words
/// that still push are replaced first, since forgetting what may yet come takes time.
FalconFault FalconSession::ask_again() {
  assert(link_);
  is_late_ = true;
  say_not_ready();
  if (link_->is_sending()) {
    sent_s_ = clock_.now_s();
    return FalconFault::none;
  }
  if (holds_force()) return send({});
  status_.lost_replies += static_cast<std::uint64_t>(awaited_);
  if (const FalconFault fault = forget_replies(); fault != FalconFault::none) return fault;
  awaited_ = 0;
  return send({});
}

/// A late reply must not pass for that to the next packet. The chip forgets what it has not sent;
/// what it had sent comes before the packet after the next, which may have been sent as well.
FalconFault FalconSession::forget_replies() {
  if (const FalconFault fault = link_->control(kFtdiPurgeIn); fault != FalconFault::none) {
    return fault;
  }
  const double until_s = clock_.now_s() + kPacketsS;
  for (const auto begin = link_->packets(); link_->packets() < begin + 2;) {
    if (clock_.now_s() >= until_s) break;
    if (const FalconFault fault = link_->wait_until(until_s); fault != FalconFault::none) {
      return fault;
    }
  }
  link_->clear_received();
  parser_.reset();
  return FalconFault::none;
}

/// Words for a force where the handle is, and the lights: red not homed, blue homed, green active.
FalconCommand FalconSession::command_of(const Vec3& force_n) const noexcept {
  FalconCommand command;
  command.word = kinematics_.motor_words(force_n, position_mm_).word;
  command.is_homing = true;  // it stays homed only while it is told to
  const bool is_homed = is_located_;
  command.red = !is_homed;
  command.green = is_homed && state() == FalconState::active;
  command.blue = is_homed && !command.green;
  return command;
}

FalconFault FalconSession::send(const Vec3& force_n) {
  assert(link_ && !link_->is_sending());
  const FalconCommand command = command_of(force_n);
  sent_s_ = clock_.now_s();
  ++awaited_;
  status_.force_n = force_n;
  status_.word = command.word;
  return link_->send(encode(command));
}

void FalconSession::take_bytes() {
  for (const std::uint8_t byte : link_->received()) {
    if (const auto reply = parser_.push(byte)) take(*reply);
  }
  link_->clear_received();
}

/// Whether the encoders can have come from the last reply's counts in that time.
bool FalconSession::is_plausible(const FalconReply& reply, double elapsed_s) const noexcept {
  const double most = kTicksOfNoise + kMostTicksPerS * elapsed_s;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    if (reply.is_homed[leg] != status_.is_homed[leg]) return false;
    if (std::abs(reply.tick[leg] - status_.tick[leg]) > most) return false;
  }
  return true;
}

/// The position of a reply; false when the arms cannot be at such angles.
bool FalconSession::locate(const FalconReply& reply) noexcept {
  LegValues ticks{};
  std::copy(reply.tick.begin(), reply.tick.end(), ticks.begin());
  const auto found =
      kinematics_.position_of(kinematics_.angles_of_ticks(ticks),
                              is_located_ ? position_mm_ : options_.calibration.center_mm);
  if (found.is_converged) position_mm_ = found.position_mm;
  return found.is_converged;
}

/// A whole reply: round trip, homing, position, and whether force may be given from now on.
void FalconSession::take(const FalconReply& reply) {
  const double now_s = clock_.now_s();
  if (awaited_ == 1) {  // of two it is not known which of them this is
    const double trip_s = now_s - sent_s_;
    const double weight = status_.round_trip_s > 0.0 ? kRoundTripWeight : 1.0;
    status_.round_trip_s += weight * (trip_s - status_.round_trip_s);
  }
  // After a jump or a gap (also one of this thread, which finds its reply waiting), what was before
  // means nothing for the motion since then: long enough without force for the servo to see it.
  const double gap_s = now_s - reply_s_;
  if (is_late_ || gap_s > kReplyS || !is_plausible(reply, gap_s)) settled_s_ = now_s + kSettleS;
  awaited_ = std::max(0, awaited_ - 1);
  is_late_ = false;
  reply_s_ = now_s;
  ++status_.replies;
  status_.tick = reply.tick;
  status_.is_homed = reply.is_homed;
  status_.buttons = reply.buttons;
  is_located_ = locate(reply) && reply.all_homed();
  status_.position_mm = position_mm_ - options_.calibration.center_mm;
  if (!reply.all_homed()) status_.is_pulled_out = false;
  if (is_located_ && now_s >= settled_s_ &&
      status_.position_mm.z > options_.calibration.pulled_out_mm) {
    status_.is_pulled_out = true;
  }
  if (state() == FalconState::unhomed || state() == FalconState::active) {
    status_.state = status_.is_pulled_out ? FalconState::active : FalconState::unhomed;
  }
  const bool is_ready = may_give_force();
  mailbox_.readings.write_slot() = {
      {status_.position_mm, device_buttons(status_.buttons), is_ready}, status_.round_trip_s};
  mailbox_.readings.publish();
  publish();
}

bool FalconSession::may_give_force() const noexcept {
  return state() == FalconState::active && is_located_ && !is_late_ && reply_s_ >= settled_s_;
}

/// The servo's newest force as far as it is safe.
Vec3 FalconSession::force_now() {
  const double now_s = clock_.now_s();
  std::uint32_t faults = kServoSound;
  if (!may_give_force()) faults |= kDeviceLost;
  if (wanted_.is_cut) faults |= kStopping;
  if (now_s - wanted_.time_s > kServoHangsS) faults |= kWindowStale;
  const double period_s = std::clamp(now_s - gate_s_, 0.0, kMostGateS);
  const Vec3 force_n =
      gate_.limit(wanted_.force_n + options_.calibration.gravity_n, faults, period_s);
  gate_s_ = now_s;
  // Behind the gate, whose slew would take longer to let go.
  assert(is_finite(force_n));
  const double held = std::clamp((gone_s() - now_s) / (kServoGoneS - kServoLateS), 0.0, 1.0);
  share_ = std::min(held, share_ + period_s / kServoBackS);
  return share_ * force_n;
}

}  // namespace argil::haptics
