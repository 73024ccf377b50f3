// SPDX-License-Identifier: GPL-3.0-or-later
// argil force: what a tool at one point would feel.
#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

#include "argil/engine/tool.h"
#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/force/tool_force.h"

#include "commands.h"
#include "common/felt_window.h"
#include "common/machine.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "common/tool_option.h"
#include "common/window_times.h"

namespace argil::cli {
namespace {

using haptics::ForceResult;
using haptics::ForceTool;
using haptics::LatticeForce;

enum class MethodChoice { automatic, lod, fine, point };

struct ForceOptions {
  std::string project;
  std::string piece;
  ForceTool tool;
  haptics::ForceMaterial material;
  std::size_t law = 0;     // energy, blanch
  std::size_t method = 0;  // MethodChoice
  bool explain = false;
  int repeat = 0;  // 0: once, and no window is timed
};

/// What a query is evaluated with, and why.
struct Plan {
  FeltMethod method = FeltMethod::lod;
  haptics::Lattice lattice;
  FieldWindow window;
  std::string why;
};

constexpr FeltWords kWords{"--tool", "--method fine"};
constexpr double kMargin = 0.0;  // one query: the tool does not move on

std::string because_point(const ForceOptions& options, double phi_mm) {
  return "the tool is so small against the skin of " + number(options.material.skin_mm) +
         " mm that the force at its centre (" + number(phi_mm) +
         " mm from the surface) is within 1 % of the integral";
}

std::string because_lattice(const haptics::Lattice& lattice, const FieldWindowView& view) {
  return number(lattice.across) +
         " samples across the smallest diameter, the fewest that keep the "
         "error within 1 % (3 % at edges); spacing " +
         number(lattice.voxel_mm) + " mm, read from level " + std::to_string(view.level);
}

Result<Plan> plan_for(const ForceOptions& options, const Clay& clay, FeltMethod method) {
  auto window = felt_window(clay, options.tool, options.material, method, kMargin, kWords);
  if (!window) return window.error();
  Plan plan;
  plan.method = method;
  plan.lattice = felt_lattice(clay, options.tool, method);
  plan.window = std::move(window).value();
  plan.why =
      method == FeltMethod::lod ? because_lattice(plan.lattice, plan.window.view) : "asked for";
  return plan;
}

/// What the scene needs: the point force where it does, else the lattice.
Result<Plan> make_plan(const ForceOptions& options, const Clay& clay) {
  const auto method = static_cast<MethodChoice>(options.method);
  if (method == MethodChoice::fine) return plan_for(options, clay, FeltMethod::fine);
  if (method == MethodChoice::point) return plan_for(options, clay, FeltMethod::point);
  // A tool larger than the skin is never judged by its centre alone.
  if (method == MethodChoice::automatic &&
      largest_radius_mm(options.tool) <= options.material.skin_mm) {
    auto point = plan_for(options, clay, FeltMethod::point);
    if (!point) return point.error();
    const FieldWindowView& view = point.value().window.view;
    if (haptics::point_is_enough(view, options.tool, options.material)) {
      point.value().why =
          because_point(options, haptics::distance_at(view, options.tool.position_mm));
      return point;
    }
  }
  return plan_for(options, clay, FeltMethod::lod);
}

haptics::ForceLaw law_of(const ForceOptions& options) {
  return options.law == 0 ? haptics::ForceLaw::energy : haptics::ForceLaw::blanch;
}

/// The query, repeated; `cpu_us` gets the time of each.
ForceResult evaluate(const ForceOptions& options, const Plan& plan, std::vector<double>& cpu_us) {
  assert(options.repeat >= 0 && plan.lattice.voxel_mm > 0.0);
  const LatticeForce lattice(options.tool, options.material, law_of(options),
                             plan.lattice.voxel_mm);
  ForceResult result;
  for (int i = 0; i < std::max(1, options.repeat); ++i) {
    // The query alone: reading the window is not part of a servo's tick.
    const double before = thread_cpu_us();
    switch (plan.method) {
      case FeltMethod::point:
        result = haptics::point_force(plan.window.view, options.tool, options.material);
        break;
      case FeltMethod::fine:
        result = haptics::volume_force(plan.window.view, options.tool, options.material,
                                       law_of(options));
        break;
      case FeltMethod::lod:
        result = lattice.evaluate(plan.window.view, options.tool);
        break;
    }
    cpu_us.push_back(thread_cpu_us() - before);
  }
  return result;
}

const char* method_name(FeltMethod method) {
  switch (method) {
    case FeltMethod::point:
      return "point";
    case FeltMethod::fine:
      return "fine";
    case FeltMethod::lod:
      break;
  }
  return "lod";
}

Json result_json(const ForceResult& result, const Plan& plan, const std::vector<double>& cpu_us) {
  Json json;
  json["force_n"] = to_json(result.contact_n + result.viscosity_n);
  json["torque_nmm"] = to_json(result.contact_nmm + result.viscosity_nmm);
  json["level"] = plan.window.view.level;
  json["voxel_mm"] = plan.window.view.voxel_mm;
  json["samples"] = result.samples;
  json["cpu_us"] = percentiles(cpu_us);
  json["contact_n"] = to_json(result.contact_n);
  json["viscosity_n"] = to_json(result.viscosity_n);
  json["contact_nmm"] = to_json(result.contact_nmm);
  json["viscosity_nmm"] = to_json(result.viscosity_nmm);
  json["energy_nmm"] = result.energy_nmm;
  json["error_n"] = plan.method == FeltMethod::lod ? Json(result.error_n) : Json(nullptr);
  json["outside_window"] = result.outside_window;
  json["method"] = method_name(plan.method);
  json["why"] = plan.why;
  return json;
}

std::string force_text(const ForceOptions& options, const ForceResult& result, const Plan& plan) {
  const auto triple = [](const Vec3& v) {
    return "(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")";
  };
  std::string text = "force " + triple(result.contact_n + result.viscosity_n) + " N\ntorque " +
                     triple(result.contact_nmm + result.viscosity_nmm) + " N mm\nlevel " +
                     std::to_string(plan.window.view.level) + ", voxel " +
                     number(plan.window.view.voxel_mm) + " mm, " + std::to_string(result.samples) +
                     " samples\n";
  if (plan.method == FeltMethod::lod) text += "error at most " + number(result.error_n) + " N\n";
  if (options.explain) {
    text += std::string("method ") + method_name(plan.method) + ": " + plan.why + "\n";
  }
  return text;
}

/// What the windows take that the servo would read for this tool. A window takes milliseconds and a
/// query microseconds, so that there are fewer of them.
Result<WindowTimes> repeat_windows(const ForceOptions& options, Clay& clay) {
  constexpr int kMostWindows = 50;
  const WindowRequest request =
      servo_window(options.tool, options.material, haptics::choose_lattice(options.tool).voxel_mm,
                   haptics::resting_margin_mm(options.tool));
  return time_windows(clay, options.tool, request, std::min(options.repeat, kMostWindows));
}

void add_windows(const WindowTimes& times, Outcome& outcome) {
  Json json;
  json["fresh"] = percentiles(times.fresh);
  json["moved"] = percentiles(times.moved);
  json["after_dab"] = times.after_dab.empty() ? Json(nullptr) : percentiles(times.after_dab);
  outcome.text += "window " + number(json["fresh"]["p50"]) + " ms, after a move " +
                  number(json["moved"]["p50"]) + " ms";
  if (!json["after_dab"].is_null()) {
    outcome.text += ", after a dab " + number(json["after_dab"]["p50"]) + " ms";
  }
  outcome.text += "\n";
  outcome.json["window_ms"] = std::move(json);
}

Result<Outcome> run_force(const ForceOptions& options, const Progress& progress) {
  auto opened = open_clay(options.project, options.piece, progress);
  if (!opened) return opened.error();
  const auto plan = make_plan(options, opened.value().clay);
  if (!plan) return plan.error();
  std::vector<double> cpu_us;
  const ForceResult result = evaluate(options, plan.value(), cpu_us);
  Outcome outcome;
  outcome.json = result_json(result, plan.value(), cpu_us);
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  outcome.text = force_text(options, result, plan.value());
  if (options.repeat == 0) return outcome;
  const auto windows = repeat_windows(options, opened.value().clay);
  if (!windows) return windows.error();
  add_windows(windows.value(), outcome);
  return outcome;
}

}  // namespace

void add_force(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ForceOptions>();
  CLI::App* command =
      add_command(app, selected, "force", "say what a tool at one point feels",
                  [options](const Progress& progress) { return run_force(*options, progress); });
  command->add_option("PROJECT", options->project, "a project (NAME.vdb)")->required();
  add_piece_option(*command, options->piece);
  command
      ->add_option_function<std::string>(
          "--tool", [options](const std::string& text) { read_tool(text, options->tool); },
          "ball:R, ellipsoid:A,B,C, box:A,B,C (half sides) or capsule:R,L, in mm")
      ->type_name("TOOL")
      ->required();
  add_triple(*command, "--at", options->tool.position_mm, "the tool's centre in mm")->required();
  add_triple(*command, "--vel", options->tool.velocity_mm_per_s, "its velocity in mm/s");
  add_triple(*command, "--omega", options->tool.angular_velocity_rad_per_s,
             "its angular velocity in rad/s");
  add_choice(*command, "--law", options->law, {"energy", "blanch"}, "default energy");
  add_choice(*command, "--method", options->method, {"auto", "lod", "fine", "point"},
             "default auto: lod, or point where that is within 1 %");
  command->add_flag("--explain", options->explain, "say which method was chosen and why");
  add_number(*command, "--exponent", options->material.exponent, {1.0, 8.0}, "default 2");
  add_number(*command, "--skin-mm", options->material.skin_mm, kPositive, "default 8");
  add_integer(*command, "--repeat", options->repeat, 1, 10'000'000,
              "evaluate so often; cpu_us and window_ms tell the spread");
}

}  // namespace argil::cli
