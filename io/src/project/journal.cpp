// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of a journal, line by line up to the first that is not whole.
#include "project/journal.h"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <system_error>
#include <utility>

#include "argil/core/no_throw.h"

#include "file/file_bytes.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

void take_line(ScriptLine line, std::uint64_t end, Journal& journal) {
  if (auto* step = std::get_if<ScriptStep>(&line)) {
    journal.steps.push_back(std::move(*step));
    assert(journal.ends.empty() || end > journal.ends.back());
    journal.ends.push_back(end);
  } else {
    journal.marks.push_back(std::get<HashMark>(std::move(line)));
  }
}

/// One whole line into `journal`, which is unchanged on an error.
Result<void> read_journal_line(const FileLine& where, std::string_view line, std::uint64_t end,
                               SolidReader& solids, Journal& journal) {
  if (!is_sealed(line)) return where.error("has no 'xxh64' at its end");
  if (where.line > 1) {
    auto read = read_script_line(where, line, solids);
    if (!read) return read.error();
    const auto* mark = std::get_if<HashMark>(&read.value());
    if (mark != nullptr && mark->after > journal.steps.size()) {
      return where.key_error("after", "names a step that is not there");
    }
    take_line(std::move(read).value(), end, journal);
    return {};
  }
  const auto header = read_header_line(where, line);
  if (!header) return header.error();
  if (header.value().base_hash.empty()) return where.key_error("base_hash", "is missing");
  journal.base_hash = header.value().base_hash;
  return {};
}

/// So that a file which is not ours is never taken for a journal cut off in its first line.
bool begins_as_header(std::string_view text) {
  constexpr std::string_view kBegin = "{\"argil_strokes\":";
  return text.substr(0, kBegin.size()) == kBegin.substr(0, text.size());
}

Result<Journal> parse_journal(const fs::path& file, std::string_view text) {
  Journal journal;
  FileLine where{file.string(), 0};
  SolidReader solids(file.parent_path());
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
    if (auto read = read_journal_line(where, line, end, solids, journal); !read) {
      // What another try may bring is no reason to go on without it.
      if (read.error().kind != ErrorKind::bad_input) return read.error();
      // A last line may be whole in length and still not in content: its blocks reach the disk in
      // any order, and nobody was told that it is safe.
      journal.torn = end == text.size() && where.line > 1 && !has_whole_seal(line);
      if (!journal.torn) journal.damage = read.error().message;
      break;
    }
    journal.whole_bytes = end;
  }
  assert(journal.ends.size() == journal.steps.size() && journal.whole_bytes <= text.size());
  journal.solids = solids.files();
  return journal;
}

}  // namespace

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

Result<std::optional<Journal>> read_journal(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::optional<Journal>> {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return std::optional<Journal>{};
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    auto journal = parse_journal(
        file, {reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()});
    if (!journal) return journal.error();
    return std::optional<Journal>(std::move(journal).value());
  });
}

}  // namespace argil::io
