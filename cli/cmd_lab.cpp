// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab SCENE: a hand, a Falcon and a servo in a scene; what it felt and whether it was steady.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "argil/haptics/analysis/free_oscillation.h"
#include "argil/haptics/rig/rig.h"
#include "argil/io/safe_file.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "common/tool_option.h"
#include "lab/lab.h"
#include "lab/run.h"
#include "lab/trial.h"

namespace argil::cli {
namespace {

using lab::LabOptions;
using lab::LabRun;
using lab::LabScene;
using lab::LabSceneKind;

const LabSceneKind* scene_kind_of(const std::string& name) {
  for (const LabSceneKind& kind : lab::scene_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

/// Not a scene but a study in several.
constexpr const char* kTrialWord = "trial";

std::string scene_help() {
  std::string text = "the scene, or a study:";
  for (const LabSceneKind& kind : lab::scene_kinds()) {
    text += "\n" + std::string(kind.name) + ": " + kind.about;
  }
  text += "\n" + std::string(kTrialWord) +
          ": short tasks with and without force, by all hands, and what came of them";
  return text;
}

std::string check_scene(const std::string& name) {
  if (scene_kind_of(name) != nullptr || name == kTrialWord) return "";
  std::string known;
  for (const LabSceneKind& kind : lab::scene_kinds()) known += std::string(kind.name) + ", ";
  return "SCENE is '" + name + "'; must be one of " + known + kTrialWord;
}

/// Of a scene that is known: what is not has been said.
void check_settings(const LabOptions& options) {
  if (const LabSceneKind* kind = scene_kind_of(options.scene); kind != nullptr) {
    check_scene_settings(kind->parameters, options.settings);
  }
}

void check_lab_feel(const LabOptions& options, const CLI::App& command) {
  check_feel(options.feel);
  for (const char* name : {"--mix-passive", "--mix-active", "--mix-ramp"}) {
    if (options.scene == "clay" || command.count(name) == 0) continue;
    throw CLI::ValidationError(std::string(name) + " is of the scene 'clay'; SCENE is '" +
                               options.scene + "'");
  }
}

Json parameter_json(const haptics::SceneParameter& parameter) {
  Json json;
  json["name"] = parameter.name;
  json["unit"] = parameter.unit;
  json["usual"] = parameter.usual;
  json["low"] = parameter.low;
  json["high"] = parameter.high;
  json["about"] = parameter.about;
  json["equation"] = parameter.equation;
  return json;
}

/// All scenes and what can be set of each.
Outcome list_scenes() {
  Outcome outcome;
  outcome.json["scenes"] = Json::array();
  for (const LabSceneKind& kind : lab::scene_kinds()) {
    Json scene;
    scene["name"] = kind.name;
    scene["about"] = kind.about;
    scene["parameters"] = Json::array();
    outcome.text += std::string(kind.name) + ": " + kind.about + "\n";
    for (const haptics::SceneParameter& parameter : kind.parameters) {
      scene["parameters"].push_back(parameter_json(parameter));
      const std::string unit = *parameter.unit != '\0' ? std::string(" ") + parameter.unit : "";
      outcome.text +=
          "  " + std::string(parameter.name) + " = " + number(parameter.usual) + unit + ", " +
          number(parameter.low) + " to " + number(parameter.high) + ": " + parameter.about +
          (*parameter.equation != '\0' ? ", " + std::string(parameter.equation) : "") + "\n";
    }
    outcome.json["scenes"].push_back(std::move(scene));
  }
  return outcome;
}

std::string check_lab_device(const std::string& device) {
  constexpr std::string_view kReplay = "replay:";
  if (device == "sim" || device == "falcon") return "";
  if (device.starts_with(kReplay) && device.size() > kReplay.size()) return "";
  return "--device is '" + device + "'; must be sim, falcon or replay:RUN.csv";
}

Json times_json(const haptics::Histogram& times) {
  Json json;
  json["p50"] = times.quantile_us(0.5);
  json["p99"] = times.quantile_us(0.99);
  json["p99_9"] = times.quantile_us(0.999);
  json["max"] = times.max_us();
  return json;
}

/// How old what the ticks felt was, in ms; null where that is not known.
Json ages_of(const std::vector<haptics::ServoTick>& ticks) {
  std::vector<double> ages;
  for (const haptics::ServoTick& tick : ticks) {
    if (tick.window.age_s >= 0.0) ages.push_back(1e3 * tick.window.age_s);
  }
  return ages.empty() ? Json() : percentiles(std::move(ages));
}

/// Of the scene's spring, in N/m.
double stiffness_of(const LabOptions& options) {
  return scene_values(scene_kind_of(options.scene)->parameters, options.settings)["k"];
}

/// What the released handle tells, by eq. 3.2 to 3.5 of the Falcon report.
Json oscillation_json(const LabOptions& options, const LabRun& run) {
  std::vector<double> x;
  for (const auto& tick : run.ticks) x.push_back(tick.position_mm.x);
  const double period_s = 1.0 / options.rate_hz;
  // Through a coupling the handle swings in both springs.
  double stiffness = stiffness_of(options);
  if (options.coupling == 1) {
    const double spring =
        std::min(options.coupling_stiffness_n_per_m, run.ticks.back().most_stiffness_n_per_m);
    // Springs in series.
    stiffness *= spring / (stiffness + spring);
  }
  constexpr double kLeastPeakMm = 0.5;
  const auto found = haptics::estimate_free_oscillation(
      x, period_s, stiffness, options.delay_ticks * period_s, kLeastPeakMm);
  Json json;
  json["peaks"] = found.peaks;
  json["stiffness_n_per_m"] = stiffness;
  json["decrement"] = found.decrement;
  json["damping_ratio"] =
      options.is_as_printed ? found.damping_ratio_as_printed : found.damping_ratio;
  json["omega_rad_per_s"] = found.omega_rad_per_s;
  json["mass_kg"] = options.is_as_printed ? found.mass_kg_as_printed : found.mass_kg;
  json["damping_n_s_per_m"] =
      options.is_as_printed ? found.loop_damping_n_s_per_m : found.device_damping_n_s_per_m;
  json["printed"]["damping_ratio"] = found.damping_ratio_as_printed;
  json["printed"]["mass_kg"] = found.mass_kg_as_printed;
  json["printed"]["damping_n_s_per_m"] = found.loop_damping_n_s_per_m;
  return json;
}

Json following_json(const LabOptions& options, const lab::LabFollowing& following) {
  Json json;
  json["kind"] = haptics::guidance_name(options.guidance.kind);
  json["error_mm"] = following.error_mm;
  json["most_error_mm"] = following.most_error_mm;
  json["effort_n"] = following.effort_n;
  json["worked_mj"] = following.worked_mj;
  json["given_mj"] = following.given_mj;
  json["asked_n_per_m"] = options.guidance.stiffness_n_per_m;
  json["stiffness_n_per_m"] = following.stiffness_n_per_m;
  return json;
}

std::string following_text(const Json& guided) {
  return "  guided (" + guided["kind"].get<std::string>() + "): off the path by " +
         number(guided["error_mm"]) + " mm rms, at most " + number(guided["most_error_mm"]) + "; " +
         number(guided["effort_n"]) + " N mean, the hand worked " + number(guided["worked_mj"]) +
         " mJ against it, and was given " + number(guided["given_mj"]) + " mJ net" +
         softened_words(guided["asked_n_per_m"], guided["stiffness_n_per_m"]) + "\n";
}

Json stroke_json(const lab::LabStroke& stroke) {
  Json json;
  json["verdict"] = haptics::verdict_name(stroke.verdict);
  json["position_pp_mm"] = stroke.found.worst.position_pp_mm;
  json["force_pp_n"] = stroke.found.worst.force_pp_n;
  json["given_mj"] = stroke.found.most_given_mj;
  json["allowed_mj"] = stroke.allowed_mj;
  return json;
}

/// How far the handle came along each axis (section 3.1).
Json reach_json(const std::vector<haptics::ServoTick>& ticks) {
  const Box3 reach = lab::reach_along_axes(ticks);
  if (reach.empty()) return {};
  Json json;
  json["min"] = to_json(reach.min);
  json["max"] = to_json(reach.max);
  return json;
}

/// What adaptive damping added: the most in a tick, and at the end.
Json added_damping_json(const std::vector<haptics::ServoTick>& ticks) {
  Json json;
  double most = 0.0;
  for (const haptics::ServoTick& tick : ticks) {
    most = std::max(most, tick.added_damping_n_s_per_m);
  }
  json["most"] = most;
  json["last"] = ticks.empty() ? 0.0 : ticks.back().added_damping_n_s_per_m;
  return json;
}

/// The stroke's, where the hold that followed was quiet.
haptics::Verdict verdict_of(const LabRun& run) {
  const bool is_quiet = run.judgement.verdict == haptics::Verdict::quiet;
  return is_quiet && run.stroke ? run.stroke->verdict : run.judgement.verdict;
}

Json lab_json(const LabOptions& options, const LabScene& scene, const LabRun& run) {
  Json json;
  json["scene"] = options.scene;
  json["verdict"] = haptics::verdict_name(verdict_of(run));
  json["position_pp_mm"] = run.judgement.position_pp_mm;
  json["force_pp_n"] = run.judgement.force_pp_n;
  json["work_mw"] = run.judgement.work_mw;
  json["frequency_hz"] = run.judgement.frequency_hz;
  json["depth_mm"] = dot(run.mean_position_mm - scene.surface_mm, scene.inward);
  json["contact_lost"] = run.has_lost_contact;
  json["most_given_mj"] = run.most_given_mj;
  if (run.stroke) json["stroke"] = stroke_json(*run.stroke);
  if (run.following) json["guidance"] = following_json(options, *run.following);
  json["most_stiffness_n_per_m"] =
      run.ticks.empty() ? 0.0 : run.ticks.back().most_stiffness_n_per_m;
  if (options.feel.damping != 0 && lab::replay_file(options).empty()) {
    json["added_damping_n_s_per_m"] = added_damping_json(run.ticks);
  }
  json["ticks"] = run.servo.ticks;
  json["late_ticks"] = run.servo.late_ticks;
  json["skipped_ticks"] = run.servo.skipped_ticks;
  json["faults"] = faults_json(run.servo.faults);
  if (options.scene == "free" && !run.ticks.empty())
    json["handle"] = oscillation_json(options, run);
  if (options.scene == "workspace") json["reach_mm"] = reach_json(run.ticks);
  // Figures of the machine, which virtual time does not have.
  if (options.is_real_time) {
    json["period_us"] = times_json(run.servo.period);
    json["lateness_us"] = times_json(run.servo.lateness);
    json["tick_us"] = times_json(run.servo.cost);
    json["priority"] = run.priority.empty() ? "real-time" : run.priority;
    json["dropped_ticks"] = run.dropped;
  }
  if (scene.clay) {
    json["clay"] = scene.clay->report();
    if (const Json ages = ages_of(run.ticks); !ages.is_null()) json["clay"]["age_ms"] = ages;
  }
  if (!lab::replay_file(options).empty()) {
    json["different_ticks"] = run.different;
    json["first_different_tick"] = run.first_different;
  }
  return json;
}

/// What to do about a run that is too short to judge.
std::string unfinished_text(double needed_s, bool is_replay) {
  constexpr double kLeastS = 2.0;  // where nobody knows better
  return std::string("  the run ended before the hold; ") +
         (is_replay ? "record it with" : "give it") + " --seconds " +
         number(std::max(kLeastS, std::ceil(needed_s))) + " or more\n";
}

/// By (3.2) to (3.5), exact and as the report prints them.
std::string handle_text(const Json& handle) {
  if (handle["peaks"] < 2) return "  the handle stopped without swinging\n";
  const Json& printed = handle["printed"];
  const auto both = [&](const char* name) {
    return number(handle[name]) + " (as printed " + number(printed[name]) + ")";
  };
  return "  the handle: decrement " + number(handle["decrement"]) + ", damping ratio " +
         both("damping_ratio") + ", " + number(handle["omega_rad_per_s"]) + " rad/s, " +
         both("mass_kg") + " kg, " + both("damping_n_s_per_m") + " N s/m\n";
}

/// What --vibro came to on clay.
std::string texture_text(double most_n) {
  constexpr double kFeltN = 0.002;  // less is the rounding of distances
  if (most_n >= kFeltN) return "  its texture was felt as up to " + number(most_n) + " N\n";
  return "  it has nothing that is too fine for the tool's windows, so that --vibro added nothing; "
         "try --set A=0.1, or a project of finer voxels\n";
}

std::string lab_text(const Json& json, double needed_s) {
  std::string text = json["scene"].get<std::string>() + ": " + json["verdict"].get<std::string>() +
                     "; swing " + number(json["position_pp_mm"]) + " mm, force " +
                     number(json["force_pp_n"]) + " N peak to peak, " + number(json["work_mw"]) +
                     " mW, depth " + number(json["depth_mm"]) + " mm, " + json["ticks"].dump() +
                     " ticks\n";
  if (json["verdict"] == haptics::verdict_name(haptics::Verdict::unfinished)) {
    text += unfinished_text(needed_s, json.contains("different_ticks"));
  }
  if (json["contact_lost"] == true) {
    text +=
        "  contact was lost: the hand slid off and presses nothing at the end, so that the verdict "
        "is of the air\n";
  }
  for (const Json& fault : json["faults"]) text += "  " + fault.get<std::string>() + "\n";
  if (json.contains("added_damping_n_s_per_m")) {
    const Json& added = json["added_damping_n_s_per_m"];
    text += "  adaptive damping added up to " + number(added["most"]) + " N s/m, at the end " +
            number(added["last"]) + "\n";
  }
  if (json.contains("handle")) {
    text += handle_text(json["handle"]);
  }
  if (json.contains("reach_mm") && !json["reach_mm"].is_null()) {
    text += "  the handle reached";
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text += std::string(axis == 0 ? " " : ", ") + "xyz"[axis] + " " +
              number(json["reach_mm"]["min"][axis]) + " to " +
              number(json["reach_mm"]["max"][axis]);
    }
    text += " mm\n";
  }
  if (json.contains("stroke")) {
    const Json& stroke = json["stroke"];
    text += "  the stroke: " + stroke["verdict"].get<std::string>() + "; swing " +
            number(stroke["position_pp_mm"]) + " mm, force " + number(stroke["force_pp_n"]) +
            " N peak to peak, gave the hand " + number(stroke["given_mj"]) + " mJ of " +
            number(stroke["allowed_mj"]) + " that it may\n";
  }
  if (json.contains("guidance")) text += following_text(json["guidance"]);
  if (json.contains("clay")) {
    const Json& clay = json["clay"];
    text += "  the clay: " + clay["windows"].dump() + " windows, " + clay["dabs"].dump() +
            " dabs, " + number(clay["carved_mm3"]) + " mm3 carved\n";
    if (clay.contains("texture_n")) text += texture_text(clay["texture_n"]);
    if (clay.contains("age_ms")) {
      const Json& age = clay["age_ms"];
      text += "  felt " + number(age["p50"]) + " ms after it was so, p99 " + number(age["p99"]) +
              ", max " + number(age["max"]) + "\n";
    }
  }
  if (json.contains("tick_us")) {
    text += "  tick p50 " + number(json["tick_us"]["p50"]) + " us, p99 " +
            number(json["tick_us"]["p99"]) + ", max " + number(json["tick_us"]["max"]) +
            "; late p99 " + number(json["lateness_us"]["p99"]) + " us, max " +
            number(json["lateness_us"]["max"]) + "; " + json["late_ticks"].dump() + " late, " +
            json["skipped_ticks"].dump() +
            " skipped; priority: " + json["priority"].get<std::string>() + "\n";
  }
  if (json.contains("different_ticks")) {
    text += json["different_ticks"] == 0
                ? std::string("  replayed to the same forces, bit for bit\n")
                : "  " + json["different_ticks"].dump() + " ticks differ, the first is " +
                      json["first_different_tick"].dump() + "\n";
  }
  return text;
}

constexpr double kLeastFalconRateHz = 1.0 / haptics::kFalconMostPeriodS;

/// A real device is held to what a rig may do with it; the simulated one may cycle.
Result<void> check_falcon_options(const LabOptions& options) {
  if (options.device != "falcon") {
    if (options.falcon == FalconChoice{}) return {};
    return Error{ErrorKind::bad_input,
                 "--firmware, --serial, --calibration and --flush are of --device falcon; add that "
                 "or leave them out"};
  }
  if (options.rate_hz < kLeastFalconRateHz) {
    return Error{ErrorKind::bad_input,
                 "--rate is " + number(options.rate_hz) + "; must be at least " +
                     number(kLeastFalconRateHz) +
                     " with --device falcon, whose watchdog lets go of a force that is not "
                     "repeated"};
  }
  auto driver = falcon_options(options.falcon);
  if (!driver) return driver.error();
  haptics::RigOptions rig;
  rig.device = haptics::RigDevice::falcon;
  rig.falcon = std::move(driver).value();
  rig.period_s = 1.0 / options.rate_hz;
  rig.coupling =
      options.coupling == 0 ? haptics::CouplingKind::direct : haptics::CouplingKind::indirect;
  rig.coupling_stiffness_n_per_m = options.coupling_stiffness_n_per_m;
  rig.scene = options.scene;
  rig.tool = options.tool;
  rig.material = options.material;
  rig.position_filter = options.feel.filter();
  rig.mix = options.feel.mix;
  rig.mix_ramp_s = options.feel.mix_ramp_s;
  return haptics::check_rig(rig);
}

/// What a study has of the lab's options; the rest is of a scene, which it has not got.
void check_trial_options(const CLI::App& command) {
  constexpr std::array kOfTrials{"--json",   "--quiet",    "--threads", "--max-memory",
                                 "--seed",   "--repeats",  "--task",    "--hand",
                                 "--device", "--firmware", "--serial",  "--calibration",
                                 "--flush",  "--output",   "--plot",    "SCENE"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name =
        option->get_lnames().empty() ? option->get_name(true) : "--" + option->get_lnames().front();
    const bool is_of_trials =
        std::find(kOfTrials.begin(), kOfTrials.end(), name) != kOfTrials.end();
    if (option->count() == 0 || is_of_trials) continue;
    throw CLI::ValidationError(name + " is of a scene; leave it out with '" + kTrialWord + "'");
  }
}

/// Of a study that ended early: what is left of it.
Error with_kept(Error error, std::size_t kept, const std::filesystem::path& file) {
  if (kept > 0) {
    error.message += "; what had ended, " + std::to_string(kept) + " of the trials, is in '" +
                     file.string() + "'";
  } else if (error.kind == ErrorKind::interrupted) {
    error.message += "; nothing was written";
  }
  return error;
}

Result<Outcome> run_trial_command(const LabOptions& options, lab::TrialOptions trial,
                                  const Progress& progress) {
  if (!lab::replay_file(options).empty()) {
    return Error{ErrorKind::bad_input,
                 "--device is '" + options.device + "'; a trial takes sim or falcon"};
  }
  LabOptions of_scene = options;
  of_scene.scene = "clay";  // what a real device is held to is not asked of a study's name
  if (auto good = check_falcon_options(of_scene); !good) return good.error();
  trial.is_falcon = options.device == "falcon";
  trial.falcon = options.falcon;
  if (trial.repeats == 0) {
    trial.repeats = trial.is_falcon ? lab::kUsualPersonRepeats : lab::kUsualRepeats;
  }
  trial.hand = options.hand;
  trial.is_quiet = options.is_quiet;
  if (!trial.is_falcon) end_within_a_second();
  for (const auto& file : {options.output, options.plot}) {
    if (file.empty()) continue;
    if (auto output = check_output(file); !output) return output.error();
  }
  // A person's study is not lost with its last trial.
  std::size_t kept = 0;
  const auto keep = [&](const std::vector<lab::TrialResult>& so_far) {
    if (options.output.empty()) return Result<void>();
    kept = so_far.size();
    return io::replace_text(options.output, lab::trial_csv(trial, so_far));
  };
  const auto results = lab::run_trials(trial, keep, progress);
  if (!results) return with_kept(results.error(), kept, options.output);
  Outcome outcome;
  outcome.json = lab::trial_json(trial, results.value());
  outcome.text = lab::trial_text(outcome.json);
  if (!options.plot.empty()) {
    if (auto drawn = lab::draw_trials(options.plot, outcome.json); !drawn) return drawn.error();
  }
  return outcome;
}

Result<Outcome> run_lab_command(const LabOptions& asked, const Progress& progress) {
  if (auto good = check_falcon_options(asked); !good) return good.error();
  LabOptions options = asked;
  // A real one is to have its zero words, however long that takes.
  const bool is_falcon = options.device == "falcon";
  if (is_falcon) options.is_real_time = true;
  if (!is_falcon) end_within_a_second();
  for (const auto& file : {options.output, options.plot, options.save}) {
    if (file.empty()) continue;
    if (auto output = check_output(file); !output) return output.error();
  }
  auto guidance = guidance_of(options.guide);
  if (!guidance) return guidance.error();
  options.guidance = std::move(guidance).value();
  std::optional<haptics::Recording> recording;
  if (const std::string file = lab::replay_file(options); !file.empty()) {
    if (auto input = check_input(file); !input) return input.error();
    auto read = haptics::read_recording(file);
    if (!read) return read.error();
    recording = std::move(read).value();
    // The recording says what ran; of the command line only the scene must agree.
    auto recorded = lab::options_of(*recording, asked);
    if (!recorded) return recorded.error();
    options = std::move(recorded).value();
  }
  auto made = scene_kind_of(options.scene)->make(options, progress);
  if (!made) return made.error();
  LabScene& scene = made.value();
  const auto run = lab::run_lab(options, scene, recording ? &*recording : nullptr, progress);
  end_within_a_second();  // a device that was driven has had its zero words
  if (!run) return run.error();
  if (scene.clay && !options.save.empty()) {
    if (auto saved = replace_project(options.save, scene.clay->clay()); !saved) {
      return saved.error();
    }
  }
  if (!options.plot.empty()) {
    if (auto drawn = lab::draw_run(options.plot, options, scene, run.value().ticks); !drawn) {
      return drawn.error();
    }
  }
  Outcome outcome;
  outcome.json = lab_json(options, scene, run.value());
  outcome.text = lab_text(outcome.json, run.value().needed_s);
  // A replay that differs and a hold that was not reached are the answer no, not an error.
  const bool is_unfinished = run.value().judgement.verdict == haptics::Verdict::unfinished;
  outcome.status = run.value().different > 0 || is_unfinished ? 1 : 0;
  return outcome;
}

void add_servo_options(CLI::App& command, LabOptions& options) {
  add_hand(command, options.hand, "who holds it; default arm");
  add_choice(
      command, "--coupling", options.coupling, {"direct", "indirect"},
      "the handle itself in the scene (4.1), or a proxy on a spring (4.2); default indirect");
  add_damping_option(command, options.feel);
  add_number(command, "--stiffness", options.coupling_stiffness_n_per_m, kPositive,
             "most of that spring in N/m; the governor may allow less; default 1500");
  add_number(command, "--rate", options.rate_hz, {lab::kLeastRateHz, lab::kMostRateHz},
             "ticks a second; default 1000");
  add_integer(command, "--delay", options.delay_ticks, 0, haptics::SimFalcon::kMostDelayTicks,
              "ticks from a position to its force; default 1");
  add_filter_options(command, options.feel);
  command.add_flag("--no-governor{false}", options.has_governor,
                   "let the stiffness exceed what rate and delay allow");
  command.add_flag("--passivity", options.has_passivity, "take back energy that the servo gives");
  command.add_flag("--frictionless", options.is_frictionless,
                   "the Falcon without dry friction, the worst case");
  command.add_flag("--as-printed", options.is_as_printed,
                   "eq. 3.3, 3.5 and 4.2 as the Falcon report prints them");
  command.add_flag(
      "--vibro", options.has_vibro,
      "add a fine texture as a vibration; of clay what is too fine for the tool's windows");
}

void add_lab_clay_options(CLI::App& command, LabOptions& options) {
  command.add_option("--project", options.project, "the clay; default a slab of 60 x 30 x 60 mm")
      ->type_name("P.vdb");
  add_piece_option(command, options.piece);
  command.add_option_function<std::string>(
      "--tool", [&options](const std::string& text) { read_tool(text, options.tool); },
      "ball:R or ellipsoid:A,B,C in mm; default ball:4");
  add_choice(command, "--action", options.action, kWorkActionNames,
             "what the tool does with --active; default carve");
  command.add_flag("--active", options.is_active, "the hand works the clay while it slides");
  add_choice(command, "--law", options.law, {"energy", "blanch"}, "the force law; default energy");
  add_choice(command, "--method", options.method, {"volume", "point", "auto"},
             "the whole tool, or its centre; default auto: the whole, or the centre where that is "
             "within 1 %");
  add_number(command, "--exponent", options.material.exponent, {1.0, 8.0},
             "e of the contact law; default 2");
  add_number(command, "--skin-mm", options.material.skin_mm, kPositive,
             "its skin in mm; default 8");
  add_mix_options(command, options.feel);
  add_file(command, "--save", options.save, {".vdb"}, "write the clay as it is after the run");
}

void add_trial_options(CLI::App& command, lab::TrialOptions& trial) {
  constexpr int kMostSeed = 1'000'000'000;
  constexpr int kMostRepeats = 100;
  add_integer(command, "--seed", trial.seed, 0, kMostSeed,
              "of trial: of order, targets and how hands stray; default 1");
  add_integer(command, "--repeats", trial.repeats, 1, kMostRepeats,
              "of trial: of each task, condition and hand; default 10, of a person 3");
  add_choice(command, "--task", trial.task, {"all", "dock", "groove", "bump", "path"},
             "of trial: only this one; default all");
}

}  // namespace

void add_lab(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<LabOptions>();
  auto trial = std::make_shared<lab::TrialOptions>();
  CLI::App* command = add_command(
      app, selected, "lab", "feel a scene with a simulated hand and Falcon, and judge the hold",
      [options, trial, &selected](const Progress& progress) {
        options->is_quiet = selected.quiet;
        if (options->is_list) return Result<Outcome>(list_scenes());
        if (options->scene == kTrialWord) return run_trial_command(*options, *trial, progress);
        return run_lab_command(*options, progress);
      },
      OnInterrupt::ends_itself);
  command->add_option("SCENE", options->scene, scene_help())->check(check_scene);
  command->add_flag("--list", options->is_list,
                    "list the scenes and what can be set of each, and do nothing else");
  add_scene_settings(*command, options->settings);
  command->parse_complete_callback([options, trial, command] {
    if (options->is_list) return;
    if (options->scene.empty()) throw CLI::RequiredError("SCENE");
    trial->has_hand = command->count("--hand") > 0;
    if (options->scene == kTrialWord) return check_trial_options(*command);
    for (const char* name : {"--seed", "--repeats", "--task"}) {
      if (command->count(name) == 0) continue;
      throw CLI::ValidationError(std::string(name) + " is of '" + kTrialWord +
                                 "'; leave it out, or run 'argil lab trial'");
    }
    check_settings(*options);
    check_lab_feel(*options, *command);
    check_guide(options->guide);
  });
  command
      ->add_option("--device", options->device,
                   "sim, falcon (a real one, in real time), or replay:RUN.csv; default sim")
      ->check(check_lab_device);
  add_servo_options(*command, *options);
  add_lab_clay_options(*command, *options);
  add_falcon_options(*command, options->falcon);
  add_number(*command, "--seconds", options->seconds, {1.0, lab::kMostSeconds},
             "how long; default the hand's plan, 3 s to settle and 1 s of hold");
  command->add_flag("--real-time", options->is_real_time,
                    "on the machine's clock, a tick each period; default as fast as it goes");
  add_guidance_options(*command, options->guide);
  add_trial_options(*command, *trial);
  add_file(*command, "-o,--output", options->output, {".csv"}, "record every tick");
  add_file(*command, "--plot", options->plot, {".svg"}, "draw the run");
}

}  // namespace argil::cli
