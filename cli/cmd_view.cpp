// SPDX-License-Identifier: GPL-3.0-or-later
// argil view: the window.
#include <memory>
#include <utility>

#include "argil/io/safe_file.h"
#include "argil/viewer/view.h"

#include "commands.h"
#include "common/falcon_options.h"
#include "common/feel_options.h"
#include "common/guidance_option.h"
#include "common/options.h"
#include "common/output.h"

namespace argil::cli {
namespace {

/// What the command line says.
struct ViewChoice {
  viewer::ViewOptions window;
  FalconChoice falcon;
  FeelChoice feel;
  GuidanceChoice guide;
};

nlohmann::json json_of(const std::vector<viewer::ViewMeasurement>& measurements) {
  nlohmann::json list = nlohmann::json::array();
  for (const viewer::ViewMeasurement& each : measurements) {
    nlohmann::json points = nlohmann::json::array();
    for (const Vec3& p : each.points_mm) points.push_back({p.x, p.y, p.z});
    list.push_back({{"kind", each.kind},
                    {"value", each.value},
                    {"points_mm", points},
                    {"is_current", each.is_current}});
  }
  return list;
}

Result<Outcome> run_view(const ViewChoice& choice) {
  viewer::ViewOptions options = choice.window;
  auto falcon = falcon_options(choice.falcon);
  if (!falcon) return falcon.error();
  options.falcon = std::move(falcon).value();
  options.damping = choice.feel.damping_kind();
  options.position_filter = choice.feel.filter();
  options.mix = choice.feel.mix;
  options.mix_ramp_s = choice.feel.mix_ramp_s;
  auto guidance = guidance_of(choice.guide);
  if (!guidance) return guidance.error();
  options.guidance = std::move(guidance).value();
  if (!options.file.empty()) {
    if (auto input = check_input(options.file.string()); !input) return input.error();
  }
  const auto seen = viewer::view(options);
  if (!seen) return seen.error();
  const viewer::ViewReport& report = seen.value();
  Outcome outcome;
  outcome.json["frames"] = report.frames;
  outcome.json["frame_ms"] = {{"p50", report.frame_ms_p50}, {"p99", report.frame_ms_p99}};
  outcome.json["latency_ms"] = {{"p50", report.latency_ms_p50}, {"p99", report.latency_ms_p99}};
  outcome.json["most_force_n"] = report.most_force_n;
  outcome.json["lateness_us"] = {{"p50", report.servo_lateness_us_p50},
                                 {"p99", report.servo_lateness_us_p99}};
  outcome.json["clay_age_ms"] = {{"p50", report.clay_age_ms_p50},
                                 {"p99", report.clay_age_ms_p99},
                                 {"max", report.clay_age_ms_max}};
  outcome.json["dabs"] = report.dabs;
  outcome.json["uploaded_bytes"] = report.uploaded_bytes;
  outcome.json["gl_objects"] = report.gl_objects;
  outcome.json["gl_errors"] = report.gl_errors;
  outcome.json["measurements"] = json_of(report.measurements);
  outcome.json["complaints"] = report.complaints;
  outcome.json["panels"] = report.panels;
  outcome.json["cut_off"] = report.cut_off;
  // The window ends in its own way and still reports; the status says why it ended.
  if (io::interrupted()) outcome.status = status_of(ErrorKind::interrupted);
  outcome.text = grouped(report.frames) + " frames, " + number(report.frame_ms_p50) +
                 " ms each (p99 " + number(report.frame_ms_p99) + ")\n";
  if (options.shows_latency) {
    outcome.text += "from an input to the frame that shows its dab " +
                    number(report.latency_ms_p50) + " ms (p99 " + number(report.latency_ms_p99) +
                    ")\n";
  }
  return outcome;
}

}  // namespace

void add_view(CLI::App& app, Selected& selected) {
  auto choice = std::make_shared<ViewChoice>();
  viewer::ViewOptions* options = &choice->window;
  CLI::App* command = add_command(
      app, selected, "view", "sculpt in a window, with the mouse or a device (docs/viewer.md)",
      [choice](const Progress&) { return run_view(*choice); }, OnInterrupt::ends_itself);
  command->add_option("FILE", options->file, "a project to open, or a mesh to import");
  command->add_option("--device", options->device, "mouse, sim, falcon or replay:RUN.csv")
      ->type_name("DEVICE");
  add_falcon_options(*command, choice->falcon);
  add_damping_option(*command, choice->feel);
  add_filter_options(*command, choice->feel);
  add_mix_options(*command, choice->feel);
  command->parse_complete_callback([choice] {
    check_feel(choice->feel);
    check_guide(choice->guide, true);
  });
  add_guidance_options(*command, choice->guide);
  add_integer(*command, "--width", options->width, 320, 8192, "of the window, in pixels");
  add_integer(*command, "--height", options->height, 240, 8192, "of the window, in pixels");
  add_integer(*command, "--frames", options->frames, 1, 1'000'000, "end after this many frames");
  add_file(*command, "--screenshot", options->screenshot, {".png"},
           "store the last frame as a picture");
  command->add_option("--input", options->input, "play this script instead of a user's input")
      ->type_name("SCRIPT");
  command
      ->add_option("--home", options->home,
                   "where unsaved projects, settings, printers and pictures are kept")
      ->type_name("FOLDER");
  command->add_flag("--latency", options->shows_latency,
                    "show how long after an input its dab is on the screen");
  command->add_flag("--check-gl", options->checks_gl, "fail when OpenGL reports an error");
}

}  // namespace argil::cli
