// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the lab: on virtual time, on the machine's clock, or from a recording, and
// its judgement.
#include "lab/run.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <span>
#include <thread>
#include <utility>

#include "argil/haptics/scene/scene_vibro.h"
#include "argil/haptics/servo/guided_scene.h"

#include "common/command.h"
#include "common/options.h"
#include "common/output.h"
#include "common/tool_option.h"
#include "lab/tick_relay.h"

namespace argil::cli::lab {
namespace {

using haptics::HoldTest;
using haptics::ServoTick;

constexpr double kLabWatchS = 1.0;
/// From the end of the plan until the hold is judged.
constexpr double kLabSettleS = 3.0;
/// From the press of the button on: contact and drag have changed over, and the tool moves.
constexpr double kLabUnderWayS = 0.2;
/// How often it is looked whether to go on, on the machine's time and by ticks.
constexpr std::chrono::milliseconds kLookEvery{10};
constexpr std::uint64_t kLookTicks = 256;

/// Judges the last second of what the servo itself saw: positions as measured, and the forces that
/// the device held from each on, which were written LabRun::delay_ticks before.
void judge(LabRun& run, double period_s) {
  assert(period_s > 0.0 && run.delay_ticks >= 0);
  const auto late = static_cast<std::size_t>(run.delay_ticks);
  run.judgement.verdict = haptics::Verdict::unfinished;
  if (run.ticks.size() < late + 3) return;
  const auto watched =
      std::min(run.ticks.size() - late, static_cast<std::size_t>(kLabWatchS / period_s));
  // A line is taken out of each series, which needs more than two values.
  if (watched < 3) return;
  std::vector<Vec3> positions;
  std::vector<Vec3> forces;
  for (std::size_t n = run.ticks.size() - watched; n < run.ticks.size(); ++n) {
    positions.push_back(run.ticks[n].position_mm);
    forces.push_back(run.ticks[n - late].force_n);
    run.mean_position_mm += positions.back() / static_cast<double>(watched);
  }
  run.judgement = haptics::judge_hold(positions, forces, period_s);
}

/// Ticks from `begin` to before `end`, in which the hand worked the clay.
LabStroke judge_stroke(const std::vector<ServoTick>& ticks, std::size_t begin, std::size_t end,
                       double period_s, std::size_t late) {
  assert(begin >= late && end <= ticks.size() && end - begin >= 3);
  std::vector<Vec3> positions;
  std::vector<Vec3> forces;
  haptics::EnergyAccountOptions account;
  LabStroke stroke;
  stroke.allowed_mj = account.most_nmm;
  for (std::size_t n = begin; n < end; ++n) {
    positions.push_back(ticks[n].position_mm);
    forces.push_back(ticks[n - late].force_n);
    const Vec3& v = ticks[n].velocity_mm_per_s;
    stroke.allowed_mj +=
        period_s * (account.power_mw + 1e-3 * account.device_damping_n_s_per_m * dot(v, v));
  }
  const Vec3 way = positions.back() - positions.front();
  const Vec3 path = length(way) > 0.0 ? normalized(way) : Vec3{1.0, 0.0, 0.0};
  stroke.found = haptics::judge_slide(positions, forces, path, period_s);
  // Energy counts from the press on, a swing or chatter from when the tool is under way.
  const auto skipped = static_cast<std::size_t>(kLabUnderWayS / period_s);
  if (positions.size() > skipped + 3) {
    stroke.found.worst =
        haptics::judge_slide(std::span<const Vec3>(positions).subspan(skipped),
                             std::span<const Vec3>(forces).subspan(skipped), path, period_s)
            .worst;
  }
  stroke.verdict = stroke.found.worst.verdict;
  const bool gives = stroke.found.most_given_mj > stroke.allowed_mj;
  if (gives && stroke.verdict != haptics::Verdict::limit_cycle) {
    stroke.verdict = haptics::Verdict::gives;
  }
  return stroke;
}

int delay_ticks_of(const haptics::Device& device, const HoldTest& test) {
  return haptics::delay_ticks(device.traits(test.servo.period_s), test.servo.period_s);
}

/// From a stroke that is quiet to one that cycles.
int badness(haptics::Verdict verdict) {
  switch (verdict) {
    case haptics::Verdict::quiet:
      return 0;
    case haptics::Verdict::buzz:
      return 1;
    case haptics::Verdict::gives:
      return 2;
    case haptics::Verdict::limit_cycle:
      return 3;
    case haptics::Verdict::unfinished:
      break;
  }
  return 4;
}

/// Keeps the worst stroke of the run, or of several that are as bad the one that gave most.
void judge_strokes(LabRun& run, double period_s) {
  const auto late = static_cast<std::size_t>(run.delay_ticks);
  const auto is_active = [&](std::size_t n) { return (run.ticks[n].buttons & 1U) != 0; };
  for (std::size_t begin = late, end = 0; begin < run.ticks.size(); begin = end + 1) {
    end = begin;
    while (end < run.ticks.size() && is_active(end)) ++end;
    if (end - begin < 3) continue;
    const LabStroke stroke = judge_stroke(run.ticks, begin, end, period_s, late);
    const bool is_worse = !run.stroke || badness(stroke.verdict) > badness(run.stroke->verdict) ||
                          (stroke.verdict == run.stroke->verdict &&
                           stroke.found.most_given_mj > run.stroke->found.most_given_mj);
    if (is_worse) run.stroke = stroke;
  }
}

/// A simulated hand that is still on its way in the last second does not hold anything.
void judge_length(const HoldTest& test, LabRun& run) {
  const double needed_s = test.plan.back().time_s + test.watch_s;
  const double period_s = test.servo.period_s;
  if (run.ticks.empty()) return;
  // By the clock: late ticks are left out and not made up for.
  const double lasted_s = run.ticks.back().time_s - run.ticks.front().time_s + period_s;
  if (lasted_s >= needed_s - 0.5 * period_s) return;
  run.judgement.verdict = haptics::Verdict::unfinished;
  run.needed_s = needed_s;
}

/// A hand that was to press to the end, and against which nothing pushes any more but guidance, has
/// slid off, though it may still lean on a side.
void judge_contact(const HoldTest& test, LabRun& run) {
  constexpr double kLeastPart = 0.1;
  const haptics::HandKey& end = test.plan.back();
  if (!(end.press_n > 0.0)) return;
  const auto is_borne = [&](const ServoTick& tick) {
    return -dot(tick.wanted_n - tick.aid_n, end.direction) > kLeastPart * end.press_n;
  };
  const auto watched =
      std::min(run.ticks.size(), static_cast<std::size_t>(kLabWatchS / test.servo.period_s));
  run.has_lost_contact = std::any_of(run.ticks.begin(), run.ticks.end(), is_borne) &&
                         std::none_of(run.ticks.end() - static_cast<std::ptrdiff_t>(watched),
                                      run.ticks.end(), is_borne);
}

/// Stops a run on virtual time when the user asks, and shows how far it is.
class LabObserver final : public haptics::ServoObserver {
 public:
  LabObserver(ServedClay* clay, const Progress& progress, double seconds)
      : clay_(clay), progress_(progress), seconds_(seconds) {}
  void after_tick(const ServoTick& tick) override {
    if (clay_ != nullptr && worked) worked = clay_->after_tick(tick.time_s);
    if (tick.number % kLookTicks == 0 && !progress_("lab", tick.time_s / seconds_))
      is_stopped = true;
    if (!worked) is_stopped = true;
  }
  std::atomic<bool> is_stopped = false;
  Result<void> worked;  ///< the clay's first error

 private:
  ServedClay* clay_;
  const Progress& progress_;
  double seconds_;
};

Error lab_interrupted() { return {ErrorKind::interrupted, "interrupted; nothing was written"}; }

Result<LabRun> run_virtual(const LabOptions& options, const HoldTest& test,
                           haptics::ForceScene& scene, ServedClay* clay, const Progress& progress) {
  LabObserver observer(clay, progress, test.settle_s + test.watch_s);
  haptics::HoldTestResult result =
      haptics::run_hold_test(scene, test, &observer, &observer.is_stopped);
  if (!observer.worked) return observer.worked.error();
  if (observer.is_stopped) return lab_interrupted();
  if (!options.output.empty()) {
    haptics::Recording recording{note_of(options), std::move(result.ticks)};
    auto kept = haptics::write_recording(options.output, recording, progress);
    if (!kept) return kept.error();
    result.ticks = std::move(recording.ticks);
  }
  LabRun run;
  run.judgement = result.judgement;
  run.mean_position_mm = result.mean_position_mm;
  run.most_given_mj = result.most_given_nmm;
  run.delay_ticks = test.device.delay_ticks;
  run.servo.ticks = result.ticks.size();
  run.servo.faults = result.faults;
  run.ticks = std::move(result.ticks);
  return run;
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

/// Why its thread, or that of a real device, has no priority or no locked memory.
std::string refusal_of(const haptics::ServoThread& thread, const haptics::Device& device) {
  if (!thread.priority_refusal().empty()) return thread.priority_refusal();
  const auto* falcon = dynamic_cast<const haptics::FalconDevice*>(&device);
  return falcon != nullptr ? falcon->priority_refusal() : "";
}

/// The servo on its own thread, for so long.
Result<void> feel_for(double seconds, bool is_quiet, haptics::Servo& servo, haptics::Device& device,
                      LabRun& run, const Progress& progress) {
  TickRelay relay;
  haptics::ServoThread thread(servo, &relay);
  run.priority = refusal_of(thread, device);
  note_refusal(run.priority, is_quiet);
  for (const Stopwatch watch; watch.seconds() < seconds;) {
    if (auto sound = check_fault(device); !sound) return sound;
    if (!progress("lab", watch.seconds() / seconds)) return lab_interrupted();
    std::this_thread::sleep_for(kLookEvery);
    relay.move_to(run.ticks);
  }
  run.servo = thread.stop();
  relay.move_to(run.ticks);
  run.dropped = relay.dropped();
  return {};
}

/// The whole record, or none: one with gaps cannot be judged, and does not take the place of FILE.
Result<void> keep(haptics::Recorder* recorder, const LabRun& run) {
  if (run.dropped > 0) {
    return Error{ErrorKind::disk, "the lab lost " + std::to_string(run.dropped) +
                                      " ticks, so that the run cannot be judged and was not kept; "
                                      "close other programs"};
  }
  return recorder != nullptr ? recorder->finish() : Result<void>();
}

Result<LabRun> run_lab_real_time(const LabOptions& options, const HoldTest& test,
                                 haptics::ForceScene& scene, ServedClay* clay,
                                 const Progress& progress) {
  auto device = real_time_device(options, test, progress);
  if (!device) return device.error();
  std::unique_ptr<haptics::Recorder> recorder;  // null where no file is wanted
  if (!options.output.empty()) {
    auto started = haptics::Recorder::start(options.output, note_of(options));
    if (!started) return started.error();
    recorder = std::move(started).value();
  }
  haptics::Servo servo(*device.value(), scene, test.servo, recorder ? &recorder->ring() : nullptr);
  if (clay != nullptr) {
    if (auto started = clay->start(); !started) return started.error();
  }
  LabRun run;
  const double seconds = test.settle_s + test.watch_s;
  auto felt = feel_for(seconds, options.is_quiet, servo, *device.value(), run, progress);
  if (!felt) return felt.error();
  run.most_given_mj = servo.passivity().most_given_nmm();
  if (auto kept = keep(recorder.get(), run); !kept) return kept.error();
  run.delay_ticks = delay_ticks_of(*device.value(), test);
  judge(run, test.servo.period_s);
  return run;
}

Result<LabRun> run_replay(const haptics::Recording& recording, const HoldTest& test,
                          haptics::ForceScene& scene, ServedClay* clay, const Progress& progress) {
  const haptics::SimFalcon recorded(test.device, test.hand, haptics::HandPlan(test.plan));
  haptics::ReplayDevice device(recording, recorded.traits(test.servo.period_s));
  LabRun run;
  run.ticks = recording.ticks;
  haptics::ServoTickRing ring(2);  // a tick waits for the next one
  haptics::Servo servo(device, scene, test.servo, &ring);
  // A recording does not have the aid; it comes back as it was.
  const auto take_aid = [&] {
    for (ServoTick tick; ring.pop(tick);) {
      run.ticks[tick.number - 1].aid_n = tick.aid_n;
      run.ticks[tick.number - 1].given_part = tick.given_part;
    }
  };
  const auto answer = [&](const ServoTick& tick) {
    take_aid();
    return clay != nullptr ? clay->answer_as(tick.window) : Result<void>();
  };
  if (auto done = haptics::replay(servo, recording, answer, progress); !done) return done.error();
  take_aid();
  run.servo.ticks = run.ticks.size();
  run.servo.faults = servo.faults_seen();
  run.most_given_mj = servo.passivity().most_given_nmm();
  run.different = device.different();
  run.first_different = device.first_different();
  run.delay_ticks = delay_ticks_of(device, test);
  judge(run, test.servo.period_s);
  return run;
}

/// Throws Json::exception.
FeelChoice feel_of(const Json& note) {
  FeelChoice feel;
  note.at("filter_gain").get_to(feel.filter_gain);
  note.at("filter_lambda_mm").get_to(feel.filter_lambda_mm);
  feel.damping = note.value("damping", std::size_t{0});  // older recordings are of fixed damping
  if (!note.contains("mix_ramp_s")) return feel;         // older recordings are of the usual mix
  note.at("mix_ramp_s").get_to(feel.mix_ramp_s);
  note.at("mix_passive").at(0).get_to(feel.mix.contact_passive);
  note.at("mix_passive").at(1).get_to(feel.mix.viscosity_passive);
  note.at("mix_active").at(0).get_to(feel.mix.contact_active);
  note.at("mix_active").at(1).get_to(feel.mix.viscosity_active);
  return feel;
}

/// A number that a note gives, the option that it is of, and what that takes.
struct Noted {
  const char* option;
  double value;
  Range range;
};

/// What the command line checks of options that a note gives instead.
/// Errors  bad_input naming the option, its value and its range.
Result<void> check_noted(const LabOptions& options) {
  const auto index = [](std::size_t chosen, std::size_t count) {
    return std::pair{static_cast<double>(chosen), Range{0.0, static_cast<double>(count) - 1.0}};
  };
  const auto [hand, hands] = index(options.hand, kHands.size());
  const auto [action, actions] = index(options.action, kWorkActions.size());
  const auto [coupling, couplings] = index(options.coupling, 2);
  const auto [damping, dampings] = index(options.feel.damping, 2);
  const auto [law, laws] = index(options.law, 2);
  const auto [method, methods] = index(options.method, 3);
  const Noted all[] = {
      {"--hand", hand, hands},
      {"--coupling", coupling, couplings},
      {"--damping", damping, dampings},
      {"--rate", options.rate_hz, {kLeastRateHz, kMostRateHz}},
      {"--seconds", options.seconds, {0.0, kMostSeconds}},
      {"--delay",
       static_cast<double>(options.delay_ticks),
       {0.0, static_cast<double>(haptics::SimFalcon::kMostDelayTicks)}},
      {"--stiffness", options.coupling_stiffness_n_per_m, kPositive},
      {"--law", law, laws},
      {"--method", method, methods},
      {"--action", action, actions},
      {"--exponent", options.material.exponent, {1.0, 8.0}},
      {"--skin-mm", options.material.skin_mm, kPositive},
      {"a radius of --tool", options.tool.radii_mm.x, kPositive},
      {"a radius of --tool", options.tool.radii_mm.y, kPositive},
      {"a radius of --tool", options.tool.radii_mm.z, kPositive},
  };
  for (const auto& [option, value, range] : all) {
    const bool is_low = range.above_least ? !(value > range.least) : !(value >= range.least);
    if (!is_low && value <= range.most) continue;
    return Error{ErrorKind::bad_input,
                 std::string(option) + " is " + number(value) + "; must be " +
                     (range.above_least ? "greater than " : "") + number(range.least) +
                     (range.above_least ? " and at most " : " to ") + number(range.most)};
  }
  if (auto good = check_feel_ranges(options.feel); !good) return good;
  return haptics::check_guidance(options.guidance);
}

Json guidance_note(const haptics::GuidanceOptions& guidance) {
  Json note;
  note["kind"] = haptics::guidance_name(guidance.kind);
  note["stiffness_n_per_m"] = guidance.stiffness_n_per_m;
  note["most_force_n"] = guidance.most_force_n;
  note["path_mm"] = Json::array();
  for (const Vec3& point : guidance.path_mm) note["path_mm"].push_back(cli::to_json(point));
  return note;
}

/// Back from the note; in a recording without it there was none. False for a kind that is unknown;
/// throws as Json does.
bool read_guidance(const Json& note, haptics::GuidanceOptions& guidance) {
  guidance = {};
  if (note.empty()) return true;
  using haptics::GuidanceKind;
  const std::string name = note.at("kind");
  bool is_known = false;
  for (const GuidanceKind kind :
       {GuidanceKind::none, GuidanceKind::direct, GuidanceKind::indirect, GuidanceKind::hybrid}) {
    if (name != haptics::guidance_name(kind)) continue;
    guidance.kind = kind;
    is_known = true;
  }
  note.at("stiffness_n_per_m").get_to(guidance.stiffness_n_per_m);
  note.at("most_force_n").get_to(guidance.most_force_n);
  for (const Json& point : note.at("path_mm")) {
    guidance.path_mm.push_back({point.at(0), point.at(1), point.at(2)});
  }
  return is_known;
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
  note["settings"] = options.settings;
  note["device"] = options.device == "falcon" ? "falcon" : "sim";
  note["hand"] = options.hand;
  note["coupling"] = options.coupling;
  note["damping"] = options.feel.damping;
  note["seconds"] = options.seconds;
  note["rate_hz"] = options.rate_hz;
  note["delay_ticks"] = options.delay_ticks;
  note["coupling_stiffness_n_per_m"] = options.coupling_stiffness_n_per_m;
  note["filter_gain"] = options.feel.filter_gain;
  note["filter_lambda_mm"] = options.feel.filter_lambda_mm;
  const haptics::ForceMix& mix = options.feel.mix;
  note["mix_passive"] = {mix.contact_passive, mix.viscosity_passive};
  note["mix_active"] = {mix.contact_active, mix.viscosity_active};
  note["mix_ramp_s"] = options.feel.mix_ramp_s;
  note["frictionless"] = options.is_frictionless;
  note["governor"] = options.has_governor;
  note["passivity"] = options.has_passivity;
  note["as_printed"] = options.is_as_printed;
  note["vibro"] = options.has_vibro;
  note["guidance"] = guidance_note(options.guidance);
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
  // Without exceptions: anybody may have written the note.
  const Json note = Json::parse(recording.note, nullptr, false);
  const auto bad = [&](const std::string& what) {
    return Error{ErrorKind::bad_input, "'" + replay_file(options) + "' " + what +
                                           "; record it with 'argil lab " + options.scene +
                                           " -o RUN.csv'"};
  };
  if (!note.is_object() || !note.contains("argil") || note["argil"] != "lab") {
    return bad("is not a recording of 'argil lab'");
  }
  LabOptions recorded = options;
  recorded.is_real_time = false;
  try {
    if (const std::string scene = note.at("scene"); scene != options.scene) {
      return bad("was recorded in the scene '" + scene + "'");
    }
    // Older recordings are of usual scenes.
    recorded.settings = note.value("settings", SceneSettings());
    recorded.is_held_by_a_person = note.value("device", "sim") == "falcon";
    note.at("hand").get_to(recorded.hand);
    note.at("coupling").get_to(recorded.coupling);
    note.at("seconds").get_to(recorded.seconds);
    note.at("rate_hz").get_to(recorded.rate_hz);
    note.at("delay_ticks").get_to(recorded.delay_ticks);
    note.at("coupling_stiffness_n_per_m").get_to(recorded.coupling_stiffness_n_per_m);
    recorded.feel = feel_of(note);
    note.at("frictionless").get_to(recorded.is_frictionless);
    note.at("governor").get_to(recorded.has_governor);
    note.at("passivity").get_to(recorded.has_passivity);
    note.at("as_printed").get_to(recorded.is_as_printed);
    note.at("vibro").get_to(recorded.has_vibro);
    if (!read_guidance(note.value("guidance", Json::object()), recorded.guidance)) {
      return bad("is of a kind of guidance that is unknown");
    }
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
  if (auto good = check_noted(recorded); !good) {
    return bad("says what no run has: " + good.error().message);
  }
  return recorded;
}

HoldTest hold_test_for(const LabOptions& options, const LabScene& scene) {
  assert(options.hand < kHands.size() && options.rate_hz > 0.0 && !scene.plan.empty());
  HoldTest test;
  if (options.is_frictionless) test.device = haptics::frictionless_falcon();
  test.device.delay_ticks = options.delay_ticks;
  test.hand = haptics::hand_model(kHands[options.hand]);
  // The hand waits off the surface until the servo has ramped in.
  test.plan = after_wait(scene.plan, test.servo.safety.ramp_in_s);
  test.servo.period_s = 1.0 / options.rate_hz;
  test.servo.coupling.kind =
      options.coupling == 0 ? haptics::CouplingKind::direct : haptics::CouplingKind::indirect;
  test.servo.coupling.stiffness_n_per_m = options.coupling_stiffness_n_per_m;
  test.servo.coupling.as_printed = options.is_as_printed;
  test.servo.damping.kind = options.feel.damping_kind();
  test.servo.governor.is_on = options.has_governor;
  test.servo.passivity.controls = options.has_passivity;
  test.servo.position_filter = options.feel.filter();
  const double planned_s = test.plan.back().time_s + kLabSettleS;
  test.watch_s = kLabWatchS;
  test.settle_s = options.seconds > 0.0 ? std::max(0.0, options.seconds - kLabWatchS) : planned_s;
  return test;
}

haptics::GuidanceOptions guidance_for(const LabOptions& options, const LabScene& scene) {
  haptics::GuidanceOptions guidance = options.guidance;
  for (Vec3& point : guidance.path_mm) point -= scene.offset_mm;
  return guidance;
}

LabFollowing following_of(const std::vector<ServoTick>& ticks, const std::vector<Vec3>& path_mm,
                          const haptics::GuidanceState& account) {
  assert(!path_mm.empty());
  LabFollowing found;
  found.given_mj = account.given_mj;
  found.worked_mj = account.worked_mj;
  found.stiffness_n_per_m = account.stiffness_n_per_m;
  double square = 0.0;
  std::size_t count = 0;
  for (const ServoTick& tick : ticks) {
    if (!tick.is_ready || (tick.faults & (haptics::kCutFaults | haptics::kRampFaults)) != 0) {
      continue;
    }
    const Vec3 off_mm = tick.proxy_mm - haptics::nearest_on_path(path_mm, tick.proxy_mm);
    square += dot(off_mm, off_mm);
    found.most_error_mm = std::max(found.most_error_mm, length(off_mm));
    found.effort_n += tick.given_part * length(tick.aid_n);
    ++count;
  }
  if (count == 0) return found;
  found.error_mm = std::sqrt(square / static_cast<double>(count));
  found.effort_n /= static_cast<double>(count);
  return found;
}

Result<LabRun> run_lab(const LabOptions& options, LabScene& scene,
                       const haptics::Recording* recording, const Progress& progress) {
  haptics::VibroScene vibro(scene.felt(), {});
  // The clay has a texture of its own (ClaySceneOptions::texture).
  haptics::ForceScene& touched = options.has_vibro && !scene.clay ? vibro : scene.felt();
  haptics::GuidedScene felt(touched, guidance_for(options, scene));
  const HoldTest test = hold_test_for(options, scene);
  ServedClay* clay = scene.clay ? &scene.clay->served() : nullptr;
  auto run = recording != nullptr   ? run_replay(*recording, test, felt, clay, progress)
             : options.is_real_time ? run_lab_real_time(options, test, felt, clay, progress)
                                    : run_virtual(options, test, felt, clay, progress);
  const bool has_plan = !options.is_held_by_a_person && options.device != "falcon";
  if (run && has_plan) judge_length(test, run.value());
  if (run && has_plan) judge_contact(test, run.value());
  if (run) judge_strokes(run.value(), test.servo.period_s);
  if (run && options.guidance.kind != haptics::GuidanceKind::none) {
    run.value().following =
        following_of(run.value().ticks, guidance_for(options, scene).path_mm, felt.guidance());
  }
  if (clay != nullptr) {
    if (auto stopped = clay->stop(); run && !stopped) return stopped.error();
  }
  return run;
}

}  // namespace argil::cli::lab
