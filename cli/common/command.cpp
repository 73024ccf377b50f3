// SPDX-License-Identifier: GPL-3.0-or-later
// What every command has: the options that all share, and an end within a second of a signal.
#include "common/command.h"

#include <cassert>
#include <cstdio>
#include <mutex>
#include <utility>

#include <unistd.h>

#include "argil/io/safe_file.h"

#include "common/options.h"
#include "common/output.h"

namespace argil::cli {
namespace {

/// What the program itself needs, and a small piece.
constexpr double kLeastMemoryGb = 0.25;

/// How the command that runs says that it was interrupted.
struct LastWords {
  bool json = false;
  int out = STDOUT_FILENO;
};
LastWords g_last_words;

/// For what the work does not come to itself, in a library that asks nobody.
void end_soon() {
  // With what the end itself takes, within a second.
  constexpr double kPatienceS = 0.8;
  const std::string message = "interrupted; no file is half written";
  if (g_last_words.json) {
    const Json json = error_json("interrupted", message, status_of(ErrorKind::interrupted));
    io::end_within(kPatienceS, g_last_words.out, json.dump(2) + "\n");
  } else {
    io::end_within(kPatienceS, STDERR_FILENO, "argil: " + message + "\n");
  }
}

}  // namespace

CLI::App* add_command(CLI::App& app, Selected& selected, const std::string& name,
                      const std::string& description, Work work, OnInterrupt on_interrupt) {
  assert(!name.empty() && work != nullptr);
  CLI::App* command = app.add_subcommand(name, description);
  command->add_flag("--json", selected.json, "print one JSON object on stdout");
  command->add_flag("--quiet", selected.quiet, "no progress bar, no text on success");
  add_integer(*command, "--threads", selected.threads, 1, 1024, "worker threads; default all");
  add_number(*command, "--max-memory", selected.max_memory_gb, {kLeastMemoryGb, 1e6},
             "GB that may be taken; default a quarter of the machine's, but 2 at least");
  const bool nested = app.get_parent() != nullptr;
  command->final_callback([&selected, full = nested ? app.get_name() + " " + name : name,
                           work = std::move(work), on_interrupt] {
    selected.command = full;
    selected.ends_itself = on_interrupt == OnInterrupt::ends_itself;
    selected.work = work;
  });
  return command;
}

void say_interrupted_on(bool json, int out) {
  assert(out >= 0);
  g_last_words = {json, out};
}

void end_within_a_second() {
  static std::once_flag is_to_end;
  std::call_once(is_to_end, end_soon);
}

}  // namespace argil::cli
