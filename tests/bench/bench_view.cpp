// SPDX-License-Identifier: GPL-3.0-or-later
// The window at a million triangles (bench_view 20: at twenty), in a display of its own with
// software OpenGL: what a frame takes in each shading while the camera turns, how long after the
// mouse a dab is on the screen, how many bytes it took, what a window takes that nobody touches,
// and whether drawing makes the servo late.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/engine/surface.h"
#include "argil/io/project_file.h"

#include "support/bumpy_clay.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace {

namespace fs = std::filesystem;
using argil::test::ProgramRun;

constexpr double kVoxelMm = 0.25;
constexpr double kRadiusMm = 39.5;  // a million triangles

/// The number after a key of a JSON text, the first after `from`; -1 when there is none.
double number_after(const std::string& json, const std::string& key, const std::string& from = "") {
  const std::size_t start = json.find("\"" + from + "\"");
  const std::size_t at = json.find("\"" + key + "\":", start == std::string::npos ? 0 : start);
  return at == std::string::npos ? -1.0 : std::strtod(json.c_str() + at + key.size() + 3, nullptr);
}

/// What a run of the window said, and the processor time of its process.
struct Run {
  std::string report;
  double cpu_s = 0.0;
};

/// Seconds of one "0m1.25s", as a shell's `times` writes them.
double seconds_of(const std::string& word) {
  const std::size_t minutes_end = word.find('m');
  return 60.0 * std::strtod(word.c_str(), nullptr) +
         std::strtod(word.c_str() + minutes_end + 1, nullptr);
}

class Windows {
 public:
  Windows(fs::path folder, fs::path project, std::string program)
      : folder_(std::move(folder)), project_(std::move(project)), program_(std::move(program)) {}

  /// Plays a script. `times` of the shell around it tells what its children took.
  Run play(const std::string& script, const std::string& device) {
    std::ofstream(folder_ / "script.txt") << script;
    const ProgramRun ran = run("\"$@\" --json; status=$?; times; exit $status",
                               {"--device", device, "--input", (folder_ / "script.txt").string()});
    std::istringstream last(ran.output.substr(ran.output.rfind('\n', ran.output.size() - 2) + 1));
    std::string user;
    std::string system;
    last >> user >> system;
    return {ran.output, seconds_of(user) + seconds_of(system)};
  }

  /// Percent of one core that a window takes that nobody touches, after `keys` of xdotool.
  double idle_percent(const std::string& keys) {
    // Fields 14 and 15 of the process's line: ticks in user and system mode.
    const ProgramRun ran =
        run("\"$@\" >/dev/null 2>&1 & view=$!\nsleep 5\n" + keys +
                "sleep 3\nticks() { awk '{ print $14 + $15 }' /proc/$view/stat; }\n"
                "before=$(ticks); sleep 20; after=$(ticks); kill $view; wait $view\n"
                "echo $(((after - before) * 1000 / (20 * $(getconf CLK_TCK))))",
            {});
    return 0.1 * std::strtod(ran.output.c_str(), nullptr);
  }

 private:
  ProgramRun run(const std::string& shell, const std::vector<std::string>& more) {
    // A copy each time: what a script leaves unsaved would be asked about.
    const fs::path copy = folder_ / ("run-" + std::to_string(++runs_) + ".vdb");
    fs::copy_file(project_, copy);
    std::vector<std::string> words{"xvfb-run",
                                   "-a",
                                   "-s",
                                   "-screen 0 1280x800x24",
                                   "bash",
                                   "-c",
                                   shell,
                                   "bash",
                                   program_,
                                   "view",
                                   copy.string(),
                                   "--home",
                                   (folder_ / "home").string()};
    words.insert(words.end(), more.begin(), more.end());
    ProgramRun ran = argil::test::run_program(words);
    if (ran.status != 0)
      std::printf("argil view ended with %d: %s\n", ran.status, ran.output.c_str());
    return ran;
  }

  fs::path folder_;
  fs::path project_;
  std::string program_;
  int runs_ = 0;
};

/// A line of a script that turns the camera all the time, so that nothing is drawn twice the same.
std::string turns(int moves) {
  return "drag right 900 300 1000 320 " + std::to_string(moves) + "\n";
}

void print_frames(Windows& windows) {
  std::printf("| shading | frame ms, median | p99 | CPU ms a frame |\n|---|---|---|---|\n");
  constexpr int kTurns = 150;
  std::string keys = "settle\n";
  const double before_s = windows.play(keys + turns(1), "mouse").cpu_s;
  for (const char* shading : {"Clay", "Plain", "Curvature", "Detail", "Wireframe"}) {
    const bool has_wires = std::string_view(shading) == "Wireframe";
    const Run run = windows.play((has_wires ? "settle\nkey W\n" : keys) + turns(kTurns), "mouse");
    std::printf(
        "| %s | %.1f | %.1f | %.1f |\n", shading, number_after(run.report, "p50", "frame_ms"),
        number_after(run.report, "p99", "frame_ms"), 1e3 * (run.cpu_s - before_s) / (kTurns - 1));
    keys += "key Z\n";
  }
}

void print_latency(Windows& windows) {
  std::printf(
      "\n| tool | dabs | latency ms, median | p99 | bytes a dab |\n|---|---|---|---|---|\n");
  const double at_rest =
      number_after(windows.play("settle\nframes 5\n", "mouse").report, "uploaded_bytes");
  for (const auto& [name, sizes] :
       {std::pair<const char*, int>{"Draw, 1.4 mm", -13}, {"Draw, 5 mm", 0}, {"Draw, 13 mm", 10}}) {
    std::string script = "settle\n";
    for (int n = 0; n < std::abs(sizes); ++n) script += sizes < 0 ? "key [\n" : "key ]\n";
    for (int n = 0; n < 4; ++n) {
      const std::string y = std::to_string(300 + 60 * n);
      script += "drag left 540 " + y + " 740 " + y + " 60\nsettle\n";
    }
    const std::string report = windows.play(script, "mouse").report;
    const double dabs = number_after(report, "dabs");
    std::printf("| %s | %.0f | %.1f | %.1f | %.0f |\n", name, dabs,
                number_after(report, "p50", "latency_ms"),
                number_after(report, "p99", "latency_ms"),
                (number_after(report, "uploaded_bytes") - at_rest) / dabs);
  }
}

void print_idle(Windows& windows) {
  std::printf("\n| a window that nobody touches | percent of a core |\n|---|---|\n");
  std::printf("| with its panels | %.1f |\n", windows.idle_percent(""));
  if (!argil::test::has_program("xdotool")) return;
  std::printf("| while a name is asked for | %.1f |\n",
              windows.idle_percent("xdotool key ctrl+shift+s\n"));
}

void print_servo(Windows& windows, const fs::path& project) {
  std::printf("\n| the servo beside | lateness us, median | p99 |\n|---|---|---|\n");
  const std::string turned = windows.play("settle\nmove 640 420\n" + turns(100), "sim").report;
  std::printf("| a window that draws all the time | %.0f | %.0f |\n",
              number_after(turned, "p50", "lateness_us"),
              number_after(turned, "p99", "lateness_us"));
  const ProgramRun alone = argil::test::run_program(
      {ARGIL_BINARY, "lab", "clay", "--project", project.string(), "--real-time", "--json"});
  std::printf("| no window (argil lab clay --real-time) | %.0f | %.0f |\n",
              number_after(alone.output, "p50", "lateness_us"),
              number_after(alone.output, "p99", "lateness_us"));
}

}  // namespace

int main(int count, char** words) {
  const double millions = count > 1 ? std::strtod(words[1], nullptr) : 1.0;
  if (!(millions > 0.0 && millions <= 100.0)) {
    std::printf(
        "usage: bench_view [MILLIONS OF TRIANGLES, usual 1, at most 100] [PROGRAM, usual the one "
        "built here]\n");
    return 2;
  }
  if (!argil::test::has_program("xvfb-run")) {
    std::printf("xvfb-run is not installed; ./tests/run.sh installs it\n");
    return 1;
  }
  const argil::test::ScratchFolder folder;
  const fs::path project = folder / "ball.vdb";
  auto clay = argil::test::bumpy_ball(kRadiusMm * std::sqrt(millions), kVoxelMm);
  if (!clay || !argil::io::save_project(project, clay.value())) {
    std::printf("the clay could not be made\n");
    return 1;
  }
  argil::Surface surface;
  surface.update(clay.value());
  std::printf("Ball of %lld triangles, window of 1280 x 800, software OpenGL (Xvfb).\n\n",
              static_cast<long long>(surface.triangle_count()));
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // each row as soon as it is known
  Windows windows(folder.path(), project, count > 2 ? words[2] : ARGIL_BINARY);
  print_frames(windows);
  print_latency(windows);
  print_idle(windows);
  print_servo(windows, project);
  return 0;
}
