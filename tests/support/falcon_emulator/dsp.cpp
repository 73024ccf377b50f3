// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/dsp.h"

#include <algorithm>
#include <cmath>

namespace argil::test {
namespace {

constexpr unsigned kBootDivisor = 0x4138;
constexpr unsigned kUploadDivisor = 0x0015;
constexpr unsigned kRunDivisor = 0x0002;
constexpr std::size_t kPacketBytes = 16;
constexpr std::size_t kHeadWords = 11;
constexpr std::size_t kDamagedByte = 100;  ///< of an upload's echo
constexpr unsigned kCentreButton = 4;      ///< of the grip, the large one
constexpr double kMostStepS = 0.05;        ///< SimFalcon leaves out what is longer than twice that

int number_at(const std::string& packet, std::size_t index) {
  int value = 0;
  for (int n = 3; n >= 0; --n) {
    value = 16 * value + (packet[1 + 4 * index + static_cast<std::size_t>(n)] - 'A');
  }
  return value < 0x8000 ? value : value - 0x10000;
}

std::string letters_of(int value) {
  std::string letters;
  for (int n = 0; n < 4; ++n) {
    letters += static_cast<char>('A' + ((static_cast<unsigned>(value) >> (4 * n)) & 15U));
  }
  return letters;
}

}  // namespace

FalconDsp::FalconDsp(const DspOptions& options)
    : options_(options),
      sim_(options.model, options.hand, haptics::HandPlan(options.plan)),
      kinematics_(options.geometry),
      state_(options.is_loaded ? State::run : State::wait) {
  power_on_ = last_raw_ = raw_ticks();
  homed_.fill(options.is_homed);
}

void FalconDsp::set_reset_line(bool high) {
  if (high && !is_reset_high_) {
    state_ = State::greet;
    heard_.clear();
    packet_.clear();
    image_.clear();
    power_on_ = last_raw_;
    homed_ = {};
  }
  is_reset_high_ = high;
}

bool FalconDsp::is_clear_to_send() const noexcept {
  return divisor_ == kUploadDivisor && state_ == State::autobaud;
}

std::string FalconDsp::receive(std::uint8_t byte, double now_s, FalconFaults& faults) {
  switch (state_) {
    case State::greet:
      return divisor_ == kBootDivisor ? greet(byte, faults) : "";
    case State::autobaud:
      if (divisor_ != kUploadDivisor || byte != 'A') return "";
      state_ = State::upload;
      words_ = block_left_ = 0;
      ++uploads_;
      is_damaging_ = faults.corrupted_uploads > 0 || faults.lossy_uploads > 0;
      return "A";
    case State::upload:
      return divisor_ == kUploadDivisor ? upload(byte, faults) : "";
    case State::run:
      return divisor_ == kRunDivisor ? run(byte, now_s, faults) : "";
    case State::wait:
      break;
  }
  return "";
}

std::string FalconDsp::greet(std::uint8_t byte, FalconFaults& faults) {
  heard_ += static_cast<char>(byte);
  if (!heard_.ends_with("\x0A\x43\x0D")) return "";
  heard_.clear();
  if (faults.ignored_greetings > 0) {
    --faults.ignored_greetings;
    return "";
  }
  state_ = State::autobaud;
  const std::string answer = "\x0A\x44\x2C\x0D";
  return faults.has_zero_before_greeting ? std::string(1, '\0') + answer : answer;
}

std::string FalconDsp::upload(std::uint8_t byte, FalconFaults& faults) {
  image_.push_back(byte);
  if (image_.size() % 2 == 0) {
    const unsigned word = image_[image_.size() - 2] | unsigned{byte} << 8U;
    if (!take_word(word)) state_ = State::wait;
  }
  std::string echo(1, static_cast<char>(byte));
  if (image_.size() == 1 && faults.prefixed_uploads > 0) {
    --faults.prefixed_uploads;
    echo.insert(echo.begin(), '\0');
  }
  if (image_.size() == kDamagedByte && faults.corrupted_uploads > 0) {
    --faults.corrupted_uploads;
    echo[0] = static_cast<char>(echo[0] ^ 4);
  } else if (image_.size() == kDamagedByte && faults.lossy_uploads > 0) {
    --faults.lossy_uploads;
    echo.clear();
  }
  if (state_ == State::run && faults.never_starts) state_ = State::wait;
  return echo;
}

/// False when the boot loader gives up; after the last block the firmware runs.
bool FalconDsp::take_word(unsigned word) {
  const std::size_t at = words_++;
  if (at == 0) return word == 0x08AA;
  if (at < kHeadWords) return true;
  if (block_left_ > 0) {
    --block_left_;
  } else if (word == 0) {
    state_ = State::run;
  } else {
    block_left_ = word + 2;  // with its destination
  }
  return true;
}

std::string FalconDsp::run(std::uint8_t byte, double now_s, FalconFaults& faults) {
  if (byte == '<') packet_.clear();
  if (packet_.empty() && byte != '<') return "";
  packet_ += static_cast<char>(byte);
  if (packet_.size() < kPacketBytes) return "";
  const std::string whole = packet_;
  packet_.clear();
  if (whole.back() != '>' || faults.is_silent) return "";
  std::string answer = obey(whole, now_s);
  if (faults.jumped_replies > 0) {
    --faults.jumped_replies;
    answer.replace(1, 4, letters_of(number_at(answer, 0) + faults.jump_ticks));
  }
  if (faults.lost_replies > 0) {
    --faults.lost_replies;
    return "";
  }
  if (faults.short_replies > 0) {
    --faults.short_replies;
    return answer.substr(0, 13) + ">";
  }
  return answer;
}

std::string FalconDsp::obey(const std::string& packet, double now_s) {
  move_to(now_s);
  SeenCommand seen;
  seen.time_s = now_s;
  for (std::size_t leg = 0; leg < 3; ++leg) seen.word[leg] = number_at(packet, leg);
  seen.flags = static_cast<unsigned>(packet[13] - 'A');
  commands_.push_back(seen);
  Vec3 force;
  if (const auto rates = kinematics_.rates_of(sim_.true_position_mm() + haptics::kFalconCenterMm)) {
    for (std::size_t leg = 0; leg < 3; ++leg) {
      force += -1000.0 * seen.word[leg] / options_.geometry.words_per_nm * (*rates)[leg];
    }
  }
  sim_.write(force);
  is_pushing_ = !seen.is_zero();
  last_command_s_ = now_s;
  const std::array<int, 3> raw = raw_ticks();
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const bool passed = (raw[leg] < 0) != (last_raw_[leg] < 0);
    homed_[leg] = (seen.flags & 1U) != 0 && (homed_[leg] || passed);
  }
  last_raw_ = raw;
  commands_.back().tick = counts();
  return reply();
}

void FalconDsp::move_to(double now_s) {
  const double drop_s = last_command_s_ + options_.torque_hold_s;
  while (moved_s_ < now_s) {
    double next_s = std::min(now_s, moved_s_ + kMostStepS);
    if (is_pushing_ && moved_s_ < drop_s) next_s = std::min(next_s, drop_s);
    buttons_ = (sim_.read(next_s).buttons & 1U) != 0 ? kCentreButton : 0U;
    moved_s_ = next_s;
    if (is_pushing_ && moved_s_ >= drop_s) {
      sim_.write({});
      is_pushing_ = false;
    }
  }
}

std::array<int, 3> FalconDsp::raw_ticks() const {
  std::array<int, 3> raw = last_raw_;
  const auto angles = kinematics_.angles_of(sim_.true_position_mm() + haptics::kFalconCenterMm);
  if (!angles) return raw;
  const auto ticks = kinematics_.ticks_of_angles(*angles);
  for (std::size_t leg = 0; leg < 3; ++leg) raw[leg] = static_cast<int>(std::lround(ticks[leg]));
  return raw;
}

std::array<int, 3> FalconDsp::counts() const {
  std::array<int, 3> counts = last_raw_;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    if (!homed_[leg]) counts[leg] -= power_on_[leg];
  }
  return counts;
}

std::string FalconDsp::reply() const {
  std::string reply = "<";
  unsigned flags = buttons_ & 15U;
  const std::array<int, 3> told = counts();
  for (std::size_t leg = 0; leg < 3; ++leg) {
    reply += letters_of(told[leg]);
    if (homed_[leg]) flags |= 16U << leg;
  }
  return reply + static_cast<char>('A' + static_cast<int>(flags)) + "A>";
}

Vec3 FalconDsp::place_mm(double now_s) {
  move_to(now_s);
  return sim_.true_position_mm();
}

Vec3 FalconDsp::force_n(double now_s) {
  move_to(now_s);
  return sim_.held_force_n();
}

}  // namespace argil::test
