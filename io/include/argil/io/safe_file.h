// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "argil/core/result.h"

namespace argil::io {

/// Writes `file` so that a reader sees either the old content or the whole new one: `write` fills a
/// temporary file in the same folder, which is flushed, synced and renamed over `file`, then the
/// folder is synced. When anything fails or `write` returns an error, the temporary file is removed
/// and `file` is as it was. The temporary file is also removed on the signals of
/// `install_interrupt_cleanup` when that was called.
/// `write` gets the temporary file's path.
/// Errors  disk naming file, the system's reason and remedy; or what `write` returned.
Result<void> replace_file(const std::filesystem::path& file,
                          const std::function<Result<void>(const std::filesystem::path&)>& write);

/// The same of a text. Errors as replace_file.
Result<void> replace_text(const std::filesystem::path& file, std::string_view text);

/// Makes SIGINT, SIGTERM, SIGHUP (unless it is ignored, as by nohup) and SIGPIPE (nobody reads
/// what it writes) set the flag `interrupted()` instead of killing the process; a second SIGINT or
/// SIGTERM removes temporary files of `replace_file`, locks, and what a session that is all or
/// nothing wrote, and ends it. Call once, from main.
void install_interrupt_cleanup();
bool interrupted() noexcept;

/// The signal that told the program to end: SIGINT or SIGTERM; 0 before.
int ending_signal() noexcept;

/// For a program that has nothing to save: after the first SIGINT or SIGTERM, or from now on when
/// that has come, its work has so long to come to its own end, wherever it is, in a library that
/// asks nobody too. Then `words` are written to `descriptor`, and the program ends as by a second
/// signal. Forgotten with the interrupt. Once. Limits  words of 1000 bytes.
void end_within(double seconds, int descriptor, const std::string& words);

/// For a program whose usual end is an interrupt: it obeys, and saves what it has. `interrupted()`
/// is false again; a second signal still ends it at once.
void forget_interrupt() noexcept;

}  // namespace argil::io
