// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of a journal, line by line up to the first that is not whole.
#include "project/journal.h"

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>

#include "argil/core/no_throw.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

void take_line(ScriptLine line, std::uint64_t begin, Journal& journal) {
  if (auto* step = std::get_if<ScriptStep>(&line)) {
    journal.steps.push_back(std::move(*step));
    assert(journal.begins.empty() || begin >= journal.begins.back());
    journal.begins.push_back(begin);
  } else {
    journal.marks.push_back(std::get<HashMark>(std::move(line)));
    // Only what is kept gets such a mark, though a session that keeps none may have begun it.
    if (journal.marks.back().is_closing) journal.keeps_history = true;
  }
}

Result<void> read_journal_header(const FileLine& where, std::string_view line, Journal& journal) {
  const auto header = read_header_line(where, line);
  if (!header) return header.error();
  if (header.value().base_hash.empty()) return where.key_error("base_hash", "is missing");
  journal.base_hash = header.value().base_hash;
  journal.keeps_history = header.value().keeps_history;
  return {};
}

/// One whole line into `journal`, which is unchanged on an error.
Result<void> read_journal_line(const FileLine& where, std::string_view line, SolidReader& solids,
                               Journal& journal) {
  if (!is_sealed(line)) return where.error("has no 'xxh64' at its end");
  if (where.line == 1) return read_journal_header(where, line, journal);
  auto read = read_script_line(where, line, solids);
  if (!read) return read.error();
  const auto* mark = std::get_if<HashMark>(&read.value());
  if (mark != nullptr && mark->after > journal.steps.size()) {
    return where.key_error("after", "names a step that is not there");
  }
  take_line(std::move(read).value(), journal.whole_bytes, journal);
  return {};
}

/// As mark_line writes it; no other line begins so.
bool is_mark(std::string_view line) { return line.starts_with("{\"hash\":"); }

/// The mark whose steps need not be read: where its line ends, and how many they are.
struct KnownMark {
  std::uint64_t end = 0;
  std::size_t after = 0;
};

/// The latest mark of a hash, or nothing before the first line.
KnownMark find_known(const fs::path& file, std::string_view text, const std::string& hash) {
  KnownMark known;
  SolidReader no_solids(file.parent_path());
  for (std::size_t begin = 0; !hash.empty();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) break;
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (!is_mark(line) || line.find(hash) == std::string_view::npos || !has_whole_seal(line)) {
      continue;
    }
    const auto read = read_script_line({file.string(), 0}, line, no_solids);
    const auto* mark = read ? std::get_if<HashMark>(&read.value()) : nullptr;
    if (mark != nullptr && mark->hash == hash && mark->after >= known.after) {
      known = {begin, mark->after};
    }
  }
  return known;
}

/// After how many steps a session has ended in order, by marks that are whole, also behind damage:
/// what is wrong with steps must not hide that none were left.
std::size_t last_closing(const fs::path& file, std::string_view text) {
  std::size_t closed = 0;
  SolidReader no_solids(file.parent_path());
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return closed;
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (!is_mark(line) || !has_whole_seal(line)) continue;
    const auto read = read_script_line({file.string(), 0}, line, no_solids);
    const auto* mark = read ? std::get_if<HashMark>(&read.value()) : nullptr;
    if (mark != nullptr && mark->is_closing) closed = std::max(closed, mark->after);
  }
}

/// Whether a line lies before the known mark and among its steps.
bool is_counted(const KnownMark& known, std::uint64_t end, const Journal& journal) {
  return end <= known.end && (!journal.hole.empty() || journal.steps.size() < known.after);
}

/// Such a line: a step is only counted. What is wrong there is a hole, which hides how many steps
/// it holds; the mark says it.
Result<void> count_line(const FileLine& where, std::string_view line, SolidReader& solids,
                        Journal& journal) {
  Result<void> read;
  if (where.line == 1 || is_mark(line)) {
    read = read_journal_line(where, line, solids, journal);
    if (!read && read.error().kind != ErrorKind::bad_input) return read;
  } else {
    if (!has_whole_seal(line)) read = where.error("is not whole");
    take_line(ScriptStep(Stroke()), journal.whole_bytes, journal);
  }
  if (!read && journal.hole.empty()) journal.hole = read.error().message;
  return {};
}

/// Once the known mark is behind, or what is behind its steps is damaged. Those behind a hole are
/// counted anew.
void end_of_counting(const KnownMark& known, const std::string& hash, Journal& journal) {
  journal.first_read = known.after;
  if (!journal.hole.empty()) {
    journal.steps.resize(known.after);
    journal.begins.resize(known.after, journal.whole_bytes);
    journal.marks.clear();
  }
  journal.marks.push_back({hash, known.after});
}

/// So that a file which is not ours is never taken for a journal cut off in its first line.
bool begins_as_header(std::string_view text) {
  constexpr std::string_view kBegin = "{\"argil_strokes\":";
  return text.substr(0, kBegin.size()) == kBegin.substr(0, text.size());
}

/// A line that cannot be read, where the journal ends: cut off, or damaged.
Result<void> end_at(const FileLine& where, std::string_view line, const Error& error, bool is_last,
                    Journal& journal) {
  // What another try may bring is no reason to go on without it.
  if (error.kind != ErrorKind::bad_input) return error;
  // A last line may be whole in length and still not in content: its blocks reach the disk in any
  // order, and nobody was told that it is safe.
  journal.torn = is_last && where.line > 1 && !has_whole_seal(line);
  if (!journal.torn) journal.damage = error.message;
  return {};
}

}  // namespace

Result<Journal> parse_journal(const fs::path& file, std::string_view text,
                              const std::string& known_hash) {
  Journal journal;
  FileLine where{file.string(), 0};
  SolidReader solids(file.parent_path());
  const KnownMark known = find_known(file, text, known_hash);
  while (journal.whole_bytes < text.size()) {
    ++where.line;
    const std::string_view rest = text.substr(journal.whole_bytes);
    const std::size_t length = rest.find('\n');
    if (length == std::string_view::npos) {
      journal.torn = where.line > 1 || begins_as_header(rest);
      if (!journal.torn) journal.damage = where.error("is not the header of a journal").message;
      break;
    }
    const std::uint64_t end = journal.whole_bytes + length + 1;
    const std::string_view line = rest.substr(0, length);
    const bool counts = is_counted(known, end, journal);
    auto read = counts ? count_line(where, line, solids, journal)
                       : read_journal_line(where, line, solids, journal);
    if (!read) {
      if (counts) return read.error();
      if (auto ended = end_at(where, line, read.error(), end == text.size(), journal); !ended) {
        return ended.error();
      }
      break;
    }
    journal.whole_bytes = end;
    if (end == known.end) end_of_counting(known, known_hash, journal);
  }
  if (journal.whole_bytes < known.end) end_of_counting(known, known_hash, journal);
  assert(journal.begins.size() == journal.steps.size() && journal.whole_bytes <= text.size());
  assert(journal.first_read <= journal.steps.size());
  journal.solids = solids.files();
  journal.closed_after = last_closing(file, text);
  return journal;
}

std::vector<std::size_t> Journal::positions_of(const std::string& hash) const {
  std::vector<std::size_t> positions;
  if (!base_hash.empty() && base_hash == hash) positions.push_back(0);
  for (const HashMark& mark : marks) {
    if (mark.hash == hash) positions.push_back(mark.after);
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

std::optional<std::size_t> Journal::position_of(const std::string& hash) const {
  const std::vector<std::size_t> positions = positions_of(hash);
  if (positions.empty()) return std::nullopt;
  return positions.back();
}

std::optional<std::size_t> Journal::position_of_project(const std::string& hash) const {
  const auto position = position_of(hash);
  return closed_after > position.value_or(0) ? std::nullopt : position;
}

Result<std::optional<UnwrittenBytes>> read_journal_bytes(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::optional<UnwrittenBytes>> {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return std::optional<UnwrittenBytes>();
    auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    return std::optional<UnwrittenBytes>(std::move(bytes).value());
  });
}

Result<std::optional<Journal>> read_journal(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::optional<Journal>> {
    const auto bytes = read_journal_bytes(file);
    if (!bytes) return bytes.error();
    if (!bytes.value()) return std::optional<Journal>();
    auto journal = parse_journal(file, text_of(*bytes.value()));
    if (!journal) return journal.error();
    return std::optional<Journal>(std::move(journal).value());
  });
}

}  // namespace argil::io
