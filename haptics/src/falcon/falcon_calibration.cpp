// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_calibration.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

namespace argil::haptics {
namespace {

constexpr std::string_view kFirstKey = "argil_falcon_calibration";
constexpr std::string_view kSetKey = "set";
constexpr std::size_t kMostBytes = std::size_t{64} * 1024;

/// A key, its range, and where its one or three numbers go.
struct Key {
  std::string_view name;
  double least;
  double most;
  double* number = nullptr;
  LegValues* legs = nullptr;
  Vec3* vector = nullptr;
};

std::array<Key, 17> keys_of(FalconCalibration& c) {
  FalconGeometry& g = c.geometry;
  return {{{"arm_mm", 10.0, 200.0, &g.arm_mm},
           {"rod_mm", 10.0, 300.0, &g.rod_mm},
           {"stub_mm", 0.0, 50.0, &g.stub_mm},
           {"hinge_radial_mm", 0.0, 100.0, &g.hinge_radial_mm},
           {"joint_radial_mm", 0.0, 100.0, &g.joint_radial_mm},
           {"hinge_tangential_mm", -100.0, 100.0, &g.hinge_tangential_mm},
           {"joint_tangential_mm", -100.0, 100.0, &g.joint_tangential_mm},
           {"leg_deg", -360.0, 360.0, nullptr, &g.leg_deg},
           {"counts_per_turn", 1.0, 1e6, &g.counts_per_turn},
           {"gear_ratio", 0.1, 100.0, &g.gear_ratio},
           {"tick_zero_deg", -90.0, 180.0, &g.tick_zero_deg},
           {"words_per_nm", 100.0, 1e5, &g.words_per_nm},
           {"center_mm", -300.0, 300.0, nullptr, nullptr, &c.center_mm},
           {"pulled_out_mm", 0.0, 60.0, &c.pulled_out_mm},
           {"gravity_n", -3.0, 3.0, nullptr, nullptr, &c.gravity_n},
           {"mass_kg", 0.05, 5.0, &c.mass_kg},
           {"damping_n_s_per_m", 0.1, 50.0, &c.damping_n_s_per_m}}};
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// All the numbers between commas; empty when one of them is not a number or out of the key's
/// range.
std::vector<double> numbers_of(std::string_view text, const Key& key) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = number_of(trimmed(text.substr(begin, end - begin)));
    if (!number || !(*number >= key.least && *number <= key.most)) return {};
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

/// False when the value is not what the key takes.
bool take(const Key& key, std::string_view value) {
  assert(key.least < key.most);
  assert(key.number != nullptr || key.legs != nullptr || key.vector != nullptr);
  const std::vector<double> numbers = numbers_of(value, key);
  if (numbers.size() != (key.number != nullptr ? 1U : 3U)) return false;
  if (key.number != nullptr) *key.number = numbers[0];
  if (key.legs != nullptr) std::copy(numbers.begin(), numbers.end(), key.legs->begin());
  if (key.vector != nullptr) *key.vector = {numbers[0], numbers[1], numbers[2]};
  return true;
}

std::string in_quotes(std::string_view text) {
  std::string all(1, '\'');
  return all.append(text).append(1, '\'');
}

std::string wanted_by(const Key& key) {
  std::ostringstream text;
  text << (key.number != nullptr ? "a number from " : "three numbers parted by commas, each from ")
       << key.least << " to " << key.most;
  return text.str();
}

/// Reads line by line; every error names the line.
class CalibrationReader {
 public:
  CalibrationReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<FalconCalibration> read() {
    while (!text_.empty()) {
      ++line_;
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      const std::string_view line = trimmed(text_.substr(0, std::min(end, text_.find('#'))));
      text_.remove_prefix(std::min(end + 1, text_.size()));
      if (line.empty()) continue;
      if (auto taken = read_line(line); !taken) return taken.error();
    }
    if (seen_.size() < 2) return bad(std::string("must begin with '") + first() + "' and a set");
    const FalconKinematics kinematics(calibration_.geometry);
    if (!kinematics.rates_of(calibration_.center_mm)) {
      return bad("has constants of an arm that cannot reach its center_mm; measure them again");
    }
    const Vec3 out_mm{0.0, 0.0, calibration_.pulled_out_mm};
    if (!kinematics.rates_of(calibration_.center_mm + out_mm)) {
      return bad(
          "wants the grip pulled out further than its arm reaches; lower pulled_out_mm or "
          "the z of center_mm");
    }
    return calibration_;
  }

 private:
  static std::string first() { return std::string(kFirstKey) + " = 1"; }
  Error bad(const std::string& what) const {
    return {ErrorKind::bad_input, "the calibration '" + name_ + "' " + what};
  }
  Error bad_line(const std::string& what) const {
    return {ErrorKind::bad_input, name_ + ":" + std::to_string(line_) + ": " + what};
  }

  Result<void> read_line(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return bad_line("must be 'key = value'");
    const std::string_view name = trimmed(line.substr(0, equals));
    const std::string_view value = trimmed(line.substr(equals + 1));
    if (std::find(seen_.begin(), seen_.end(), name) != seen_.end()) {
      return bad_line(in_quotes(name) + " stands twice");
    }
    seen_.emplace_back(name);
    if (seen_.size() == 1) {
      if (name == kFirstKey && value == "1") return {};
      return bad_line("must be '" + first() + "', the only version that this Argil reads");
    }
    if (seen_.size() == 2) return choose_set(name, value);
    return take_key(name, value);
  }

  Result<void> choose_set(std::string_view name, std::string_view value) {
    if (name != kSetKey) return bad_line("must be 'set = libnifalcon' or 'set = martin-hillier'");
    auto named = named_falcon_calibration(value);
    if (!named) return bad_line(named.error().message);
    calibration_ = named.value();
    return {};
  }

  Result<void> take_key(std::string_view name, std::string_view value) {
    for (const Key& key : keys_of(calibration_)) {
      if (key.name != name) continue;
      if (take(key, value)) return {};
      return bad_line(in_quotes(name) + " is " + in_quotes(value) + "; must be " + wanted_by(key));
    }
    return bad_line(in_quotes(name) + " is no key of a calibration");
  }

  std::string_view text_;
  const std::string& name_;
  int line_ = 0;
  std::vector<std::string> seen_;
  FalconCalibration calibration_;
};

}  // namespace

Result<FalconCalibration> named_falcon_calibration(std::string_view name) {
  FalconCalibration calibration;
  if (name == "martin-hillier") return calibration;
  if (name == "libnifalcon") {
    calibration.geometry = libnifalcon_geometry();
    return calibration;
  }
  return Error{ErrorKind::bad_input,
               "the set is '" + std::string(name) + "'; must be libnifalcon or martin-hillier"};
}

Result<FalconCalibration> parse_falcon_calibration(std::string_view text, const std::string& name) {
  if (text.size() > kMostBytes) {
    return Error{ErrorKind::bad_input, "the calibration '" + name + "' is longer than 64 KiB"};
  }
  return CalibrationReader(text, name).read();
}

Result<FalconCalibration> read_falcon_calibration(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, error) || !in.is_open()) {
    return Error{ErrorKind::bad_input, "the calibration '" + file.string() +
                                           "' cannot be read; check its name and permissions"};
  }
  std::string text(kMostBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse_falcon_calibration(text, file.string());
}

}  // namespace argil::haptics
