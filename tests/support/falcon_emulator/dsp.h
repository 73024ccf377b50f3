// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "argil/haptics/falcon/falcon_calibration.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "support/falcon_emulator/faults.h"

namespace argil::test {

/// One packet that reached the device.
struct SeenCommand {
  double time_s = 0.0;
  std::array<int, 3> word{};
  unsigned flags = 0;         ///< bit 0 homing, 1 green, 2 blue, 3 red
  std::array<int, 3> tick{};  ///< what it answered

  bool is_zero() const noexcept { return word == std::array<int, 3>{}; }
};

/// How an emulated Falcon is made.
struct DspOptions {
  bool is_loaded = true;  ///< its firmware runs already
  haptics::FalconModel model = usual_model();
  haptics::HandModel hand = haptics::hand_model(haptics::Hand::arm);
  std::vector<haptics::HandKey> plan{haptics::HandKey{}};
  haptics::FalconGeometry geometry = haptics::martin_hillier_geometry();
  bool is_homed = false;        ///< the arms' indices were passed before
  double torque_hold_s = 0.03;  ///< how long it gives a force that no packet repeats

  /// Its own delay is that of the wire, and its own rounding that of the encoders.
  static haptics::FalconModel usual_model() {
    haptics::FalconModel model;
    model.delay_ticks = 0;
    model.encoder = haptics::Encoder::exact;
    model.most_force_n = 50.0;  // the words bound it
    return model;
  }
};

/// The Falcon's processor: its boot loader, its firmware, and the arms with a hand on them.
/// Written from docs/theory.md, "Falcon", wire, and apart from the driver's own code.
class FalconDsp {
 public:
  explicit FalconDsp(const DspOptions& options);

  void set_reset_line(bool high);  ///< DTR: its rising edge resets into the boot loader
  void set_divisor(unsigned value) noexcept { divisor_ = value; }
  bool is_clear_to_send() const noexcept;

  /// A byte from the host at `now_s`; what it answers.
  std::string receive(std::uint8_t byte, double now_s, FalconFaults& faults);

  bool is_running() const noexcept { return state_ == State::run; }
  const std::vector<std::uint8_t>& uploaded() const noexcept { return image_; }
  int uploads() const noexcept { return uploads_; }  ///< begun, of all times
  const std::vector<SeenCommand>& commands() const noexcept { return commands_; }

  void forget_homing() noexcept { homed_ = {}; }

  // What only the device knows; moves it up to `now_s`.
  Vec3 place_mm(double now_s);
  Vec3 force_n(double now_s);

 private:
  enum class State { wait, greet, autobaud, upload, run };

  std::string greet(std::uint8_t byte, FalconFaults& faults);
  std::string upload(std::uint8_t byte, FalconFaults& faults);
  bool take_word(unsigned word);
  std::string run(std::uint8_t byte, double now_s, FalconFaults& faults);
  std::string obey(const std::string& packet, double now_s);
  void move_to(double now_s);
  std::array<int, 3> raw_ticks() const;
  std::array<int, 3> counts() const;
  std::string reply() const;

  DspOptions options_;
  haptics::SimFalcon sim_;
  haptics::FalconKinematics kinematics_;
  State state_ = State::wait;
  bool is_reset_high_ = false;
  unsigned divisor_ = 0;
  std::string heard_;

  std::vector<std::uint8_t> image_;
  std::size_t words_ = 0;       ///< of the stream so far
  std::size_t block_left_ = 0;  ///< words of the block
  int uploads_ = 0;
  bool is_damaging_ = false;  ///< this upload

  std::string packet_;
  std::vector<SeenCommand> commands_;
  double last_command_s_ = 0.0;
  double moved_s_ = 0.0;
  bool is_pushing_ = false;
  std::array<int, 3> power_on_{};
  std::array<int, 3> last_raw_{};
  std::array<bool, 3> homed_{};
  unsigned buttons_ = 0;
};

}  // namespace argil::test
