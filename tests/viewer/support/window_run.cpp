// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/window_run.h"

#include <fstream>

#include "argil/engine/clay.h"
#include "argil/io/session.h"

#include "support/built.h"

namespace argil::test {

std::string shell_word(const std::filesystem::path& file) {
  std::string word(1, '\'');
  word += file.string();
  return word += '\'';
}
namespace {

/// Runs the shell's lines in $1 on a display of their own, of $2 pixels, and ends as they do. The
/// server takes a number that is free: xvfb-run would look for one itself, and sometimes two find
/// the same. It does not reset, as it else would whenever its last client leaves (xdotool, that
/// looks for the window): who connects during a reset is dropped.
constexpr const char* kOnADisplay = R"sh(
rm -f display  # of a run before
export LP_NUM_THREADS=0  # software OpenGL without extra threads: three tests share two processors
Xvfb -displayfd 3 -noreset -screen 0 "$2"x24 -nolisten tcp 3>display 2>xvfb.txt &
server=$!
tries=0
until [ -s display ]; do
  tries=$((tries + 1))
  kill -0 $server && [ $tries -lt 3000 ] || { cat xvfb.txt >&2; exit 99; }
  sleep 0.02
done
DISPLAY=:$(cat display) timeout 600 sh -c "$1"
status=$?
kill $server
wait
exit $status
)sh";

}  // namespace

WindowRun WindowTest::run(const std::string& shell) {
  const std::filesystem::path out = folder_ / "out.json";
  const std::filesystem::path err = folder_ / "err.txt";
  const ProgramRun ran =
      run_program({"sh", "-c",
                   "cd " + shell_word(folder_.path()) + "\nexec >" + shell_word(out) + " 2>" +
                       shell_word(err) + "\n" + kOnADisplay,
                   "sh", shell, display_});
  WindowRun result;
  result.status = ran.status;
  std::ifstream words(err);
  result.words.assign(std::istreambuf_iterator<char>(words), {});
  std::ifstream report(out);
  result.report = nlohmann::json::parse(report, nullptr, false);
  if (result.report.is_discarded()) result.report = nullptr;
  return result;
}

WindowRun WindowTest::play(const std::string& script, const std::string& arguments,
                           const std::string& size) {
  const std::filesystem::path input = folder_ / "script.txt";
  std::ofstream(input) << script;
  return run(std::string("exec ") + argil_program() + " view --json --check-gl --home " +
             shell_word(home()) + " --input " + shell_word(input) + " " + size + " " + arguments);
}

WindowRun WindowTest::run_beside(const std::string& shell, const std::string& arguments) {
  return run(std::string(argil_program()) + " view --json --check-gl --home " + shell_word(home()) +
             " " + kWindowSize + " " + arguments + " &\nview=$!\n" + shell);
}

viewer::Camera WindowTest::first_camera(const Box3& bounds_mm) {
  viewer::Camera camera;
  camera.resize(kWindowWidth, kWindowHeight);
  camera.look_from(normalized(Vec3{0.35, -1.0, 0.45}), {0.0, 0.0, 1.0});
  camera.frame(bounds_mm);
  return camera;
}

std::uint64_t leave_a_stroke(const std::filesystem::path& project, double radius_mm) {
  std::filesystem::create_directories(project.parent_path());
  auto session = io::Session::create(project, Clay::ball(radius_mm, {}).value());
  EXPECT_TRUE(session.ok());
  Stroke stroke;
  stroke.samples = {{0.0, {radius_mm, 0.0, 0.0}, {}, 1.0}};
  EXPECT_TRUE(session.value().clay().apply(stroke).ok());
  session.value().record(stroke);
  EXPECT_TRUE(session.value().flush().ok());
  return session.value().clay().hash();
}

std::string name_file(const std::filesystem::path& file) {
  return "frames 3\nclick ##name\nkey Ctrl+A\ntype " + file.string() + "\nkey Enter\nsettle\n";
}

}  // namespace argil::test
