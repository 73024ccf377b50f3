// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/lab_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include <unistd.h>

#include "argil/haptics/scene_vibro.h"

#include "output.h"

namespace argil::cli::lab {
namespace {

namespace fs = std::filesystem;
using haptics::HoldTest;
using haptics::ServoTick;

constexpr double kLabWatchS = 1.0;
/// From the end of the plan until the hold is judged.
constexpr double kLabSettleS = 3.0;

/// Judges the last second of what the servo itself saw: places as measured, and the forces that
/// the device held from each on, which were written `delay_ticks` before.
void judge(LabRun& run, double period_s, int delay_ticks) {
  const auto late = static_cast<std::size_t>(delay_ticks);
  if (run.ticks.size() < late + 3) return;
  const auto watched =
      std::min(run.ticks.size() - late, static_cast<std::size_t>(kLabWatchS / period_s));
  if (watched < 3) return;
  std::vector<Vec3> places;
  std::vector<Vec3> forces;
  for (std::size_t n = run.ticks.size() - watched; n < run.ticks.size(); ++n) {
    places.push_back(run.ticks[n].position_mm);
    forces.push_back(run.ticks[n - late].force_n);
    run.mean_position_mm += places.back() / static_cast<double>(watched);
  }
  run.judgement = haptics::judge_hold(places, forces, period_s);
}

/// Stops a run on virtual time when the user asks, and shows how far it is.
class LabObserver final : public haptics::ServoObserver {
 public:
  LabObserver(ServedClay* clay, const Progress& progress, double seconds)
      : clay_(clay), progress_(progress), seconds_(seconds) {}
  void after_tick(const ServoTick& tick) override {
    if (clay_ != nullptr && worked) worked = clay_->after_tick(tick.time_s);
    if (tick.number % 256 == 0 && !progress_("lab", tick.time_s / seconds_)) is_stopped = true;
    if (!worked) is_stopped = true;
  }
  std::atomic<bool> is_stopped = false;
  Result<void> worked;  ///< the clay's first error

 private:
  ServedClay* clay_;
  const Progress& progress_;
  double seconds_;
};

Result<LabRun> run_virtual(const LabOptions& options, const HoldTest& test,
                           haptics::ForceScene& scene, ServedClay* clay, const Progress& progress) {
  LabObserver observer(clay, progress, test.settle_s + test.watch_s);
  haptics::HoldTestResult result =
      haptics::run_hold_test(scene, test, &observer, &observer.is_stopped);
  if (!observer.worked) return observer.worked.error();
  if (observer.is_stopped) return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
  LabRun run;
  run.judgement = result.judgement;
  run.mean_position_mm = result.mean_position_mm;
  run.most_given_mj = result.most_given_nmm;
  run.servo.ticks = result.ticks.size();
  run.servo.faults = result.faults;
  run.ticks = std::move(result.ticks);
  if (options.output.empty()) return run;
  const haptics::Recording recording{note_of(options), run.ticks};
  if (auto written = haptics::write_recording(options.output, recording); !written) {
    return written.error();
  }
  return run;
}

/// Where a real-time run is recorded when the user wants no file: it is read back and removed.
fs::path scratch_file() {
  return fs::temp_directory_path() / ("argil_lab_" + std::to_string(::getpid()) + ".csv");
}

/// What was recorded. A record with gaps can be neither judged nor replayed: it does not take the
/// place of FILE.
Result<haptics::Recording> read_back(haptics::Recorder& recorder, const fs::path& file) {
  if (recorder.dropped() > 0) {
    return Error{ErrorKind::disk, "the recorder lost " + std::to_string(recorder.dropped()) +
                                      " ticks, so that the run cannot be judged and was not kept; "
                                      "record to a faster disk"};
  }
  if (auto written = recorder.finish(); !written) return written.error();
  return haptics::read_recording(file);
}

/// The device of the options; a real one once a person has homed it.
Result<std::unique_ptr<haptics::Device>> real_time_device(const LabOptions& options,
                                                          const HoldTest& test,
                                                          const Progress& progress) {
  if (options.device == "falcon") {
    return open_homed_falcon(options.falcon, options.is_quiet, progress);
  }
  return std::unique_ptr<haptics::Device>(
      new haptics::SimFalcon(test.device, test.hand, haptics::HandPlan(test.plan)));
}

/// Of a real device: after a fault there is nothing more to feel.
Result<void> check_fault(haptics::Device& device) {
  auto* falcon = dynamic_cast<haptics::FalconDevice*>(&device);
  if (falcon == nullptr) return {};
  const haptics::FalconStatus& status = falcon->look();
  if (status.state != haptics::FalconState::fault) return {};
  return haptics::falcon_error(status.fault);
}

Result<LabRun> run_lab_real_time(const LabOptions& options, const HoldTest& test,
                                 haptics::ForceScene& scene, ServedClay* clay,
                                 const Progress& progress) {
  auto device = real_time_device(options, test, progress);
  if (!device) return device.error();
  const fs::path file = options.output.empty() ? scratch_file() : options.output;
  auto recorder = haptics::Recorder::start(file, note_of(options));
  if (!recorder) return recorder.error();
  haptics::Servo servo(*device.value(), scene, test.servo, &recorder.value()->ring());
  if (clay != nullptr) {
    if (auto started = clay->start(); !started) return started.error();
  }
  LabRun run;
  {
    haptics::ServoThread thread(servo);
    const double seconds = test.settle_s + test.watch_s;
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    bool is_wanted = true;
    while (elapsed() < seconds && is_wanted) {
      if (auto sound = check_fault(*device.value()); !sound) return sound.error();
      is_wanted = progress("lab", elapsed() / seconds);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!is_wanted) return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
    run.servo = thread.stop();
    run.priority = thread.priority_refusal();
  }
  run.most_given_mj = servo.passivity().most_given_nmm();
  run.dropped = recorder.value()->dropped();
  auto recording = read_back(*recorder.value(), file);
  std::error_code ignored;
  if (options.output.empty()) fs::remove(file, ignored);
  if (!recording) return recording.error();
  run.ticks = std::move(recording.value().ticks);
  judge(run, test.servo.period_s, options.delay_ticks);
  return run;
}

Result<LabRun> run_replay(const haptics::Recording& recording, const HoldTest& test,
                          haptics::ForceScene& scene, ServedClay* clay) {
  const haptics::SimFalcon recorded(test.device, test.hand, haptics::HandPlan(test.plan));
  haptics::ReplayDevice device(recording, recorded.traits(test.servo.period_s));
  haptics::Servo servo(device, scene, test.servo);
  Result<void> worked;
  haptics::replay(servo, recording, [&](const ServoTick& tick) {
    if (clay != nullptr && worked) worked = clay->answer_as(tick.window);
  });
  if (!worked) return worked.error();
  LabRun run;
  run.ticks = recording.ticks;
  run.servo.ticks = run.ticks.size();
  run.servo.faults = servo.faults_seen();
  run.most_given_mj = servo.passivity().most_given_nmm();
  run.different = device.different();
  run.first_different = device.first_different();
  judge(run, test.servo.period_s, test.device.delay_ticks);
  return run;
}

/// What the command line checks of options that a note gives instead.
bool is_in_range(const LabOptions& options) {
  const bool is_servo_good =
      options.hand < std::size(kHandNames) && options.coupling <= 1 &&
      options.rate_hz >= kLeastRateHz && options.rate_hz <= kMostRateHz && options.seconds >= 0.0 &&
      options.seconds <= kMostSeconds && options.delay_ticks >= 0 &&
      options.delay_ticks <= haptics::SimFalcon::kMostDelayTicks &&
      options.coupling_stiffness_n_per_m > 0.0 && options.filter_gain >= 0.0 &&
      options.filter_gain <= 1.0 && options.filter_lambda_mm > 0.0;
  const bool is_clay_good = options.law <= 1 && options.method <= 1 && options.action <= 3 &&
                            options.material.exponent >= 1.0 && options.material.exponent <= 8.0 &&
                            options.material.skin_mm > 0.0;
  return is_servo_good && is_clay_good;
}

}  // namespace

std::string replay_file(const LabOptions& options) {
  constexpr std::string_view kReplay = "replay:";
  return options.device.starts_with(kReplay) ? options.device.substr(kReplay.size()) : "";
}

std::string note_of(const LabOptions& options) {
  Json note;
  note["argil"] = "lab";
  note["scene"] = options.scene;
  note["hand"] = options.hand;
  note["coupling"] = options.coupling;
  note["seconds"] = options.seconds;
  note["rate_hz"] = options.rate_hz;
  note["delay_ticks"] = options.delay_ticks;
  note["coupling_stiffness_n_per_m"] = options.coupling_stiffness_n_per_m;
  note["filter_gain"] = options.filter_gain;
  note["filter_lambda_mm"] = options.filter_lambda_mm;
  note["frictionless"] = options.is_frictionless;
  note["governor"] = options.has_governor;
  note["passivity"] = options.has_passivity;
  note["as_printed"] = options.is_as_printed;
  note["vibro"] = options.has_vibro;
  note["project"] = options.project;
  note["tool_radii_mm"] = cli::to_json(options.tool.radii_mm);
  note["law"] = options.law;
  note["method"] = options.method;
  note["action"] = options.action;
  note["active"] = options.is_active;
  note["exponent"] = options.material.exponent;
  note["skin_mm"] = options.material.skin_mm;
  return note.dump();
}

Result<LabOptions> options_of(const haptics::Recording& recording, const LabOptions& options) {
  const Json note = Json::parse(recording.note, nullptr, false);
  const auto bad = [&](const std::string& what) {
    return Error{ErrorKind::bad_input, "'" + replay_file(options) + "' " + what +
                                           "; record it with 'argil lab " + options.scene +
                                           " -o RUN.csv'"};
  };
  if (!note.is_object() || note.value("argil", "") != "lab") {
    return bad("is not a recording of 'argil lab'");
  }
  LabOptions recorded = options;
  recorded.is_real_time = false;
  try {
    if (note.at("scene") != options.scene) {
      return bad("was recorded in the scene " + note.at("scene").dump());
    }
    note.at("hand").get_to(recorded.hand);
    note.at("coupling").get_to(recorded.coupling);
    note.at("seconds").get_to(recorded.seconds);
    note.at("rate_hz").get_to(recorded.rate_hz);
    note.at("delay_ticks").get_to(recorded.delay_ticks);
    note.at("coupling_stiffness_n_per_m").get_to(recorded.coupling_stiffness_n_per_m);
    note.at("filter_gain").get_to(recorded.filter_gain);
    note.at("filter_lambda_mm").get_to(recorded.filter_lambda_mm);
    note.at("frictionless").get_to(recorded.is_frictionless);
    note.at("governor").get_to(recorded.has_governor);
    note.at("passivity").get_to(recorded.has_passivity);
    note.at("as_printed").get_to(recorded.is_as_printed);
    note.at("vibro").get_to(recorded.has_vibro);
    note.at("project").get_to(recorded.project);
    const Json& radii = note.at("tool_radii_mm");
    recorded.tool.radii_mm = {radii.at(0), radii.at(1), radii.at(2)};
    note.at("law").get_to(recorded.law);
    note.at("method").get_to(recorded.method);
    note.at("action").get_to(recorded.action);
    note.at("active").get_to(recorded.is_active);
    note.at("exponent").get_to(recorded.material.exponent);
    note.at("skin_mm").get_to(recorded.material.skin_mm);
  } catch (const Json::exception& error) {
    return bad(std::string("lacks an option of its run (") + error.what() + ")");
  }
  if (!is_in_range(recorded)) return bad("names an option that is out of its range");
  return recorded;
}

HoldTest hold_test_for(const LabOptions& options, const LabScene& scene) {
  using haptics::Hand;
  constexpr Hand kHands[] = {Hand::push, Hand::light, Hand::arm, Hand::firm};
  HoldTest test;
  if (options.is_frictionless) test.device = haptics::frictionless_falcon();
  test.device.delay_ticks = options.delay_ticks;
  test.hand = haptics::hand_model(kHands[options.hand]);
  // The hand waits off the surface until the servo has ramped in.
  test.plan = scene.plan;
  for (haptics::HandKey& key : test.plan) key.time_s += test.servo.safety.ramp_in_s;
  test.plan.insert(test.plan.begin(), scene.plan.front());
  test.servo.period_s = 1.0 / options.rate_hz;
  test.servo.coupling.kind =
      options.coupling == 0 ? haptics::CouplingKind::direct : haptics::CouplingKind::indirect;
  test.servo.coupling.stiffness_n_per_m = options.coupling_stiffness_n_per_m;
  test.servo.coupling.as_printed = options.is_as_printed;
  test.servo.governor.is_on = options.has_governor;
  test.servo.passivity.controls = options.has_passivity;
  if (options.filter_gain > 0.0) {
    test.servo.position_filter = {options.filter_gain, options.filter_lambda_mm};
  }
  const double planned_s = test.plan.back().time_s + kLabSettleS;
  test.watch_s = kLabWatchS;
  test.settle_s = options.seconds > 0.0 ? std::max(0.0, options.seconds - kLabWatchS) : planned_s;
  return test;
}

Result<LabRun> run_lab(const LabOptions& options, LabScene& scene,
                       const haptics::Recording* recording, const Progress& progress) {
  haptics::VibroScene vibro(scene.felt(), {});
  haptics::ForceScene& felt = options.has_vibro ? vibro : scene.felt();
  const HoldTest test = hold_test_for(options, scene);
  ServedClay* clay = scene.clay ? &scene.clay->served() : nullptr;
  auto run = recording != nullptr   ? run_replay(*recording, test, felt, clay)
             : options.is_real_time ? run_lab_real_time(options, test, felt, clay, progress)
                                    : run_virtual(options, test, felt, clay, progress);
  if (clay != nullptr) {
    if (auto stopped = clay->stop(); run && !stopped) return stopped.error();
  }
  return run;
}

}  // namespace argil::cli::lab
