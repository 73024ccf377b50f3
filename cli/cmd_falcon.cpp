// SPDX-License-Identifier: GPL-3.0-or-later
// argil falcon list|probe|home|monitor: the real device, looked at without a servo.
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include <unistd.h>

#include "argil/haptics/falcon/falcon_firmware.h"

#include "commands.h"
#include "common/falcon_options.h"
#include "common/options.h"
#include "common/output.h"

namespace argil::cli {
namespace {

using haptics::FalconDevice;
using haptics::FalconFault;
using haptics::FalconState;
using haptics::FalconStatus;

/// What a person may be pushed with while nothing but a terminal watches.
constexpr double kMostPushN = 2.0;
/// The rate comes from some hundred replies then.
constexpr double kProbeS = 0.5;
/// How often the push is repeated, or the device would let go of it.
constexpr std::chrono::milliseconds kPushEvery{1};
static_assert(kPushEvery < std::chrono::duration<double>(haptics::kFalconMostPeriodS));

struct FalconCommandLine {
  FalconChoice choice;
  double home_s = 60.0;
  double monitor_s = 0.0;  ///< 0: until Ctrl-C
  Vec3 push_n;
  bool quiet = false;
};

Json status_json(const FalconStatus& status) {
  Json json;
  json["state"] = haptics::falcon_state_name(status.state);
  json["firmware"] = status.attempt == 0 ? "ran already" : "sent";
  json["attempts"] = status.attempt;
  json["homed"] = status.is_homed;
  json["pulled_out"] = status.is_pulled_out;
  json["ticks"] = status.tick;
  json["buttons"] = status.buttons;
  json["position_mm"] = to_json(status.position_mm);
  json["force_n"] = to_json(status.force_n);
  json["replies"] = status.replies;
  json["lost_replies"] = status.lost_replies;
  json["dropped_bytes"] = status.dropped_bytes;
  json["line_error"] = status.has_line_error;
  json["round_trip_ms"] = 1e3 * status.round_trip_s;
  return json;
}

/// Whether there is a firmware to send.
void add_firmware(Outcome& outcome) {
  const auto file = haptics::falcon_firmware_of_environment();
  std::string problem = "none is named; see --firmware and ARGIL_FALCON_FIRMWARE";
  if (!file.empty()) {
    const auto firmware = haptics::read_falcon_firmware(file);
    problem = firmware.ok() ? "" : firmware.error().message;
  }
  outcome.json["firmware"] = {
      {"file", file.string()}, {"usable", problem.empty()}, {"problem", problem}};
  outcome.text = "firmware: " + (problem.empty() ? file.string() : problem) + "\n";
}

Result<Outcome> run_list() {
  const auto attached = haptics::attached_falcons();
  if (!attached) return attached.error();
  Outcome outcome;
  add_firmware(outcome);
  outcome.json["falcons"] = Json::array();
  for (const haptics::AttachedFalcon& falcon : attached.value()) {
    const std::string obstacle = haptics::falcon_fault_text(falcon.obstacle);
    Json json;
    json["bus"] = falcon.bus;
    json["address"] = falcon.address;
    json["serial"] = falcon.serial;
    json["usable"] = falcon.obstacle == FalconFault::none;
    json["obstacle"] = obstacle;
    outcome.json["falcons"].push_back(json);
    outcome.text += "bus " + std::to_string(falcon.bus) + ", address " +
                    std::to_string(falcon.address) + ", serial '" + falcon.serial +
                    "': " + (obstacle.empty() ? "can be used" : obstacle) + "\n";
  }
  if (!attached.value().empty()) return outcome;
  outcome.text +=
      "no Falcon (USB 0403:cb48) is attached; check its cable, and plug it straight into the "
      "machine\n";
  return outcome;
}

/// Opened, and its firmware answers.
Result<std::unique_ptr<FalconDevice>> ready_falcon(const FalconCommandLine& line,
                                                   const Progress& progress) {
  auto options = falcon_options(line.choice);
  if (!options) return options.error();
  auto falcon = FalconDevice::open(options.value());
  if (!falcon) return falcon.error();
  note_refusal(falcon.value()->priority_refusal(), line.quiet);
  if (auto ready = wait_for_firmware(*falcon.value(), progress); !ready) return ready.error();
  return falcon;
}

Result<Outcome> run_probe(const FalconCommandLine& line, const Progress& progress) {
  auto opened = ready_falcon(line, progress);
  if (!opened) return opened.error();
  FalconDevice& falcon = *opened.value();
  const auto before = falcon.look().replies;
  const Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::duration<double>(kProbeS));
  const FalconStatus& status = falcon.look();
  if (status.state == FalconState::fault) return haptics::falcon_error(status.fault);
  const double rate_hz = static_cast<double>(status.replies - before) / watch.seconds();
  Outcome outcome;
  outcome.json = status_json(status);
  outcome.json["rate_hz"] = rate_hz;
  outcome.text = std::string("the Falcon answers ") + number(rate_hz) + " times a second, in " +
                 number(1e3 * status.round_trip_s) + " ms; it is " +
                 haptics::falcon_state_name(status.state) + "; its firmware " +
                 (status.attempt == 0 ? "ran already"
                                      : "was sent, attempt " + std::to_string(status.attempt)) +
                 "\n";
  return outcome;
}

Result<Outcome> run_home(const FalconCommandLine& line, const Progress& progress) {
  auto opened = ready_falcon(line, progress);
  if (!opened) return opened.error();
  FalconDevice& falcon = *opened.value();
  const Stopwatch watch;
  if (auto homed = guide_home(falcon, line.home_s, line.quiet, progress); !homed) {
    return homed.error();
  }
  Outcome outcome;
  outcome.json = status_json(falcon.look());
  outcome.json["seconds"] = watch.seconds();
  outcome.text = "the Falcon is homed, and stays so until it loses its power\n";
  return outcome;
}

std::string line_of(const FalconStatus& status, double rate_hz) {
  char text[200];
  std::snprintf(text, sizeof text,
                "%-9s x %7.2f y %7.2f z %7.2f mm  force %5.2f %5.2f %5.2f N  buttons %u  "
                "%6.1f /s  lost %llu",
                haptics::falcon_state_name(status.state), status.position_mm.x,
                status.position_mm.y, status.position_mm.z, status.force_n.x, status.force_n.y,
                status.force_n.z, status.buttons, rate_hz,
                static_cast<unsigned long long>(status.lost_replies));
  return text;
}

/// A line ten times a second: on a terminal the same one, elsewhere one after the other.
class Monitor {
 public:
  Monitor(bool shows, const FalconStatus& status) : shows_(shows), replies_(status.replies) {}
  ~Monitor() {
    if (has_open_line_) std::fputs("\n", stderr);  // an error begins a line of its own
  }
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  void show(const FalconStatus& status) {
    const double elapsed_s = watch_.seconds() - shown_s_;
    if (elapsed_s < 0.1) return;
    const double rate_hz = static_cast<double>(status.replies - replies_) / elapsed_s;
    shown_s_ = watch_.seconds();
    replies_ = status.replies;
    if (!shows_) return;
    has_open_line_ = ::isatty(STDERR_FILENO) == 1;
    std::fprintf(stderr, has_open_line_ ? "\r%s\033[K" : "%s\n", line_of(status, rate_hz).c_str());
  }
  double seconds() const { return watch_.seconds(); }

 private:
  bool shows_;
  bool has_open_line_ = false;
  Stopwatch watch_;
  double shown_s_ = 0.0;
  std::uint64_t replies_;
};

/// The driver holds the grip's weight besides.
Result<void> check_push(const FalconCommandLine& line) {
  const auto options = falcon_options(line.choice);
  if (!options) return options.error();
  const double all_n = length(line.push_n + options.value().calibration.gravity_n);
  if (all_n <= kMostPushN) return {};
  return Error{ErrorKind::bad_input, "--force with the calibration's gravity_n is " +
                                         number(all_n) + " N; must be at most " +
                                         number(kMostPushN) + " N"};
}

Result<Outcome> run_monitor(const FalconCommandLine& line, const Progress& progress) {
  if (auto good = check_push(line); !good) return good.error();
  auto opened = ready_falcon(line, progress);
  if (!opened) return opened.error();
  FalconDevice& falcon = *opened.value();
  const auto before = falcon.look().replies;
  Monitor monitor(!line.quiet, falcon.look());
  const auto goes_on = [&] {
    if (line.monitor_s > 0.0 && monitor.seconds() >= line.monitor_s) return false;
    return check_interrupt().ok();
  };
  while (goes_on()) {
    falcon.write(line.push_n);
    const FalconStatus& status = falcon.look();
    if (status.state == FalconState::fault) return haptics::falcon_error(status.fault);
    monitor.show(status);
    std::this_thread::sleep_for(kPushEvery);
  }
  Outcome outcome;
  // Without a limit Ctrl-C is how it ends: what was seen is told all the same.
  if (!check_interrupt()) outcome.status = status_of(ErrorKind::interrupted);
  const FalconStatus& status = falcon.look();
  const double rate_hz = static_cast<double>(status.replies - before) / monitor.seconds();
  outcome.json = status_json(status);
  outcome.json["seconds"] = monitor.seconds();
  outcome.json["rate_hz"] = rate_hz;
  outcome.text = number(static_cast<double>(status.replies - before)) + " replies, " +
                 number(rate_hz) + " a second; " + std::to_string(status.lost_replies) + " lost\n";
  return outcome;
}

}  // namespace

void add_falcon(CLI::App& app, Selected& selected) {
  CLI::App* falcon = app.add_subcommand("falcon", "the real device: find, start, home, watch it");
  falcon->require_subcommand(1);
  add_command(*falcon, selected, "list", "what is attached, and why it cannot be used",
              [](const Progress&) { return run_list(); });
  const auto line = std::make_shared<FalconCommandLine>();
  using Run = Result<Outcome> (*)(const FalconCommandLine&, const Progress&);
  const auto add = [&](const char* name, const char* help, Run run) {
    CLI::App* command = add_command(
        *falcon, selected, name, help,
        [line, &selected, run](const Progress& progress) {
          line->quiet = selected.quiet;
          return run(*line, progress);
        },
        OnInterrupt::ends_itself);
    add_falcon_options(*command, line->choice);
    return command;
  };
  add("probe", "does its firmware run, how fast does it answer; sends the firmware if need be",
      run_probe);
  CLI::App* home = add("home", "guides a person through homing the arms", run_home);
  add_number(*home, "--seconds", line->home_s, {1.0, 3600.0}, "how long to wait; default 60");
  CLI::App* monitor = add("monitor", "position, force and rate, live", run_monitor);
  add_number(*monitor, "--seconds", line->monitor_s, {0.1, 86400.0},
             "how long; default until Ctrl-C");
  add_triple(*monitor, "--force", line->push_n,
             "a constant force in N, at most 2 in all, once it is homed and pulled out");
}

}  // namespace argil::cli
