// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "argil/haptics/falcon/falcon_device.h"
#include "argil/haptics/falcon/falcon_firmware.h"
#include "argil/haptics/falcon/falcon_kinematics.h"
#include "argil/haptics/servo/safety_gate.h"

#include "falcon/falcon_link.h"
#include "falcon/falcon_mailbox.h"
#include "falcon/falcon_packet.h"
#include "falcon/link_clock.h"

namespace argil::haptics {

/// All that a Falcon goes through, from its opening to its end, on whatever clock it is given: the
/// same code runs on the machine's time and on a virtual one.
///
///   closed --open--> probing --connect--> [uploading] --> unhomed <--> active
///   any but closed --> fault --home--> probing ...
///
/// Threads  one, for all but the mailbox's other ends and `stop`.
class FalconSession {
 public:
  /// Both must outlive it.
  FalconSession(const FalconOptions& options, std::optional<FalconFirmware> firmware,
                LinkClock& clock, FalconMailbox& mailbox);
  ~FalconSession() { close(); }
  FalconSession(const FalconSession&) = delete;
  FalconSession& operator=(const FalconSession&) = delete;

  FalconFault open();     ///< to probing, or to a fault
  FalconFault connect();  ///< from probing to unhomed, or to a fault; takes up to seconds
  FalconFault home();     ///< from a fault: open and connect

  /// Exchanges packets until the clock is there; in a state without a link only time passes.
  void run_until(double time_s);

  /// After an exception, which may have left anything half done: zero words, and to a fault.
  void give_up() noexcept { fail(FalconFault::internal); }

  /// Zero words, then lets the device go. Again: nothing.
  void close() noexcept;

  /// Any thread: what takes long ends soon, in the state that it has then.
  void stop() noexcept { is_stopped_ = true; }
  bool is_stopped() const noexcept { return is_stopped_; }

  FalconState state() const noexcept { return status_.state; }
  const FalconStatus& status() const noexcept { return status_; }

  // What is waited for, in seconds. docs/falcon.md says why these.
  static constexpr double kReplyS = 0.015;       ///< then a reply is lost, and no force is given
  static constexpr double kSilenceS = 0.1;       ///< then the device is
  static constexpr double kSettleS = 0.05;       ///< after a jump or a gap, without force
  static constexpr double kServoLateS = 0.0025;  ///< from then its last force fades
  /// Until then; at that moment zero words leave, even while a reply is awaited. The motors have
  /// them within 5 ms, although libusb may wait for a millisecond too long.
  static constexpr double kServoGoneS = 0.0035;
  static constexpr double kServoBackS = 0.02;   ///< that the force takes to come back
  static constexpr double kServoHangsS = 0.02;  ///< then it is no slip, and it comes back slowly

 private:
  FalconFault start_running();
  bool answers();
  FalconFault upload();
  FalconFault fail(FalconFault fault) noexcept;
  void enter(FalconState state) noexcept;
  void publish() noexcept;

  FalconFault exchange_until(double time_s);
  double next_look_s() const noexcept;
  double gone_s() const noexcept { return wanted_.time_s + kServoGoneS; }
  bool holds_force() const noexcept;
  bool is_forsaken() const noexcept;
  FalconCommand command_of(const Vec3& force_n) const noexcept;
  FalconFault send(const Vec3& force_n);
  FalconFault ask_again();
  FalconFault forget_replies();
  void take_bytes();
  void take(const FalconReply& reply);
  bool is_plausible(const FalconReply& reply, double elapsed_s) const noexcept;
  bool locate(const FalconReply& reply) noexcept;
  bool may_give_force() const noexcept;
  Vec3 force_now();
  void say_goodbye() noexcept;
  void say_not_ready() noexcept;

  FalconOptions options_;
  std::optional<FalconFirmware> firmware_;
  LinkClock& clock_;
  FalconMailbox& mailbox_;
  FalconKinematics kinematics_;
  SafetyGate gate_;
  std::unique_ptr<FalconLink> link_;
  FalconReplyParser parser_;
  FalconStatus status_;
  std::atomic<bool> is_stopped_ = false;

  int awaited_ = 0;         ///< packets that were sent and whose replies have not come
  double sent_s_ = 0.0;     ///< when the last packet was
  double reply_s_ = 0.0;    ///< when the last reply came
  double settled_s_ = 0.0;  ///< from when on the position may be trusted
  FalconForce wanted_;      ///< the servo's last force
  double gate_s_ = 0.0;     ///< when the gate last let one through
  double share_ = 0.0;      ///< of the force, of a servo that was late
  Vec3 position_mm_;        ///< in the frame of the kinematics
  bool is_located_ = false;
  bool is_late_ = false;  ///< a reply is
};

}  // namespace argil::haptics
