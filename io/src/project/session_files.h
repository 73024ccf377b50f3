// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "argil/core/result.h"

namespace argil::io {

/// What stands beside a project while it is sculpted (docs/files.md, "A session").
struct SessionFiles {
  std::filesystem::path project;   ///< links followed
  std::filesystem::path journal;   ///< NAME.journal.jsonl
  std::filesystem::path lock;      ///< NAME.lock
  std::filesystem::path autosave;  ///< .NAME.autosave.vdb
  std::filesystem::path origin;    ///< .NAME.origin.vdb: what the journal starts from, after a save
  std::string solid_front;  ///< .NAME.solid-, then HASH.ply, .vdb or .png: what steps work with
};

/// Whether there is something of that name, be it a link to nothing.
bool is_there(const std::filesystem::path& file);

/// The name of a file without its folder, in quotes, as messages show it.
std::string quoted_name(const std::filesystem::path& file);

/// Names only; nothing needs to be there.
SessionFiles session_files(const std::filesystem::path& project);

/// The first FILE.WORD-N that is free.
std::filesystem::path free_aside(const std::filesystem::path& file, const std::string& word);

/// Renames `file` to free_aside and returns that name; nothing when it is not
/// there. Errors  disk.
Result<std::optional<std::filesystem::path>> keep_aside(const std::filesystem::path& file,
                                                        const std::string& word);

/// The same bytes under a second name that must be free: a hard link, or a copy where the file
/// system has none.
/// Errors  as keep_bytes.
Result<void> keep_copy(const std::filesystem::path& from, const std::filesystem::path& to);

/// A copy under a name that must be free, which stays as it is when the file is written to. It is
/// on the disk when this returns, or not there at all. Errors  disk; interrupted.
Result<void> keep_bytes(const std::filesystem::path& from, const std::filesystem::path& to);

/// Cuts a journal to its first bytes, keeping a copy when `keep`, which the notes tell: steps
/// behind damage are not ours to throw away. Errors  as keep_bytes.
Result<void> cut_journal(const std::filesystem::path& journal, std::uint64_t bytes, bool keep,
                         std::vector<std::string>& notes);

/// Removes a file when it is there. Errors  disk.
Result<void> remove_if_there(const std::filesystem::path& file);

/// The names of all solids beside a project. What cannot be read is passed over.
std::set<std::string> solids_beside(const SessionFiles& files);

/// Together, as far as they are there.
std::uint64_t bytes_of_solids(const SessionFiles& files);
/// 0 where it is not there.
std::uint64_t bytes_of_file(const std::filesystem::path& file);

/// Removes all solids but `wanted`; none when a journal was kept aside, which may need them.
/// Errors  disk.
Result<void> remove_solids(const SessionFiles& files, const std::set<std::string>& wanted);

/// Removes what keep_aside made of journal and origin, whatever the word. Errors  disk.
Result<void> remove_kept_aside(const SessionFiles& files);

/// Removes temporary files of saves of these files whose programs were killed. The caller holds the
/// lock, so that no living session writes them.
void remove_stale_temporaries(const SessionFiles& files);

}  // namespace argil::io
