// SPDX-License-Identifier: GPL-3.0-or-later
// Options of a real Falcon, and what a person has to do with it before it can be felt.
#include "common/falcon_options.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "common/output.h"

namespace argil::cli {
namespace {

using haptics::FalconDevice;
using haptics::FalconState;
using haptics::FalconStatus;

constexpr auto kLook = std::chrono::milliseconds(10);
/// An arm that turned less than this in that time was not moved, or its motors have no power.
constexpr int kMovedTicks = 100;
constexpr double kMovedS = 15.0;

Error falcon_interrupted() {
  return {ErrorKind::interrupted, "interrupted; the Falcon was let go"};
}

Result<haptics::FalconCalibration> calibration_of(const std::string& text) {
  if (auto named = haptics::named_falcon_calibration(text)) return named;
  std::error_code ignored;
  if (!std::filesystem::exists(text, ignored)) {
    return Error{ErrorKind::bad_input,
                 "--calibration is '" + text + "'; must be martin-hillier, libnifalcon or a file"};
  }
  return haptics::read_falcon_calibration(text);
}

/// What a person is told to do next.
const char* advice(const FalconStatus& status) {
  if (status.state == FalconState::active) return "homed: the light is green";
  const bool is_homed = status.is_homed[0] && status.is_homed[1] && status.is_homed[2];
  if (is_homed) return "homed (blue light): pull the grip out towards you once";
  return "not homed (red light): pull the grip out towards you, then push it straight in";
}

}  // namespace

void add_falcon_options(CLI::App& command, FalconChoice& choice) {
  command
      .add_option("--firmware", choice.firmware,
                  "sent when none runs; default the file that ARGIL_FALCON_FIRMWARE names")
      ->type_name("FILE");
  command.add_option("--serial", choice.serial, "of the Falcon meant; default the first one")
      ->type_name("TEXT");
  command
      .add_option("--calibration", choice.calibration,
                  "martin-hillier, libnifalcon or a file; default martin-hillier")
      ->type_name("NAME|FILE");
  command.add_flag("--flush", choice.flushes_at_packet_end,
                   "let the chip send each reply at once; untested on hardware");
}

Result<haptics::FalconOptions> falcon_options(const FalconChoice& choice) {
  auto calibration = calibration_of(choice.calibration);
  if (!calibration) return calibration.error();
  haptics::FalconOptions options;
  options.firmware = choice.firmware;
  options.serial = choice.serial;
  options.calibration = std::move(calibration).value();
  options.flushes_at_packet_end = choice.flushes_at_packet_end;
  return options;
}

Result<void> wait_for_firmware(FalconDevice& falcon, const Progress& progress) {
  for (;; std::this_thread::sleep_for(kLook)) {
    const FalconStatus& status = falcon.look();
    if (status.state == FalconState::fault) return haptics::falcon_error(status.fault);
    // Its firmware answers, whether it is homed or not.
    if (status.state == FalconState::unhomed || status.state == FalconState::active) return {};
    if (!progress(haptics::falcon_state_name(status.state), status.uploaded))
      return falcon_interrupted();
  }
}

Result<void> guide_home(FalconDevice& falcon, double seconds, bool quiet,
                        const Progress& progress) {
  assert(seconds > 0.0);
  const Stopwatch watch;
  const char* told = nullptr;
  auto low = falcon.look().tick;
  auto high = low;
  for (;; std::this_thread::sleep_for(kLook)) {
    const FalconStatus& status = falcon.look();
    if (status.state == FalconState::fault) return haptics::falcon_error(status.fault);
    const char* const now = advice(status);
    if (now != told && !quiet) std::fprintf(stderr, "argil: %s\n", now);
    told = now;
    if (status.state == FalconState::active) return {};
    int moved = 0;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      // The span since the beginning: an arm that was moved and put back has moved.
      low[leg] = std::min(low[leg], status.tick[leg]);
      high[leg] = std::max(high[leg], status.tick[leg]);
      moved = std::max(moved, high[leg] - low[leg]);
    }
    if (watch.seconds() > std::min(seconds, kMovedS) && moved < kMovedTicks) {
      return Error{ErrorKind::device,
                   "the Falcon's arms do not move; move the grip, and if you "
                   "did, check its power adapter"};
    }
    if (watch.seconds() > seconds) {
      return Error{ErrorKind::device, std::string("the Falcon is still ") + now +
                                          "; run it again, or give it longer with --seconds"};
    }
    if (!progress("home", watch.seconds() / seconds)) return falcon_interrupted();
  }
}

Result<std::unique_ptr<haptics::Device>> open_homed_falcon(const FalconChoice& choice, bool quiet,
                                                           const Progress& progress) {
  constexpr double kMostHomingS = 60.0;
  const auto options = falcon_options(choice);
  if (!options) return options.error();
  auto falcon = FalconDevice::open(options.value());
  if (!falcon) return falcon.error();
  note_refusal(falcon.value()->priority_refusal(), quiet);
  if (auto ready = wait_for_firmware(*falcon.value(), progress); !ready) return ready.error();
  if (auto homed = guide_home(*falcon.value(), kMostHomingS, quiet, progress); !homed) {
    return homed.error();
  }
  return std::unique_ptr<haptics::Device>(std::move(falcon).value());
}

}  // namespace argil::cli
