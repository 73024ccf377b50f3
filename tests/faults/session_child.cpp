// SPDX-License-Identifier: GPL-3.0-or-later
// A sculpting program to be killed: session_child PROJECT SEED FD. After every step that is
// certainly on the disk it writes their number (4 bytes) to FD. Exit status 0: done; 3: could not
// open; 4: could not close.
#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

#include "argil/io/session.h"

#include "support/session_life.h"

namespace {

using argil::io::Session;

void say(int pipe, std::uint32_t durable) {
  if (::write(pipe, &durable, sizeof durable) != sizeof durable) std::_Exit(5);
}

void live(Session& session, unsigned seed, int pipe) {
  std::uint32_t done = 0;
  for (int turn = 0; turn < argil::test::kLifeTurns; ++turn) {
    const auto step = argil::test::life_step(seed, turn);
    if (!step) {
      static_cast<void>(session.save().ok());  // may fail as the disk does; work goes on
      continue;
    }
    if (!argil::io::apply_step(session.clay(), *step)) continue;  // nothing to undo
    session.record(*step);
    ++done;
    // Sometimes several wait for the disk at once.
    if (turn % 3 != 0 && session.flush().ok()) say(pipe, done);
  }
  if (session.flush().ok()) say(pipe, done);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::filesystem::path project = argv[1];
  const auto seed = static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10));
  const int pipe = std::atoi(argv[3]);
  argil::io::SessionOptions options;
  options.autosave_steps = 5;
  options.autosave_leaves = 20;  // so that a copy takes several steps
  auto session = std::filesystem::exists(project)
                     ? Session::open(project, options)
                     : Session::create(project, argil::test::life_start(), options);
  if (!session) return 3;
  live(session.value(), seed, pipe);
  if (seed % 4 == 0 && !session.value().close()) return 4;
  return 0;
}
