// SPDX-License-Identifier: GPL-3.0-or-later
// argil bridge: a 3D simulator at its own pace, felt at the servo's.
#include <memory>
#include <optional>
#include <utility>

#include "argil/haptics/bridge/bridge_udp.h"
#include "argil/haptics/scene/scene_catalogue.h"

#include "bridge/bridge.h"
#include "bridge/scene.h"
#include "commands.h"
#include "common/hand_option.h"
#include "common/options.h"
#include "common/output.h"
#include "common/scratch_folder.h"
#include "common/tool_option.h"

namespace argil::cli {
namespace {

using bridge::BridgeClayOptions;
using bridge::BridgeOptions;
using bridge::BridgeReport;

Json bridge_json(const BridgeOptions& options, const BridgeReport& report) {
  Json json;
  json["law"] = haptics::bridge_law_name(static_cast<haptics::BridgeLaw>(options.law));
  if (const Json scene = bridge::scene_json(options); !scene.is_null()) json["scene"] = scene;
  json["lockstep"] = options.is_lockstep;
  json["simulator_rate_hz"] = report.simulator_rate_hz;
  json["ticks"] = report.servo.ticks;
  json["sessions"] = report.counts.sessions;
  json["states"] = report.counts.states;
  json["proxies"] = report.counts.proxies;
  json["dropped"] = {{"malformed", report.counts.malformed}, {"forged", report.sealed.forged},
                     {"replayed", report.sealed.replayed},   {"old", report.counts.old},
                     {"strangers", report.counts.strangers}, {"refused", report.counts.refused}};
  json["force_mean_n"] = to_json(report.last.force_mean_n);
  json["force_deviation_n"] = report.last.force_deviation_n;
  json["force_rms_n"] = report.last.force_rms_n;
  json["most_force_n"] = report.last.most_force_n;
  json["contact_breaks"] = report.last.contact_breaks;
  json["depth_mm"] = report.last.depth_mm;
  json["latency_us"] = {{"p50", report.latency.quantile_us(0.5)},
                        {"p99", report.latency.quantile_us(0.99)},
                        {"max", report.latency.max_us()}};
  json["faults"] = faults_json(report.servo.faults);
  if (!report.clay.is_null()) {
    json["clay"] = report.clay;
    if (report.servo.window_age.count() > 0) {
      json["clay"]["age_ms"] = age_json(report.servo.window_age);
    }
  }
  // Figures of the machine, which no two runs have in common.
  if (!options.is_lockstep) {
    json["late_ticks"] = report.servo.late_ticks;
    json["skipped_ticks"] = report.servo.skipped_ticks;
    json["priority"] = report.priority.empty() ? "real-time" : report.priority;
    json["dropped_rows"] = report.dropped;
  }
  return json;
}

/// The law, and of a scene its name and numbers.
std::string law_text(const Json& json) {
  std::string text = json["law"].get<std::string>();
  if (!json.contains("scene")) return text;
  text += " " + json["scene"]["name"].get<std::string>();
  for (const auto& [name, value] : json["scene"]["settings"].items()) {
    text.append(" ").append(name).append("=").append(number(value));
  }
  return text;
}

std::string bridge_text(const Json& json) {
  // Of a force of our own the simulator has no plane behind which depth is counted.
  const bool is_own = json["law"] == "clay" || json["law"] == "scene";
  std::string text = law_text(json) + " at " + number(json["simulator_rate_hz"]) +
                     " Hz: " + json["ticks"].dump() + " ticks, " + json["proxies"].dump() +
                     " proxies; last 2 s: force " + number(json["force_mean_n"][1]) +
                     " N along y, off its mean by up to " + number(json["force_deviation_n"]) +
                     " N, " + json["contact_breaks"].dump() + " contact breaks" +
                     (is_own ? "" : ", depth " + number(json["depth_mm"]) + " mm") + "\n";
  if (json.contains("clay")) {
    const Json& clay = json["clay"];
    text += "  the clay: " + clay["strokes"].dump() + " strokes, " + clay["dabs"].dump() +
            " dabs, " + clay["blocks_sent"].dump() + " blocks sent, " + clay["bytes_sent"].dump() +
            " bytes\n";
    if (clay.contains("age_ms")) {
      text += "  felt " + number(clay["age_ms"]["p50"]) + " ms after it was so, p99 " +
              number(clay["age_ms"]["p99"]) + "\n";
    }
  }
  for (const Json& fault : json["faults"]) text += "  " + fault.get<std::string>() + "\n";
  if (json["lockstep"] == false) {
    text += "  state to proxy p50 " + number(json["latency_us"]["p50"]) + " us, p99 " +
            number(json["latency_us"]["p99"]) + "; " + json["late_ticks"].dump() +
            " late ticks; priority: " + json["priority"].get<std::string>() + "\n";
  }
  return text;
}

Result<Outcome> run_bridge_command(const BridgeOptions& asked, bool quiet,
                                   const Progress& progress) {
  BridgeOptions options = asked;
  // --coupling names the laws of a simulator's force; what is ours has its own.
  if (!options.clay.project.empty()) {
    options.law = static_cast<std::size_t>(haptics::BridgeLaw::clay);
  } else if (!options.scene.empty()) {
    options.law = static_cast<std::size_t>(haptics::BridgeLaw::scene);
  }
  for (const auto& file : {options.log, options.plot}) {
    if (file.empty()) continue;
    if (auto output = check_output(file); !output) return output.error();
  }
  std::optional<ScratchFolder> scratch;  // for the log of a run that is only to be drawn
  // gnuplot draws from the log.
  if (options.log.empty() && !options.plot.empty()) {
    auto made = ScratchFolder::make();
    if (!made) return made.error();
    options.log = scratch.emplace(std::move(made).value()) / "run.csv";
  }
  const auto report = bridge::run_bridge(options, quiet, progress);
  if (!report) return report.error();
  Outcome outcome;
  outcome.json = bridge_json(options, report.value());
  outcome.text = bridge_text(outcome.json);
  if (options.plot.empty()) return outcome;
  const std::string title =
      law_text(outcome.json) + ", simulator at " + number(report.value().simulator_rate_hz) + " Hz";
  const auto drawn = bridge::draw_log(options.plot, options.log, title);
  if (!drawn) return drawn.error();
  return outcome;
}

std::string check_host(const std::string& host) {
  if (haptics::host_of(host)) return "";
  return "--listen is '" + host + "'; must be an address such as 127.0.0.1";
}

std::string check_bridge_device(const std::string& device) {
  if (device == "sim" || device == "falcon") return "";
  return "--device is '" + device + "'; must be sim or falcon";
}

void add_hand_options(CLI::App& command, BridgeOptions& options) {
  command.add_option("--device", options.device, "sim, or falcon (a real one); default sim")
      ->check(check_bridge_device);
  add_falcon_options(command, options.falcon);
  add_hand(command, options.hand, "who holds the simulated device; default arm");
  command
      .add_option("--motion", options.motion,
                  "what that hand does: press, slide, carve, free, or a file of "
                  "time_s,x_mm,y_mm,z_mm,press_n[,button]; default press, with --scene what the "
                  "lab's hand does there")
      ->type_name("press|slide|carve|free|FILE.csv");
  add_number(command, "--press", options.press_n, {0.0, 8.0},
             "how hard it presses in N; default 3");
}

/// What is of a simulator's force only.
void exclude_simulators_force(CLI::App& command, CLI::Option& own) {
  for (const char* other : {"--coupling", "--damping", "--force"}) {
    own.excludes(command.get_option(other));
  }
}

/// Clay has its own force: none of those that a simulator gives.
void add_bridge_clay_options(CLI::App& command, BridgeClayOptions& options, FeelChoice& feel) {
  CLI::Option* clay =
      add_file(command, "--clay", options.project, {".vdb"},
               "a project that is felt and, while the button is held, worked; the simulator shows "
               "it. --stiffness is then that of the coupling, 50 to 3000");
  exclude_simulators_force(command, *clay);
  command
      .add_option_function<std::string>(
          "--tool", [&options](const std::string& text) { read_tool(text, options.tool); },
          "ball:R or ellipsoid:A,B,C in mm; default ball:4")
      ->needs(clay);
  add_choice(command, "--action", options.action, kWorkActionNames,
             "what the tool does; default carve")
      ->needs(clay);
  add_number(command, "--exponent", options.material.exponent, {1.0, 8.0},
             "e of the contact law; default 2")
      ->needs(clay);
  add_number(command, "--skin-mm", options.material.skin_mm, kPositive, "its skin in mm; default 8")
      ->needs(clay);
  add_mix_options(command, feel, clay);
}

std::string check_bridge_scene(const std::string& name) {
  if (haptics::find_scene(name) != nullptr) return "";
  if (name == "clay") return "--scene is 'clay'; must be --clay P.vdb instead";
  std::string known;
  for (const haptics::SceneEntry& scene : haptics::scene_catalogue()) {
    known.append(known.empty() ? "" : ", ").append(scene.name);
  }
  return "--scene is '" + name + "'; must be one of " + known;
}

/// So has a scene of the Falcon report.
void add_bridge_scene_options(CLI::App& command, BridgeOptions& options) {
  CLI::Option* scene =
      command
          .add_option("--scene", options.scene,
                      "a scene of 'argil lab --list' that is felt itself; the simulator shows the "
                      "handle. --stiffness is then that of the coupling, 50 to 3000")
          ->type_name("NAME")
          ->check(check_bridge_scene);
  exclude_simulators_force(command, *scene);
  scene->excludes(command.get_option("--clay"));
  add_scene_settings(command, options.settings)->needs(scene);
}

/// What the options must be together, once all are read.
void check_bridge_options(const CLI::App& command, const BridgeOptions& options) {
  check_feel(options.feel);
  if (options.scene.empty()) return;
  check_scene_settings(haptics::find_scene(options.scene)->parameters, options.settings);
  if (command.count("--press") == 0 || !options.motion.empty()) return;
  throw CLI::ValidationError(
      "--press is of the motions press, slide and carve; name one of them with --motion, or leave "
      "it out, since with --scene the hand presses as the lab's does");
}

}  // namespace

void add_bridge(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<BridgeOptions>();
  options->port = haptics::BridgeUdp::kUsualPort;
  CLI::App* command = add_command(
      app, selected, "bridge", "couple a 3D simulator with the device (docs/bridge.md)",
      [options, &selected](const Progress& progress) {
        return run_bridge_command(*options, selected.quiet, progress);
      },
      OnInterrupt::ends_itself);
  add_choice(*command, "--coupling", options->law, {"direct", "indirect", "plane"},
             "the simulator's force (4.1), a spring to its proxy (4.2), or the plane it touches; "
             "default plane");
  add_number(*command, "--stiffness", options->spring.stiffness_n_per_m, {0.0, 1e6, true},
             "k in N/m; default 1500");
  add_number(*command, "--damping", options->spring.damping_n_s_per_m, {0.0, 20.0},
             "c in N s/m; default 0");
  command->add_flag("--force", options->is_forced, "also where k T < 2 b is broken");
  add_number(*command, "--scale", options->scale, {0.001, 1000.0},
             "mm of the scene for a mm of the hand; default 1");
  add_integer(*command, "--port", options->port, 0, 65535, "0 for any that is free; default 47333");
  command
      ->add_option("--key", options->key,
                   "where the key is put by which the simulator is known; default "
                   "$XDG_RUNTIME_DIR/argil/bridge-PORT.key")
      ->type_name("FILE");
  command
      ->add_option("--listen", options->listen,
                   "an address of this machine, 0.0.0.0 for all; default 127.0.0.1, which no "
                   "other machine reaches")
      ->type_name("A.B.C.D")
      ->check(check_host);
  command->add_flag("--lockstep", options->is_lockstep,
                    "on virtual time: waits for each answer, the same bits every time");
  add_number(*command, "--seconds", options->seconds, {0.1, 86400.0},
             "how long; default until Ctrl-C, in lockstep until 4 s after the motion");
  add_number(*command, "--wait", options->wait_s, kPositive,
             "for a simulator, in s; default for ever");
  add_hand_options(*command, *options);
  add_guidance_options(*command, options->guidance);
  add_filter_options(*command, options->feel);
  add_bridge_clay_options(*command, options->clay, options->feel);
  add_bridge_scene_options(*command, *options);
  command->parse_complete_callback(
      [options, command] { check_bridge_options(*command, *options); });
  add_file(*command, "--log", options->log, {".csv"}, "both sides of every tick");
  add_file(*command, "--plot", options->plot, {".svg"}, "draw the run");
}

}  // namespace argil::cli
