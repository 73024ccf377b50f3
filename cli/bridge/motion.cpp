// SPDX-License-Identifier: GPL-3.0-or-later
// What the simulated hand does, and files of numbers.
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "argil/haptics/analysis/hold_test.h"

#include "bridge/bridge.h"
#include "bridge/scene.h"
#include "play/scene_play.h"

namespace argil::cli::bridge {
namespace {

using haptics::HandKey;

/// Until the servo has ramped in, and the simulator's force is felt in full.
constexpr double kMotionWaitS = 0.5;
constexpr double kSlideMm = 40.0;
constexpr double kCarveMm = 16.0;
constexpr double kCarveDepthMm = 2.0;
constexpr double kClearMm = 10.0;

std::vector<HandKey> press_keys(double press_n) {
  assert(press_n >= 0.0);
  return after_wait(haptics::press_plan({}, {0.0, -1.0, 0.0}, press_n), kMotionWaitS);
}

std::vector<HandKey> slide_keys(double press_n) {
  std::vector<HandKey> keys = press_keys(press_n);
  HandKey key = keys.back();
  key.time_s = 1.5;
  keys.push_back(key);
  key.time_s = 3.5;
  key.place_mm.x += kSlideMm;
  keys.push_back(key);
  return keys;
}

/// Guided at a depth while it works: pressing on while the clay gives way would be drilling.
std::vector<HandKey> carve_keys(double press_n) {
  std::vector<HandKey> keys = press_keys(press_n);
  HandKey key = keys.back();
  key.time_s = 1.5;
  key.place_mm.y = -kCarveDepthMm;
  key.press_n = 0.0;
  key.is_active = true;
  keys.push_back(key);
  key.time_s = 3.5;
  key.place_mm.x += kCarveMm;
  key.press_n = press_n;
  key.is_active = false;
  keys.push_back(key);
  return keys;
}

std::vector<HandKey> free_keys() {
  std::vector<HandKey> keys(3);
  keys[0].place_mm = {-30.0, kClearMm, 0.0};
  keys[1].time_s = 1.0;
  keys[1].place_mm = {30.0, kClearMm, 20.0};
  keys[2].time_s = 2.0;
  keys[2].place_mm = {0.0, 4.0 * kClearMm, -20.0};
  return keys;
}

/// Without the blanks about it.
std::string trimmed(const std::string& word) {
  const std::size_t begin = word.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return word.substr(begin, word.find_last_not_of(" \t") - begin + 1);
}

/// Nothing when it is none, or beyond kMaxReachMm: no second and no newton of a hand is more
/// either.
std::optional<double> number_of(const std::string& word) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  const bool is_good = error == std::errc() && rest == end && std::abs(value) <= kMaxReachMm;
  return is_good ? std::optional(value) : std::nullopt;
}

/// What is wrong with a line; "" when it could be read.
std::string read_line(const std::string& text, std::size_t columns, std::size_t more,
                      std::vector<double>& row) {
  std::istringstream line(text);
  for (std::string word; std::getline(line, word, ',');) {
    word = trimmed(word);
    const auto value = number_of(word);
    if (!value) return "has '" + word + "', which is no number from -1e6 to 1e6";
    row.push_back(*value);
  }
  if (row.size() >= columns && row.size() <= columns + more) return "";
  const std::string most = more > 0 ? " to " + std::to_string(columns + more) : std::string();
  return "is not " + std::to_string(columns) + most + " numbers parted by commas";
}

}  // namespace

Result<std::vector<std::vector<double>>> read_numbers(const std::filesystem::path& file,
                                                      std::size_t columns, std::size_t more) {
  std::ifstream stream(file);
  if (!stream) {
    return Error{ErrorKind::bad_input,
                 "cannot read '" + file.string() + "'; check the name and who may read it"};
  }
  std::vector<std::vector<double>> rows;
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    // Line ends of Windows.
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.empty() || text.front() == '#') continue;
    std::vector<double> row;
    if (const std::string wrong = read_line(text, columns, more, row); !wrong.empty()) {
      return Error{ErrorKind::bad_input,
                   "'" + file.string() + "' line " + std::to_string(number) + " " + wrong};
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) {
    return Error{ErrorKind::bad_input, "'" + file.string() + "' is empty; must have lines of " +
                                           std::to_string(columns) + " numbers"};
  }
  return rows;
}

Result<std::vector<HandKey>> motion_of(const BridgeOptions& options) {
  if (options.motion.empty() && !options.scene.empty()) return scene_motion(options);
  if (options.motion.empty() || options.motion == "press") return press_keys(options.press_n);
  if (options.motion == "slide") return slide_keys(options.press_n);
  if (options.motion == "carve") return carve_keys(options.press_n);
  if (options.motion == "free") return free_keys();
  const auto rows = read_numbers(options.motion, 5, 1);
  if (!rows) return rows.error();
  std::vector<HandKey> keys;
  for (const auto& row : rows.value()) {
    HandKey key;
    key.time_s = row[0];
    key.place_mm = {row[1], row[2], row[3]};
    key.press_n = row[4];
    key.is_active = row.size() > 5 && row[5] != 0.0;
    assert(is_in_reach(key.place_mm));
    if (key.time_s < (keys.empty() ? 0.0 : keys.back().time_s)) {
      return Error{ErrorKind::bad_input,
                   "the times in --motion " + options.motion + " must not fall"};
    }
    keys.push_back(key);
  }
  return keys;
}

}  // namespace argil::cli::bridge
