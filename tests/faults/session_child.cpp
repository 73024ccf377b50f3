// SPDX-License-Identifier: GPL-3.0-or-later
// A sculpting program to be killed: session_child PROJECT SEED FD WAY. It says by 4 bytes to FD how
// many steps are certainly on the disk, after each. Exit status 0: done; 3: could not open; 4:
// could not close. The ways:
//   steps            does the steps of a life
//   moves            that, and saves the project under another name on the way
//   hand             works the clay by a ClayWorker on a thread of its own
//   waits            does nothing until it is killed
//   forced, forced-all-or-nothing
//                    does one stroke and ends by two interrupts, the second of which lets nothing
//                    end
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <thread>

#include <unistd.h>

#include "argil/core/clay_heartbeat.h"
#include "argil/engine/clay_thread.h"
#include "argil/engine/clay_worker.h"
#include "argil/io/safe_file.h"
#include "argil/io/session.h"

#include "support/session_life.h"

namespace {

using argil::io::Session;

void say(int pipe, std::uint32_t durable) {
  if (::write(pipe, &durable, sizeof durable) != sizeof durable) std::_Exit(5);
}

/// Between PROJECT and its neighbour, to and fro.
std::filesystem::path place_at(const std::filesystem::path& project, int turn) {
  const bool is_away = turn / argil::test::kMoveTurns % 2 == 0;
  return is_away ? argil::test::moved_name(project) : project;
}

/// `moving`: from there; null: stays.
void live(Session& session, unsigned seed, int pipe, const std::filesystem::path* moving) {
  std::uint32_t done = 0;
  for (int turn = 0; turn < argil::test::kLifeTurns; ++turn) {
    if (moving != nullptr && turn % argil::test::kMoveTurns == argil::test::kMoveTurns - 1) {
      if (session.save_as(place_at(*moving, turn)).ok()) say(pipe, done);
    }
    const auto step = argil::test::life_step(seed, turn);
    if (!step) {
      static_cast<void>(session.save().ok());  // may fail as the disk does; work goes on
      continue;
    }
    if (!argil::io::apply_step(session.sculpture(), *step)) continue;  // nothing to undo
    session.record(*step);
    ++done;
    // Sometimes several wait for the disk at once.
    if (turn % 3 != 0 && session.flush().ok()) say(pipe, done);
  }
  if (session.flush().ok()) say(pipe, done);
}

/// Session, clay and worker belong to the clay's thread; this one is the servo's.
void live_in_hand(Session& session, unsigned seed, int pipe) {
  using namespace argil;
  std::uint32_t done = 0;
  ClayWorkerOptions options;
  options.tool = test::hand_tool(seed);
  options.on_stroke = [&](const Stroke& stroke) {
    session.record(stroke);
    ++done;
    if (done % 3 != 0 && session.flush().ok()) say(pipe, done);
  };
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayWorker worker(session.clay(), options, ring, channel);
  ClayHeartbeat heartbeat;
  auto thread = ClayThread::start(worker, heartbeat);
  if (!thread) return;
  for (std::uint64_t n = 0; n < test::kHandRuns * test::kHandRun; ++n) {
    while (!ring.push(test::hand_sample(seed, n))) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  static_cast<void>(thread.value()->stop().ok());
  if (session.flush().ok()) say(pipe, done);
}

void end_by_force(Session& session, int pipe) {
  argil::io::install_interrupt_cleanup();
  argil::Stroke stroke;
  stroke.samples = {{0.0, {6.0, 0.0, 0.0}, {}, 1.0}};
  if (!session.clay().apply(stroke)) return;
  session.record(stroke);
  if (session.flush().ok()) say(pipe, 1);
  std::raise(SIGINT);
  std::raise(SIGINT);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const std::filesystem::path project = argv[1];
  const auto seed = static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10));
  const int pipe = std::atoi(argv[3]);
  const std::string_view way = argv[4];
  argil::io::SessionOptions options;
  options.is_all_or_nothing = way == "forced-all-or-nothing";
  options.keeps_history = argil::test::keeps_history(seed);
  options.history_steps = 10;  // so that the oldest go
  options.autosave_steps = 5;
  options.autosave_leaves = 20;  // so that a copy takes several steps
  auto session = std::filesystem::exists(project)
                     ? Session::open(project, options)
                     : Session::create(project, argil::test::life_start(), options);
  if (!session) return 3;
  if (way == "hand") {
    live_in_hand(session.value(), seed, pipe);
  } else if (way == "waits") {
    say(pipe, 0);
    for (;;) ::pause();
  } else if (way.substr(0, 6) == "forced") {
    end_by_force(session.value(), pipe);
  } else {
    live(session.value(), seed, pipe, way == "moves" ? &project : nullptr);
  }
  if (seed % 4 == 0 && !session.value().close()) return 4;
  return 0;
}
