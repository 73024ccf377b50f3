// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/blender.h"

#include <chrono>
#include <csignal>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "argil/io/mesh_file.h"

#include "arena/truth.h"
#include "blender/mesh_files.h"
#include "support/built.h"
#include "support/scratch.h"
#include "support/spawn.h"

namespace argil::arena {
namespace {

constexpr double kVoxelsAlong = 256.0;
constexpr double kStartS = 30.0;

/// A Blender that waits for jobs in a folder of its own.
class BlenderServer {
 public:
  BlenderServer() {
    const std::filesystem::path source = test::source_folder();
    test::fill(folder_ / "serve.py",
               test::content_of(source / "evaluation/blender/mesh.py") +
                   test::content_of(source / "tests/arena/blender_server.py"));
    const std::string home = folder_.path().string();
    process_ = test::spawn(
        "/bin/sh",
        {"-c",
         "exec blender -b --factory-startup -noaudio --python \"$0/serve.py\" -- \"$0\" "
         ">\"$0/said\" 2>&1 </dev/null",
         home},
        {"HOME=" + home, "XDG_CONFIG_HOME=" + home, "XDG_CACHE_HOME=" + home, "TMPDIR=" + home});
  }
  BlenderServer(const BlenderServer&) = delete;
  BlenderServer& operator=(const BlenderServer&) = delete;
  ~BlenderServer() {
    if (process_ > 0) end();
  }

  bool is_alive() const { return process_ > 0; }

  Attempt run(const nlohmann::json& job) {
    using Clock = std::chrono::steady_clock;
    const std::string name = std::to_string(number_++);
    const double patience = kPatienceS + (number_ == 1 ? kStartS : 0.0);
    test::fill(folder_ / (name + ".part"), job.dump());
    std::filesystem::rename(folder_ / (name + ".part"), folder_ / (name + ".job"));
    Attempt attempt;
    const auto begin = Clock::now();
    while (!std::filesystem::exists(folder_ / (name + ".done"))) {
      const double waited = std::chrono::duration<double>(Clock::now() - begin).count();
      attempt.crashed = ::waitpid(process_, nullptr, WNOHANG) != 0;
      attempt.hung = waited > patience;
      if (attempt.crashed) process_ = -1;
      if (attempt.hung && !attempt.crashed) end();
      if (attempt.crashed || attempt.hung) {
        attempt.wall_s = attempt.cpu_s = waited;
        return attempt;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    const auto answer =
        nlohmann::json::parse(test::content_of(folder_ / (name + ".done")), nullptr, false);
    if (!answer.contains("ms")) {
      attempt.status = 1;
      attempt.said = answer.value("error", "no answer");
      return attempt;
    }
    attempt.wall_s = 1e-3 * answer["ms"][0].get<double>();
    attempt.cpu_s = 1e-3 * answer["ms"][1].get<double>();
    return attempt;
  }

 private:
  void end() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

  test::ScratchFolder folder_;
  pid_t process_ = -1;
  int number_ = 0;
};

}  // namespace

Attempt run_blender(const std::filesystem::path& folder, const std::filesystem::path& broken) {
  static std::mutex one_at_a_time;
  static std::unique_ptr<BlenderServer> server;
  const std::lock_guard lock(one_at_a_time);
  const auto mesh = io::read_mesh(broken);
  if (!mesh || !evaluation::write_mesh_files(folder / "body", mesh.value())) return {};
  if (!server || !server->is_alive()) server = std::make_unique<BlenderServer>();
  const std::filesystem::path result = folder / "remeshed";
  Attempt attempt = server->run({{"body", (folder / "body").string()},
                                 {"result", result.string()},
                                 {"voxel", largest_side(mesh.value()) / kVoxelsAlong}});
  if (!attempt.crashed && !attempt.hung && attempt.status == 0) {
    attempt.mesh = evaluation::read_mesh_files(result);
  }
  return attempt;
}

}  // namespace argil::arena
