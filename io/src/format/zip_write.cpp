// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/zip_write.h"

#include <array>
#include <cassert>
#include <limits>
#include <new>

#include <zlib.h>

namespace argil::io {
namespace {

// The fastest, of whose four settings one place where a match may begin is enough for lines that
// are like the line before, and matches of up to 32 bytes are worth noting: an eighth faster than
// zlib's own choice for that level, and a tenth smaller.
constexpr int kLevel = 1;
constexpr int kGoodMatch = 4;
constexpr int kNotedMatch = 32;
constexpr int kNiceMatch = 32;
constexpr int kChain = 1;
constexpr std::size_t kPackedChunk = std::size_t{1} << 16;
constexpr std::uint32_t kDosEpoch = 0x00210000;  // 1980-01-01 00:00

/// Little-endian record under construction.
class Record {
 public:
  Record& u16(std::uint64_t value) { return bytes(value, 2); }
  Record& u32(std::uint64_t value) { return bytes(value, 4); }
  Record& text(std::string_view value) {
    data_.append(value);
    return *this;
  }
  std::string_view data() const noexcept { return data_; }

 private:
  Record& bytes(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) data_ += static_cast<char>((value >> (8 * i)) & 0xffU);
    return *this;
  }
  std::string data_;
};

std::unique_ptr<z_stream_s> begun_stream() {
  auto stream = std::make_unique<z_stream_s>();
  if (deflateInit2(stream.get(), kLevel, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  return stream;
}

void restart(z_stream_s& stream) {
  deflateReset(&stream);
  deflateTune(&stream, kGoodMatch, kNotedMatch, kNiceMatch, kChain);
}

/// zlib does not write through next_in; its type only lacks the const.
Bytef* input_of(std::string_view data) noexcept {
  return reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
}

constexpr unsigned kVersion = 20;  // deflate
constexpr unsigned kDeflated = 8;

}  // namespace

std::uint32_t crc_of(std::string_view data) noexcept {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(data.data()), data.size()));
}

Deflater::Deflater() : stream_(begun_stream()) {}
Deflater::~Deflater() { deflateEnd(stream_.get()); }

std::string_view Deflater::packed(std::string_view text) {
  restart(*stream_);
  // The bound is of a stream's end; what ends at a byte and goes on takes five bytes more.
  packed_.resize(deflateBound(stream_.get(), static_cast<uLong>(text.size())) + 5);
  stream_->next_in = input_of(text);
  stream_->avail_in = static_cast<uInt>(text.size());
  stream_->next_out = reinterpret_cast<Bytef*>(packed_.data());
  stream_->avail_out = static_cast<uInt>(packed_.size());
  deflate(stream_.get(), Z_SYNC_FLUSH);
  assert(stream_->avail_in == 0 && stream_->avail_out > 0);
  return {packed_.data(), packed_.size() - stream_->avail_out};
}

ZipWriter::ZipWriter(OutputFile& out) : out_(out), stream_(begun_stream()), packed_(kPackedChunk) {}

ZipWriter::~ZipWriter() { deflateEnd(stream_.get()); }

void ZipWriter::begin(const std::string& name) {
  Entry entry;
  entry.name = name;
  entry.at = out_.position();
  entries_.push_back(entry);
  // Sizes and CRC follow in end().
  // Local header (APPNOTE 4.3.7).
  out_.write(Record{}.u32(0x04034b50).u16(kVersion).u16(0).u16(kDeflated).u32(kDosEpoch).data());
  out_.write(Record{}.u32(0).u32(0).u32(0).u16(name.size()).u16(0).text(name).data());
  restart(*stream_);
  is_at_byte_ = true;
}

void ZipWriter::deflate_input(int flush) {
  do {
    stream_->next_out = packed_.data();
    stream_->avail_out = static_cast<uInt>(packed_.size());
    deflate(stream_.get(), flush);
    out_.write(packed_.data(), packed_.size() - stream_->avail_out);
  } while (stream_->avail_out == 0);
}

void ZipWriter::write(std::string_view data) {
  Entry& entry = entries_.back();
  Bytef* const bytes = input_of(data);
  entry.crc = static_cast<std::uint32_t>(crc32_z(entry.crc, bytes, data.size()));
  entry.bytes += data.size();
  stream_->next_in = bytes;
  stream_->avail_in = static_cast<uInt>(data.size());
  deflate_input(Z_NO_FLUSH);
  is_at_byte_ = false;
}

void ZipWriter::write_deflated(std::string_view packed, std::size_t bytes, std::uint32_t crc) {
  // Full: zlib refers to nothing before, where it does not know what was added.
  if (!is_at_byte_) deflate_input(Z_FULL_FLUSH);
  is_at_byte_ = true;
  out_.write(packed);
  Entry& entry = entries_.back();
  entry.bytes += bytes;
  entry.crc =
      static_cast<std::uint32_t>(crc32_combine(entry.crc, crc, static_cast<z_off_t>(bytes)));
}

Result<void> ZipWriter::end() {
  deflate_input(Z_FINISH);
  Entry& entry = entries_.back();
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t end = out_.position();
  // The local header takes 30 bytes and the name.
  entry.packed_bytes = end - entry.at - 30 - entry.name.size();
  if (entry.bytes >= kMost || end >= kMost) {
    return Error{ErrorKind::bad_input,
                 "an entry of the archive takes 4 GB or more; write .stl or .ply"};
  }
  constexpr std::uint64_t kCrcAt = 14;
  out_.seek(entry.at + kCrcAt);
  out_.write(Record{}.u32(entry.crc).u32(entry.packed_bytes).u32(entry.bytes).data());
  out_.seek(end);
  return {};
}

void ZipWriter::finish() {
  const std::uint64_t begin = out_.position();
  for (const Entry& e : entries_) {
    Record record;
    // Central directory header (APPNOTE 4.3.12).
    record.u32(0x02014b50).u16(kVersion).u16(kVersion).u16(0).u16(kDeflated).u32(kDosEpoch);
    record.u32(e.crc).u32(e.packed_bytes).u32(e.bytes).u16(e.name.size());
    record.u16(0).u16(0).u16(0).u16(0).u32(0).u32(e.at).text(e.name);
    out_.write(record.data());
  }
  const std::uint64_t bytes = out_.position() - begin;
  Record end;
  // End of central directory record (APPNOTE 4.3.16).
  end.u32(0x06054b50).u16(0).u16(0).u16(entries_.size()).u16(entries_.size());
  out_.write(end.u32(bytes).u32(begin).u16(0).data());
}

}  // namespace argil::io
