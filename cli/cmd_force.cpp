// SPDX-License-Identifier: GPL-3.0-or-later
// argil force: what a tool at one place would feel.
#include <algorithm>
#include <memory>
#include <utility>

#include <time.h>

#include "argil/engine/tool.h"
#include "argil/engine/window.h"
#include "argil/haptics/tool_force.h"
#include "argil/io/project_file.h"

#include "command.h"
#include "options.h"
#include "output.h"

namespace argil::cli {
namespace {

using haptics::ForceResult;

enum class Method { lod, fine, point };

struct ForceOptions {
  std::string project;
  haptics::ForceTool tool;
  haptics::ForceMaterial material;
  std::size_t law = 0;     // energy, blanch
  std::size_t method = 0;  // Method
  int repeat = 1;
};

/// One or two windows and the share of the second: what a query is evaluated on.
struct Windows {
  FieldWindow main;
  FieldWindow finer;
  double finer_share = 0.0;
  Method method = Method::lod;
};

double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }
double smallest(const Vec3& v) { return std::min({v.x, v.y, v.z}); }

void read_tool(const std::string& text, haptics::ForceTool& tool) {
  constexpr std::string_view kBall = "ball:";
  constexpr std::string_view kEllipsoid = "ellipsoid:";
  if (text.starts_with(kBall)) {
    const double r = parse_number("--tool ball:R", text.substr(kBall.size()), kPositive);
    tool.radii_mm = {r, r, r};
    return;
  }
  if (text.starts_with(kEllipsoid)) {
    tool.radii_mm = parse_triple("--tool ellipsoid:A,B,C", text.substr(kEllipsoid.size()));
    if (smallest(tool.radii_mm) > 0.0) return;
  }
  throw CLI::ValidationError(
      "--tool is '" + text +
      "'; must be ball:R or ellipsoid:A,B,C with radii in mm greater than 0");
}

/// A window of `level` that holds the kernel wherever its lattice falls, distances deep enough that
/// the tool does not saturate.
Result<FieldWindow> window_at(const ForceOptions& options, const Clay& clay, int level,
                              Extension extension) {
  const double radius = largest(options.tool.radii_mm);
  const double voxel =
      clay.options().voxel_mm *
      (level >= 0 ? static_cast<double>(1 << level) : 1.0 / static_cast<double>(1 << -level));
  const double reach = haptics::kKernelSupport * radius + 2.0 * voxel;
  const double depth = 2.0 * reach + options.material.skin_mm;
  return read_window(clay, level, options.tool.position_mm, reach, depth, extension);
}

/// A tool much larger than the clay would need a window that no longer pays: refused by name.
Result<void> check_reach(const ForceOptions& options, const Clay& clay, int level) {
  constexpr double kMostVoxels = 64.0;
  if (level < clay.level_count() - 1) return {};
  const double most = kMostVoxels * clay.level_stats().back().voxel_mm;
  const double radius = largest(options.tool.radii_mm);
  if (radius <= most) return {};
  return Error{ErrorKind::bad_input, "--tool has a radius of " + number(radius) +
                                         " mm; for a clay of this size at most " + number(most)};
}

Result<Windows> read_windows(const ForceOptions& options, const Clay& clay) {
  Windows windows;
  windows.method = static_cast<Method>(options.method);
  haptics::LevelChoice choice;
  if (windows.method == Method::lod) {
    choice = haptics::choose_level(smallest(options.tool.radii_mm), clay.options().voxel_mm,
                                   clay.level_count() - 1);
    if (choice.finer_share >= 1.0) choice.level = choice.finer_level;  // the coarser has no say
    if (auto fits = check_reach(options, clay, choice.level); !fits) return fits.error();
  }
  const Extension extension = windows.method == Method::fine ? Extension::exact : Extension::march;
  auto window = window_at(options, clay, choice.level, extension);
  if (!window) return window.error();
  windows.main = std::move(window).value();
  if (choice.finer_level == choice.level) return windows;
  auto finer = window_at(options, clay, choice.finer_level, extension);
  if (!finer) return finer.error();
  windows.finer = std::move(finer).value();
  windows.finer_share = choice.finer_share;
  return windows;
}

ForceResult blended(const ForceResult& a, const ForceResult& b, double share) {
  const auto mix = [share](const auto& x, const auto& y) { return x * (1.0 - share) + y * share; };
  ForceResult r;
  r.contact_n = mix(a.contact_n, b.contact_n);
  r.viscosity_n = mix(a.viscosity_n, b.viscosity_n);
  r.contact_nmm = mix(a.contact_nmm, b.contact_nmm);
  r.viscosity_nmm = mix(a.viscosity_nmm, b.viscosity_nmm);
  r.energy_nmm = mix(a.energy_nmm, b.energy_nmm);
  r.samples = a.samples + b.samples;
  r.outside_window = a.outside_window || b.outside_window;
  return r;
}

ForceResult evaluate(const ForceOptions& options, const Windows& windows) {
  const auto law = options.law == 0 ? haptics::ForceLaw::energy : haptics::ForceLaw::blanch;
  if (windows.method == Method::point) {
    return haptics::point_force(windows.main.view, options.tool, options.material);
  }
  const ForceResult main =
      haptics::volume_force(windows.main.view, options.tool, options.material, law);
  if (windows.finer.storage.empty()) return main;
  return blended(main,
                 haptics::volume_force(windows.finer.view, options.tool, options.material, law),
                 windows.finer_share);
}

double thread_cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

Json result_json(const ForceResult& result, const Windows& windows,
                 const std::vector<double>& cpu_us) {
  Json json;
  json["force_n"] = to_json(result.contact_n + result.viscosity_n);
  json["torque_nmm"] = to_json(result.contact_nmm + result.viscosity_nmm);
  json["level"] = windows.main.view.level;
  json["voxel_mm"] = windows.main.view.voxel_mm;
  json["samples"] = result.samples;
  json["cpu_us"] = percentiles(cpu_us);
  json["contact_n"] = to_json(result.contact_n);
  json["viscosity_n"] = to_json(result.viscosity_n);
  json["contact_nmm"] = to_json(result.contact_nmm);
  json["viscosity_nmm"] = to_json(result.viscosity_nmm);
  json["energy_nmm"] = result.energy_nmm;
  json["finer_share"] = windows.finer_share;
  json["outside_window"] = result.outside_window;
  return json;
}

std::string text_of(const ForceResult& result, const Windows& windows) {
  const auto triple = [](const Vec3& v) {
    return "(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")";
  };
  return "force " + triple(result.contact_n + result.viscosity_n) + " N\ntorque " +
         triple(result.contact_nmm + result.viscosity_nmm) + " N mm\nlevel " +
         std::to_string(windows.main.view.level) + ", voxel " + number(windows.main.view.voxel_mm) +
         " mm, " + std::to_string(result.samples) + " samples\n";
}

Result<Outcome> run_force(const ForceOptions& options) {
  if (auto input = check_input(options.project); !input) return input.error();
  const auto clay = io::load_project(options.project);
  if (!clay) return clay.error();
  const auto windows = read_windows(options, clay.value());
  if (!windows) return windows.error();
  std::vector<double> cpu_us;
  ForceResult result;
  for (int i = 0; i < options.repeat; ++i) {
    const double before = thread_cpu_us();
    result = evaluate(options, windows.value());
    cpu_us.push_back(thread_cpu_us() - before);
  }
  Outcome outcome;
  outcome.json = result_json(result, windows.value(), cpu_us);
  outcome.text = text_of(result, windows.value());
  return outcome;
}

}  // namespace

void add_force(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ForceOptions>();
  CLI::App* command = add_command(app, selected, "force", "say what a tool at one place feels",
                                  [options](const Progress&) { return run_force(*options); });
  command->add_option("PROJECT", options->project, "a project (NAME.vdb)")->required();
  command
      ->add_option_function<std::string>(
          "--tool", [options](const std::string& text) { read_tool(text, options->tool); },
          "ball:R or ellipsoid:A,B,C, radii in mm")
      ->type_name("TOOL")
      ->required();
  add_triple(*command, "--at", options->tool.position_mm, "the tool's centre in mm")->required();
  add_triple(*command, "--vel", options->tool.velocity_mm_per_s, "its velocity in mm/s");
  add_triple(*command, "--omega", options->tool.angular_velocity_rad_per_s,
             "its angular velocity in rad/s");
  add_choice(*command, "--law", options->law, {"energy", "blanch"}, "default energy");
  add_choice(*command, "--method", options->method, {"lod", "fine", "point"}, "default lod");
  add_number(*command, "--exponent", options->material.exponent, {1.0, 8.0}, "default 2");
  add_number(*command, "--skin-mm", options->material.skin_mm, kPositive, "default 8");
  add_integer(*command, "--repeat", options->repeat, 1, 10'000'000,
              "evaluate so often; cpu_us tells the spread");
}

}  // namespace argil::cli
