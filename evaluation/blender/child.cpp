// SPDX-License-Identifier: GPL-3.0-or-later
// Runs Blender as a child: at home in a scratch folder, watched while it works.
#include "blender/child.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include "chart/chart.h"
#include "common/child_program.h"
#include "common/output.h"

namespace argil::evaluation {
namespace {

/// How often it is looked what Blender has done: seldom, since it is being timed.
constexpr std::chrono::milliseconds kBlenderLook{50};

/// What it writes for its user, and for the next run, goes with its home. Anything that would find
/// it another screen is taken away.
std::vector<std::string> command_line(const BlenderCall& call) {
  const std::string home = (call.scratch / call.job).parent_path().string();
  std::vector<std::string> words{"env", "-u", "WAYLAND_DISPLAY"};
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "TMPDIR", "TMP", "TEMP"}) {
    words.push_back(std::string(name) + "=" + home);
  }
  if (!call.display.empty()) words.push_back("DISPLAY=:" + call.display);
  words.insert(words.end(), {"LIBGL_ALWAYS_SOFTWARE=1", "blender"});
  if (call.display.empty()) words.emplace_back("-b");
  words.insert(words.end(),
               {"--factory-startup", "-noaudio", "--python", (call.scratch / call.script).string(),
                "--", (call.scratch / call.job).string()});
  return words;
}

}  // namespace

std::string blender_obstacle(std::span<const NeededProgram> needed) {
  for (const auto& [program, package] : needed) {
    if (cli::has_program(program)) continue;
    return std::string("Blender: ") + program + " is not installed (package " + package + ")";
  }
  return "";
}

std::string text_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

OutputFile::OutputFile(const std::filesystem::path& file)
    : handle_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {}
OutputFile::~OutputFile() {
  if (handle_ >= 0) ::close(handle_);
}

Result<void> run_blender_child(const BlenderCall& call, const Progress& progress) {
  const OutputFile said(call.scratch / "said");
  const cli::Stopwatch waited;
  cli::ChildProgram blender((call.scratch / call.job).parent_path(), command_line(call),
                            {said.handle(), said.handle()});
  while (!blender.ended()) {
    if (auto go = tell(progress, "Blender", std::clamp(call.done(), 0.0, 1.0)); !go) return go;
    if (call.patience_s > 0.0 && waited.seconds() > call.patience_s) {
      return Error{ErrorKind::internal,
                   "Blender took more than " + cli::number(call.patience_s) + " s"};
    }
    std::this_thread::sleep_for(kBlenderLook);
  }
  return {};
}

std::string last_said(const cli::ScratchFolder& scratch) {
  const std::string text = text_in(scratch / "said");
  const std::size_t end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return "it said nothing";
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
}

}  // namespace argil::evaluation
