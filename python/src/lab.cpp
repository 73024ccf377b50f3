// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of the lab with a simulated hand, and recordings of the servo, as arrays.
#include "lab.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "argil/haptics/analysis/hold_judgement.h"
#include "argil/haptics/servo/recording.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "arrays.h"
#include "choice.h"
#include "lab/lab.h"
#include "lab/run.h"
#include "work.h"

namespace argil::python {
namespace {

py::dict arrays_of(const std::vector<haptics::ServoTick>& ticks) {
  const auto [time, time_s] = new_numbers<double>(ticks.size());
  const auto [position, position_mm] = new_points(ticks.size());
  const auto [velocity, velocity_mm_per_s] = new_points(ticks.size());
  const auto [proxy, proxy_mm] = new_points(ticks.size());
  const auto [force, force_n] = new_points(ticks.size());
  const auto [stiffness, stiffness_n_per_m] = new_numbers<double>(ticks.size());
  const auto [faults, fault_bits] = new_numbers<std::uint32_t>(ticks.size());
  for (std::size_t n = 0; n < ticks.size(); ++n) {
    const haptics::ServoTick& tick = ticks[n];
    time_s[n] = tick.time_s;
    position_mm[n] = tick.position_mm;
    velocity_mm_per_s[n] = tick.velocity_mm_per_s;
    proxy_mm[n] = tick.proxy_mm;
    force_n[n] = tick.force_n;
    stiffness_n_per_m[n] = tick.most_stiffness_n_per_m;
    fault_bits[n] = tick.faults;
  }
  py::dict dict;
  dict["time_s"] = time;
  dict["position_mm"] = position;
  dict["velocity_mm_per_s"] = velocity;
  dict["proxy_mm"] = proxy;
  dict["force_n"] = force;
  dict["most_stiffness_n_per_m"] = stiffness;
  dict["faults"] = faults;
  return dict;
}

const cli::lab::LabSceneKind& scene_kind(const std::string& name) {
  Words<const cli::lab::LabSceneKind*> known;
  for (const cli::lab::LabSceneKind& kind : cli::lab::scene_kinds()) {
    known.emplace_back(kind.name, &kind);
  }
  return *choice_of<const cli::lab::LabSceneKind*>("scene", name, known);
}

/// The verdict of the last second and every tick, on virtual time.
py::tuple run_scene(const std::string& name, const std::map<std::string, double>& settings,
                    const std::string& hand, const std::string& coupling, double seconds,
                    double rate_hz, int delay_ticks, double stiffness_n_per_m, bool has_governor) {
  const cli::lab::LabSceneKind& kind = scene_kind(name);
  value_of(haptics::SceneValues(kind.parameters).set_all(settings));
  cli::lab::LabOptions options;
  options.scene = name;
  options.settings = settings;
  options.hand =
      choice_of<std::size_t>("hand", hand, {{"push", 0}, {"light", 1}, {"arm", 2}, {"firm", 3}});
  options.coupling = choice_of<std::size_t>("coupling", coupling, {{"direct", 0}, {"indirect", 1}});
  options.seconds = in_range("seconds", seconds, 0.0, cli::lab::kMostSeconds);
  options.rate_hz = in_range("rate_hz", rate_hz, cli::lab::kLeastRateHz, cli::lab::kMostRateHz);
  options.delay_ticks = static_cast<int>(
      in_range("delay_ticks", delay_ticks, 0, haptics::SimFalcon::kMostDelayTicks));
  options.coupling_stiffness_n_per_m =
      in_range("stiffness_n_per_m", stiffness_n_per_m, 1e-3, kMaxReachMm);
  options.has_governor = has_governor;
  options.is_quiet = true;
  const cli::lab::LabRun found = run([&](const Progress& progress) -> Result<cli::lab::LabRun> {
    auto scene = kind.make(options, progress);
    if (!scene) return scene.error();
    return cli::lab::run_lab(options, scene.value(), nullptr, progress);
  });
  py::dict report;
  report["verdict"] = haptics::verdict_name(found.judgement.verdict);
  report["position_pp_mm"] = found.judgement.position_pp_mm;
  report["force_pp_n"] = found.judgement.force_pp_n;
  report["work_mw"] = found.judgement.work_mw;
  report["frequency_hz"] = found.judgement.frequency_hz;
  report["contact_lost"] = found.has_lost_contact;
  report["most_given_mj"] = found.most_given_mj;
  report["ticks"] = found.servo.ticks;
  return py::make_tuple(report, arrays_of(found.ticks));
}

/// Name to what it is and its parameters, each with unit, usual value, range and a few words.
py::dict scenes() {
  py::dict all;
  for (const cli::lab::LabSceneKind& kind : cli::lab::scene_kinds()) {
    py::dict parameters;
    for (const haptics::SceneParameter& one : kind.parameters) {
      py::dict parameter;
      parameter["unit"] = one.unit;
      parameter["usual"] = one.usual;
      parameter["low"] = one.low;
      parameter["high"] = one.high;
      parameter["about"] = one.about;
      parameters[one.name] = parameter;
    }
    py::dict scene;
    scene["about"] = kind.about;
    scene["parameters"] = parameters;
    all[kind.name] = scene;
  }
  return all;
}

py::tuple read_recording(const std::filesystem::path& file) {
  const haptics::Recording recording =
      run([&](const Progress&) { return haptics::read_recording(file); });
  return py::make_tuple(recording.note, arrays_of(recording.ticks));
}

}  // namespace

void add_lab(py::module_& module) {
  module.def("run_scene", &run_scene, py::arg("scene"), py::arg("settings"), py::arg("hand"),
             py::arg("coupling"), py::arg("seconds"), py::arg("rate_hz"), py::arg("delay_ticks"),
             py::arg("stiffness_n_per_m"), py::arg("has_governor"));
  module.def("scenes", &scenes);
  module.def("read_recording", &read_recording, py::arg("file"));
}

}  // namespace argil::python
