// SPDX-License-Identifier: GPL-3.0-or-later
// The files beside a project: their names, and how they are put aside and removed.
#include "project/session_files.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include "argil/io/safe_file.h"

#include "file/file_bytes.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// The process that made `name`, when that is a temporary of replace_file for `target`, else 0.
pid_t maker_of(const std::string& name, const fs::path& target) {
  std::string front(1, '.');
  front.append(target.stem().string()).append(".");
  const std::string back = target.extension().string();
  if (!name.starts_with(front) || !name.ends_with(back)) return 0;
  if (name.size() <= front.size() + back.size()) return 0;
  const char* begin = name.data() + front.size();
  const char* end = name.data() + name.size() - back.size();
  pid_t process = 0;
  unsigned count = 0;
  const auto first = std::from_chars(begin, end, process);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != '-') return 0;
  const auto second = std::from_chars(first.ptr + 1, end, count);
  return second.ec == std::errc{} && second.ptr == end ? process : 0;
}

std::string hidden(const std::string& stem, const char* ending) {
  std::string name(1, '.');
  return name.append(stem).append(ending);
}

/// Whether `name` is that of a solid: front, 16 hexadecimal digits, ending.
bool is_solid(std::string_view name, std::string_view front) {
  constexpr std::size_t kHash = 16;
  constexpr std::size_t kEnding = 4;
  if (!name.starts_with(front) || name.size() != front.size() + kHash + kEnding) return false;
  const std::string_view hash = name.substr(front.size(), kHash);
  return hash.find_first_not_of("0123456789abcdef") == std::string_view::npos &&
         (name.ends_with(".ply") || name.ends_with(".vdb") || name.ends_with(".png"));
}

/// The solid whose temporary file `name` may be: replace_file puts a dot before and its own part
/// before the ending.
fs::path solid_of_temporary(const std::string& name, std::string_view front) {
  const std::string_view view(name);
  // A dot, 16 digits, another dot and an ending of four letters, at least.
  if (view.size() < front.size() + 22 || view.front() != '.') return {};
  std::string solid(view.substr(1, front.size() + 16));
  solid.append(view.substr(view.size() - 4));
  return is_solid(solid, front) ? fs::path(solid) : fs::path();
}

/// Names of the files in a folder; what cannot be read is passed over.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  return names;
}

/// ESRCH alone: EPERM is a living process of somebody else.
bool is_dead(pid_t process) { return process > 0 && ::kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

std::string quoted_name(const fs::path& file) {
  std::string quoted(1, '\'');
  return quoted.append(file.filename().string()).append("'");
}

SessionFiles session_files(const fs::path& project) {
  std::error_code ignored;
  fs::path target = fs::weakly_canonical(fs::absolute(project, ignored), ignored);
  if (ignored) target = project;
  const fs::path folder = target.parent_path();
  const std::string stem = target.stem().string();
  return {target,
          folder / (stem + ".journal.jsonl"),
          folder / (stem + ".lock"),
          folder / hidden(stem, ".autosave.vdb"),
          folder / hidden(stem, ".origin.vdb"),
          hidden(stem, ".solid-")};
}

fs::path free_aside(const fs::path& file, const std::string& word) {
  for (int n = 1;; ++n) {
    fs::path aside = file.string() + "." + word + "-" + std::to_string(n);
    if (!is_there(aside)) return aside;
  }
}

Result<std::optional<fs::path>> keep_aside(const fs::path& file, const std::string& word) {
  if (!is_there(file)) return std::optional<fs::path>{};
  const fs::path aside = free_aside(file, word);
  if (::rename(file.c_str(), aside.c_str()) != 0) return disk_error("rename", file, errno);
  return std::optional<fs::path>(aside);
}

Result<void> keep_copy(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_hard_link(from, to, error);
  return error ? keep_bytes(from, to) : Result<void>();
}

Result<void> keep_bytes(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(to, error))) return disk_error("write", to, EEXIST);
  return replace_file(to, [&](const fs::path& temporary) -> Result<void> {
    std::error_code failed;
    fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, failed);
    return failed ? disk_error("copy", from, failed.value()) : Result<void>();
  });
}

Result<void> cut_journal(const fs::path& journal, std::uint64_t bytes, bool keep,
                         std::vector<std::string>& notes) {
  if (keep) {
    const fs::path aside = free_aside(journal, "damaged");  // never over an older one
    if (auto kept = keep_bytes(journal, aside); !kept) return kept;
    notes.push_back("the damaged journal is kept as " + quoted_name(aside));
  }
  if (::truncate(journal.c_str(), static_cast<off_t>(bytes)) == 0) return {};
  return disk_error("write", journal, errno);
}

Result<void> remove_if_there(const fs::path& file) {
  if (::unlink(file.c_str()) == 0 || errno == ENOENT) return {};
  return disk_error("remove", file, errno);
}

std::set<std::string> solids_beside(const SessionFiles& files) {
  std::set<std::string> solids;
  for (std::string& name : names_in(files.project.parent_path())) {
    if (is_solid(name, files.solid_front)) solids.insert(std::move(name));
  }
  return solids;
}

std::uint64_t bytes_of_file(const fs::path& file) {
  std::error_code error;
  const std::uint64_t bytes = fs::file_size(file, error);
  return error ? 0 : bytes;
}

std::uint64_t bytes_of_solids(const SessionFiles& files) {
  std::uint64_t bytes = 0;
  for (const std::string& name : solids_beside(files)) {
    bytes += bytes_of_file(files.project.parent_path() / name);
  }
  return bytes;
}

Result<void> remove_solids(const SessionFiles& files, const std::set<std::string>& wanted) {
  const fs::path folder = files.project.parent_path();
  const std::vector<std::string> names = names_in(folder);
  const std::string aside = files.journal.filename().string() + ".";
  for (const std::string& name : names) {
    // A journal that was put aside may name any of them.
    if (name.starts_with(aside)) return {};
  }
  for (const std::string& name : names) {
    if (!is_solid(name, files.solid_front) || wanted.contains(name)) continue;
    if (auto removed = remove_if_there(folder / name); !removed) return removed;
  }
  return {};
}

Result<void> remove_kept_aside(const SessionFiles& files) {
  const fs::path folder = files.project.parent_path();
  const std::string journal = files.journal.filename().string() + ".";
  const std::string origin = files.origin.filename().string() + ".";
  for (const std::string& name : names_in(folder)) {
    if (!name.starts_with(journal) && !name.starts_with(origin)) continue;
    if (auto removed = remove_if_there(folder / name); !removed) return removed;
  }
  return {};
}

void remove_stale_temporaries(const SessionFiles& files) {
  const fs::path folder = files.project.parent_path();
  for (const std::string& name : names_in(folder)) {
    const fs::path solid = solid_of_temporary(name, files.solid_front);
    for (const fs::path* target :
         {&files.project, &files.journal, &files.autosave, &files.origin, &solid}) {
      // One that stays behind only takes space.
      if (is_dead(maker_of(name, *target))) static_cast<void>(::unlink((folder / name).c_str()));
    }
  }
}

}  // namespace argil::io
