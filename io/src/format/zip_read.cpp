// SPDX-License-Identifier: GPL-3.0-or-later
// ZIP archives that others made: no number of a record is used before it is checked against the
// bytes that there are.
#include "format/zip_read.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include <tbb/task_group.h>
#include <zlib.h>

#include "file/load_bytes.h"
#include "format/text_scan.h"

namespace argil::io {
namespace {

// Sizes and signatures of the records; offsets in the functions below are those of APPNOTE 4.3.
constexpr std::uint32_t kLocalMark = 0x04034b50;
constexpr std::uint32_t kEntryMark = 0x02014b50;
constexpr std::uint32_t kEndMark = 0x06054b50;
constexpr std::uint32_t kEnd64Mark = 0x06064b50;
constexpr std::uint32_t kLocator64Mark = 0x07064b50;
constexpr std::size_t kLocalBytes = 30;
constexpr std::size_t kEntryBytes = 46;
constexpr std::size_t kEndBytes = 22;
constexpr std::size_t kEnd64Bytes = 56;
constexpr std::size_t kLocator64Bytes = 20;
constexpr std::uint32_t kIn64 = 0xffffffff;  // the real value is in the ZIP64 record

/// `size` bytes from `at`, when they are all there.
std::optional<std::span<const std::byte>> slice(std::span<const std::byte> bytes, std::uint64_t at,
                                                std::uint64_t size) noexcept {
  if (at > bytes.size() || size > bytes.size() - at) return std::nullopt;
  return bytes.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
}

struct DirectoryRange {
  std::uint64_t at = 0;
  std::uint64_t bytes = 0;
  std::uint64_t entries = 0;
};

/// Byte of the end record, which may be followed by a comment of its own stated length only.
std::optional<std::size_t> find_end(std::span<const std::byte> archive) {
  // Its length has 16 bits.
  constexpr std::size_t kLongestComment = 65535;
  if (archive.size() < kEndBytes) return std::nullopt;
  const std::size_t last = archive.size() - kEndBytes;
  const std::size_t first = last - std::min(last, kLongestComment);
  for (std::size_t at = last + 1; at-- > first;) {
    if (load<std::uint32_t>(archive, at) == kEndMark &&
        at + kEndBytes + load<std::uint16_t>(archive, at + 20) == archive.size()) {
      return at;
    }
  }
  return std::nullopt;
}

std::optional<DirectoryRange> find_directory64(std::span<const std::byte> archive,
                                               std::size_t end) {
  if (end < kLocator64Bytes) return std::nullopt;
  const std::size_t locator = end - kLocator64Bytes;
  if (load<std::uint32_t>(archive, locator) != kLocator64Mark) return std::nullopt;
  const auto record = slice(archive, load<std::uint64_t>(archive, locator + 8), kEnd64Bytes);
  if (!record || load<std::uint32_t>(*record, 0) != kEnd64Mark) return std::nullopt;
  return DirectoryRange{load<std::uint64_t>(*record, 48), load<std::uint64_t>(*record, 40),
                        load<std::uint64_t>(*record, 32)};
}

/// Fills in what the fixed record left to its ZIP64 extra field. False when that is missing.
bool read_extra64(std::span<const std::byte> extra, ZipEntry& entry) {
  constexpr std::uint16_t kExtra64 = 1;
  while (extra.size() >= 4) {
    const auto field = slice(extra, 4, load<std::uint16_t>(extra, 2));
    if (!field) return false;
    if (load<std::uint16_t>(extra, 0) == kExtra64) {
      std::size_t at = 0;
      // In this order, and each only where the fixed record has all bits set (APPNOTE 4.5.3).
      for (std::uint64_t* value : {&entry.bytes, &entry.packed_bytes, &entry.header_at}) {
        if (*value != kIn64) continue;
        if (at + 8 > field->size()) return false;
        *value = load<std::uint64_t>(*field, at);
        at += 8;
      }
      return true;
    }
    extra = extra.subspan(4 + field->size());
  }
  return entry.bytes != kIn64 && entry.packed_bytes != kIn64 && entry.header_at != kIn64;
}

/// Reads one directory record off the front of `rest`.
std::optional<ZipEntry> take_entry(std::span<const std::byte>& rest) {
  if (rest.size() < kEntryBytes || load<std::uint32_t>(rest, 0) != kEntryMark) return std::nullopt;
  ZipEntry entry;
  entry.flags = load<std::uint16_t>(rest, 8);
  entry.method = load<std::uint16_t>(rest, 10);
  entry.crc = load<std::uint32_t>(rest, 16);
  entry.packed_bytes = load<std::uint32_t>(rest, 20);
  entry.bytes = load<std::uint32_t>(rest, 24);
  entry.header_at = load<std::uint32_t>(rest, 42);
  const std::size_t name_bytes = load<std::uint16_t>(rest, 28);
  const std::size_t extra_bytes = load<std::uint16_t>(rest, 30);
  const std::size_t comment_bytes = load<std::uint16_t>(rest, 32);
  const auto tail = slice(rest, kEntryBytes, name_bytes + extra_bytes + comment_bytes);
  if (!tail) return std::nullopt;
  entry.name = as_text(tail->first(name_bytes));
  if (!read_extra64(tail->subspan(name_bytes, extra_bytes), entry)) return std::nullopt;
  rest = rest.subspan(kEntryBytes + tail->size());
  return entry;
}

Error damaged(const std::string& name, const std::string& what) {
  return {ErrorKind::bad_input, name + ": " + what + "; the file is damaged, export it again"};
}

std::string entry_text(const ZipEntry& entry) { return "'" + entry.name + "' in its archive "; }

/// Deflate makes at most 258 bytes of two bits. The packed ones are in memory: no overflow.
bool can_unpack_to_its_size(const ZipEntry& entry) {
  constexpr std::uint64_t kMostPerByte = 1032;
  constexpr std::uint64_t kOfNothing = 64;
  return entry.bytes <= kMostPerByte * entry.packed_bytes + kOfNothing;
}

/// Whether each entry lies in the archive and none in another, of which small archives are made
/// that unpack to more than their bytes could say.
Result<void> check_extents(std::size_t archive_bytes, const std::vector<ZipEntry>& entries,
                           const std::string& name) {
  std::vector<const ZipEntry*> sorted;
  sorted.reserve(entries.size());
  for (const ZipEntry& entry : entries) sorted.push_back(&entry);
  std::sort(sorted.begin(), sorted.end(),
            [](const ZipEntry* a, const ZipEntry* b) { return a->header_at < b->header_at; });
  std::uint64_t end = 0;
  for (const ZipEntry* entry : sorted) {
    if (entry->header_at < end) return damaged(name, entry_text(*entry) + "lies within another");
    const std::uint64_t left = archive_bytes - std::min(entry->header_at, archive_bytes);
    if (left < kLocalBytes || entry->packed_bytes > left - kLocalBytes) {
      return damaged(name, entry_text(*entry) + "lies outside the file");
    }
    end = entry->header_at + kLocalBytes + entry->packed_bytes;
  }
  return {};
}

}  // namespace

Result<std::vector<ZipEntry>> zip_directory(std::span<const std::byte> archive,
                                            const std::string& name) {
  const std::optional<std::size_t> end = find_end(archive);
  if (!end) return damaged(name, "it is not a ZIP archive, or cut off");
  DirectoryRange range{load<std::uint32_t>(archive, *end + 16),
                       load<std::uint32_t>(archive, *end + 12),
                       load<std::uint16_t>(archive, *end + 10)};
  if (const auto range64 = find_directory64(archive, *end)) range = *range64;
  const auto directory = slice(archive, range.at, range.bytes);
  if (!directory) return damaged(name, "its archive directory lies outside the file");
  std::vector<ZipEntry> entries;
  std::span<const std::byte> rest = *directory;
  while (entries.size() < range.entries) {
    std::optional<ZipEntry> entry = take_entry(rest);
    if (!entry) return damaged(name, "its archive directory is not whole");
    entries.push_back(std::move(*entry));
  }
  if (auto placed = check_extents(archive.size(), entries, name); !placed) return placed.error();
  return entries;
}

struct ZipContent::State {
  State(std::span<const std::byte> packed_bytes, const ZipEntry& of, std::string file)
      : packed(packed_bytes), entry(of), name(std::move(file)) {
    // Negative window bits: raw deflate, without zlib's own header.
    is_damaged = entry.method != 0 && inflateInit2(&stream, -MAX_WBITS) != Z_OK;
    // zlib does not write through next_in; its type only lacks the const.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data()));
  }
  ~State() {
    ahead.cancel();
    ahead.wait();
    if (entry.method != 0) inflateEnd(&stream);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Up to `room` bytes to `to`; how many they were.
  std::size_t unpack(char* to, std::size_t room);
  /// The next piece to `next`, which is empty: nothing where there is no more, or it is damaged.
  void unpack_next();
  bool is_ended() const noexcept { return is_over || is_damaged; }

  std::span<const std::byte> packed;
  const ZipEntry& entry;
  std::string name;
  z_stream stream{};
  std::uint64_t taken = 0;
  std::uint32_t crc = 0;
  bool is_over = false;
  bool is_damaged = false;
  std::string next;
  mutable tbb::task_group ahead;  ///< what unpacks it; all others wait for that
};

std::size_t ZipContent::State::unpack(char* to, std::size_t room) {
  if (entry.method == 0) {
    const std::size_t size = std::min(room, packed.size() - static_cast<std::size_t>(taken));
    std::memcpy(to, packed.data() + taken, size);
    is_over = taken + size == packed.size();
    return size;
  }
  if (stream.avail_in == 0) {
    const std::size_t left = packed.size() - stream.total_in;
    // avail_in has 32 bits; an entry may be longer.
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(left, 1U << 30));
  }
  stream.next_out = reinterpret_cast<Bytef*>(to);
  stream.avail_out = static_cast<uInt>(room);
  const int state = inflate(&stream, Z_NO_FLUSH);
  is_over = state == Z_STREAM_END;
  is_damaged = state != Z_STREAM_END && state != Z_OK;
  return room - stream.avail_out;
}

ZipContent::ZipContent(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
ZipContent::ZipContent(ZipContent&&) noexcept = default;
ZipContent& ZipContent::operator=(ZipContent&&) noexcept = default;
ZipContent::~ZipContent() = default;

Result<ZipContent> ZipContent::open(std::span<const std::byte> archive, const ZipEntry& entry,
                                    const std::string& name) {
  const std::string what = entry_text(entry);
  if ((entry.flags & 1U) != 0) {
    return Error{ErrorKind::bad_input,
                 name + ": " + what + "is encrypted; save it without a password"};
  }
  const auto local = slice(archive, entry.header_at, kLocalBytes);
  if (!local || load<std::uint32_t>(*local, 0) != kLocalMark) {
    return damaged(name, what + "has no header");
  }
  // The local header has a name and an extra field of lengths of its own.
  const std::uint64_t data_at = entry.header_at + kLocalBytes + load<std::uint16_t>(*local, 26) +
                                load<std::uint16_t>(*local, 28);
  const auto packed = slice(archive, data_at, entry.packed_bytes);
  if (!packed) return damaged(name, what + "is cut off");
  if (entry.method != 8 && (entry.method != 0 || entry.bytes != entry.packed_bytes)) {
    return Error{ErrorKind::bad_input, name + ": " + what + "is packed by method " +
                                           std::to_string(entry.method) + "; save it with deflate"};
  }
  if (!can_unpack_to_its_size(entry)) {
    return damaged(name, what + "says that its " + std::to_string(entry.packed_bytes) +
                             " bytes unpack to " + std::to_string(entry.bytes) +
                             ", which none can");
  }
  return ZipContent(std::make_unique<State>(*packed, entry, name));
}

void ZipContent::State::unpack_next() {
  assert(next.empty());
  while (next.empty() && !is_ended()) {
    next.resize(kPieceBytes);
    const std::size_t size = unpack(next.data(), next.size());
    next.resize(size);
    crc =
        static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(next.data()), size));
    taken += size;
    if (taken > entry.bytes) is_damaged = true;
  }
}

bool ZipContent::take(std::string& text) {
  State& state = *state_;
  state.ahead.wait();
  if (state.next.empty()) state.unpack_next();
  if (state.next.empty()) return false;
  text += state.next;
  state.next.clear();
  if (!state.is_ended()) state.ahead.run([&state] { state.unpack_next(); });
  return true;
}

Result<void> ZipContent::check() const {
  const State& state = *state_;
  state.ahead.wait();
  const bool is_wrong =
      state.is_over && (state.taken != state.entry.bytes || state.crc != state.entry.crc);
  if (!state.is_damaged && !is_wrong) return {};
  return damaged(state.name, entry_text(state.entry) + "does not unpack");
}

}  // namespace argil::io
