// SPDX-License-Identifier: GPL-3.0-or-later
// The window at a million triangles (bench_view 20: at twenty), in a display of its own with
// software OpenGL: what a frame takes in each shading, how long after the mouse a dab is on the
// screen, how many bytes it took, and whether drawing makes the servo late.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
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

std::string view(const fs::path& folder, const fs::path& project, const std::string& script,
                 const std::string& device) {
  // A copy each time: what a script leaves unsaved would be asked about.
  static int runs = 0;
  const fs::path copy = folder / ("run-" + std::to_string(++runs) + ".vdb");
  fs::copy_file(project, copy);
  std::ofstream(folder / "script.txt") << script;
  const ProgramRun run = argil::test::run_program(
      {"xvfb-run", "-a", "-s", "-screen 0 1280x800x24", ARGIL_BINARY, "view", "--json", "--home",
       (folder / "home").string(), "--device", device, "--input", (folder / "script.txt").string(),
       copy.string()});
  if (run.status != 0)
    std::printf("argil view ended with %d: %s\n", run.status, run.output.c_str());
  return run.output;
}

}  // namespace

int main(int count, char** words) {
  const double millions = count > 1 ? std::strtod(words[1], nullptr) : 1.0;
  if (!(millions > 0.0 && millions <= 100.0)) {
    std::printf("usage: bench_view [MILLIONS OF TRIANGLES, usual 1, at most 100]\n");
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

  std::printf("| shading | frame ms, median | p99 |\n|---|---|---|\n");
  const std::vector<std::string> shadings{"Clay", "Plain", "Curvature", "Detail", "Wireframe"};
  std::string keys = "settle\n";
  for (const std::string& shading : shadings) {
    // Turned all the time, so that nothing is drawn twice the same.
    const std::string turns = "drag right 900 300 1000 320 100\n";
    const std::string script = shading == "Wireframe" ? "settle\nkey W\n" + turns : keys + turns;
    const std::string report = view(folder.path(), project, script, "mouse");
    std::printf("| %s | %.1f | %.1f |\n", shading.c_str(), number_after(report, "p50", "frame_ms"),
                number_after(report, "p99", "frame_ms"));
    keys += "key Z\n";
  }

  std::printf(
      "\n| tool | dabs | latency ms, median | p99 | bytes a dab |\n|---|---|---|---|---|\n");
  const double at_rest =
      number_after(view(folder.path(), project, "settle\nframes 5\n", "mouse"), "uploaded_bytes");
  for (const auto& [name, sizes] :
       {std::pair<const char*, int>{"Draw, 1.4 mm", -13}, {"Draw, 5 mm", 0}, {"Draw, 13 mm", 10}}) {
    std::string script = "settle\n";
    for (int n = 0; n < std::abs(sizes); ++n) script += sizes < 0 ? "key [\n" : "key ]\n";
    for (int n = 0; n < 4; ++n) {
      const std::string y = std::to_string(300 + 60 * n);
      script += "drag left 540 " + y + " 740 " + y + " 60\nsettle\n";
    }
    const std::string report = view(folder.path(), project, script, "mouse");
    const double dabs = number_after(report, "dabs");
    std::printf("| %s | %.0f | %.1f | %.1f | %.0f |\n", name, dabs,
                number_after(report, "p50", "latency_ms"),
                number_after(report, "p99", "latency_ms"),
                (number_after(report, "uploaded_bytes") - at_rest) / dabs);
  }

  std::printf("\n| the servo beside | lateness us, median | p99 |\n|---|---|---|\n");
  const std::string over = "settle\nmove 640 420\n";
  const std::string turned =
      view(folder.path(), project, over + "drag right 900 300 1000 320 100\n", "sim");
  std::printf("| a window that draws all the time | %.0f | %.0f |\n",
              number_after(turned, "p50", "lateness_us"),
              number_after(turned, "p99", "lateness_us"));
  const ProgramRun alone = argil::test::run_program(
      {ARGIL_BINARY, "lab", "clay", "--project", project.string(), "--real-time", "--json"});
  std::printf("| no window (argil lab clay --real-time) | %.0f | %.0f |\n",
              number_after(alone.output, "p50", "lateness_us"),
              number_after(alone.output, "p99", "lateness_us"));
  return 0;
}
