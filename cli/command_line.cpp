// SPDX-License-Identifier: GPL-3.0-or-later
// The command line as a whole: which command, with how much memory and how many threads, and what
// becomes of its outcome.
#include "command_line.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include "argil/io/safe_file.h"

#include "commands.h"
#include "common/command.h"
#include "common/options.h"
#include "common/output.h"

namespace argil::cli {
namespace {

/// Of --max-memory, where nobody said how much.
constexpr double kLeastDefaultGb = 2.0;
/// Statuses of exit as docs/command_line.md lists them.
constexpr int kUsage = 2;
constexpr int kInternal = 5;

void print_json(const Json& json) {
  // Messages may quote bytes of a file name or a damaged file that are not UTF-8.
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
}

int fail(bool json, const std::string& kind, const std::string& message, int status) {
  if (json) print_json(error_json(kind, message, status));
  std::fprintf(stderr, "argil: %s\n", message.c_str());
  return status;
}

/// While it lives, what is printed on stdout goes to stderr: libraries warn there, OpenVDB for one,
/// and stdout has the outcome alone.
class StdoutKept {
 public:
  StdoutKept() : kept_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
    if (kept_ >= 0) ::dup2(STDERR_FILENO, STDOUT_FILENO);  // without stderr all is as before
  }
  ~StdoutKept() {
    std::cout.flush();
    // A failure up to here was that of stderr.
    std::cout.clear();
    std::fflush(stdout);
    if (kept_ < 0) return;
    ::dup2(kept_, STDOUT_FILENO);
    ::close(kept_);
  }
  StdoutKept(const StdoutKept&) = delete;
  StdoutKept& operator=(const StdoutKept&) = delete;

  int descriptor() const noexcept { return kept_ >= 0 ? kept_ : STDOUT_FILENO; }

 private:
  int kept_;
};

/// Beyond it allocation fails, which every command answers with status 5 and nothing changed.
/// Returns the limit in GB.
double limit_memory(const Selected& selected) {
  const double machine_gb = 1e-9 * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
                            static_cast<double>(::sysconf(_SC_PAGESIZE));
  const double gb = selected.max_memory_gb > 0.0 ? selected.max_memory_gb
                                                 : std::max(0.25 * machine_gb, kLeastDefaultGb);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which reserve terabytes
  rlimit limit{};
  // RLIMIT_DATA covers mmap since Linux 4.7; RLIMIT_AS would also count address space that is only
  // reserved.
  if (::getrlimit(RLIMIT_DATA, &limit) == 0) {
    limit.rlim_cur = std::min(static_cast<rlim_t>(1e9 * gb), limit.rlim_max);
    ::setrlimit(RLIMIT_DATA, &limit);
  }
#endif
  return gb;
}

/// --json counts even when the rest of the line could not be parsed.
bool asks_for_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) return true;
  }
  return false;
}

/// The work on as many threads as were asked for, 0 for all. An arena of its own, because TBB's own
/// never has more threads than the machine has cores, whatever the limit.
Result<Outcome> work_on_threads(const Selected& selected) {
  const Progress progress = terminal_progress(selected.quiet);
  if (selected.threads == 0) return selected.work(progress);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(selected.threads));
  tbb::task_arena arena(selected.threads);
  return arena.execute([&] { return selected.work(progress); });
}

Result<Outcome> run_work(const Selected& selected) {
  const StdoutKept kept;
  say_interrupted_on(selected.json, kept.descriptor());
  if (!selected.ends_itself) end_within_a_second();
  try {
    return work_on_threads(selected);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory, "out of memory in 'argil " + selected.command +
                                        "'; close other programs or use a coarser voxel size"};
  } catch (const std::exception& error) {
    return Error{ErrorKind::internal, "'argil " + selected.command + "' failed (" + error.what() +
                                          "); please report this as a bug"};
  }
}

int run(const Selected& selected) {
  assert(selected.work != nullptr);  // parse() wants a subcommand
  const double most_gb = limit_memory(selected);
  const Result<Outcome> outcome = run_work(selected);
  finish_progress();
  if (!outcome) {
    const Error& error = outcome.error();
    const std::string limit = error.kind == ErrorKind::memory
                                  ? " (--max-memory is " + number(most_gb) + " GB)"
                                  : std::string();
    return fail(selected.json, kind_name(error.kind), error.message + limit, status_of(error.kind));
  }
  if (selected.json) {
    print_json(outcome.value().json);
  } else if (!selected.quiet) {
    std::cout << outcome.value().text << std::flush;
  }
  if (!std::cout && io::interrupted()) return status_of(ErrorKind::interrupted);  // nobody reads
  if (!std::cout) return fail(false, "disk", "cannot write the result to stdout", kInternal);
  return outcome.value().status;
}

/// The first word when it is not a subcommand; CLI11 would only say that one is required.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  std::string known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return "";
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  return "'" + std::string(argv[1]) + "' is not a command; must be one of " + known;
}

/// " chart stability": the commands as far as the line has them.
std::string chosen_words(const CLI::App& app) {
  std::string words;
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().back();
    words += " " + at->get_name();
  }
  return words;
}

/// Prints help or version (status 0), or says what is wrong with the command line (status 2).
int answer_parse(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::string unknown = unknown_command(app, argc, argv);
  const std::string message = unknown.empty() ? error.what() : unknown;
  return fail(asks_for_json(argc, argv), "usage",
              message + "; see 'argil" + chosen_words(app) + " --help'", kUsage);
}

int main_checked(int argc, char** argv) {
  Selected selected;
  CLI::App app{"Argil: digital clay that is sculpted, felt and printed", "argil"};
  app.set_version_flag("--version", "argil " ARGIL_VERSION);
  app.require_subcommand(1);
  add_import(app, selected);
  add_info(app, selected);
  add_sculpt(app, selected);
  add_edit(app, selected);
  add_export(app, selected);
  add_check(app, selected);
  add_repair(app, selected);
  add_prepare(app, selected);
  add_render(app, selected);
  add_force(app, selected);
  add_chart(app, selected);
  add_lab(app, selected);
  add_bridge(app, selected);
  add_view(app, selected);
  add_falcon(app, selected);
  add_completion(app, selected);
  add_man(app, selected);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer_parse(app, error, argc, argv);
  }
  // Not before: while the line is read there is nothing to clean up.
  io::install_interrupt_cleanup();
  return run(selected);
}

/// Blocks of megabytes come and go with every chunk of an import; the pages that the system clears
/// for each of them cost it a fifth of its time (a virtual machine, 2 cores).
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargestBlock = 32 << 20;  // the most that glibc takes
  constexpr int kKept = 64 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);  // NOLINT(concurrency-mt-unsafe): no thread runs yet
  mallopt(M_TRIM_THRESHOLD, kKept);          // NOLINT(concurrency-mt-unsafe): the same
#endif
}

}  // namespace

int run_command_line(int argc, char** argv) {
  keep_freed_memory();
  try {
    return main_checked(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "argil: failed (%s); please report this as a bug\n", error.what());
    return 5;
  }
}

}  // namespace argil::cli
