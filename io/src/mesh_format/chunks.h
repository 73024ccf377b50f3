// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_file.h"

#include "file/unwritten_bytes.h"

namespace argil::io {

/// Text and bytes that grow at their end.
class Piece {
 public:
  Piece& text(std::string_view words) {
    std::memcpy(room(words.size()), words.data(), words.size());
    size_ += words.size();
    return *this;
  }
  /// A number in its shortest form.
  template <class Number>
  Piece& number(Number value) {
    constexpr std::size_t kLongest = 32;
    char* const at = room(kLongest);
    size_ += static_cast<std::size_t>(std::to_chars(at, at + kLongest, value).ptr - at);
    return *this;
  }
  template <class T>
  Piece& raw(const T& value) {
    std::memcpy(room(sizeof value), &value, sizeof value);
    size_ += sizeof value;
    return *this;
  }

  std::string_view all() const noexcept { return {bytes_.data(), size_}; }
  void clear() noexcept { size_ = 0; }

 private:
  char* room(std::size_t size) {
    if (bytes_.size() - size_ < size) bytes_.resize(2 * bytes_.size() + size + 4096);
    return bytes_.data() + size_;
  }
  UnwrittenText bytes_;
  std::size_t size_ = 0;
};

/// Items are made into pieces of a file so many at a time. The bytes of some formats depend on it.
inline constexpr std::size_t kItemsInPiece = 8192;

/// The items of a piece.
struct ItemRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Makes pieces of `count` items by make(range, maker) on all threads, each with a Maker that keeps
/// its memory, and uses them by use(range, maker) on this one, in their order: memory is that of a
/// few. False when use() says that it shall stop.
template <class Maker, class Make, class Use>
bool make_in_order(std::size_t count, const Make& make, const Use& use) {
  constexpr std::size_t kAtOnce = 16;
  std::vector<Maker> makers(std::min(kAtOnce, (count + kItemsInPiece - 1) / kItemsInPiece));
  const auto range_at = [&](std::size_t first, std::size_t piece) {
    const std::size_t begin = first + piece * kItemsInPiece;
    return ItemRange{begin, std::min(begin + kItemsInPiece, count)};
  };
  for (std::size_t first = 0; first < count; first += kAtOnce * kItemsInPiece) {
    const std::size_t left = (count - first + kItemsInPiece - 1) / kItemsInPiece;
    const std::size_t pieces = std::min(left, makers.size());
    tbb::parallel_for(std::size_t{0}, pieces,
                      [&](std::size_t piece) { make(range_at(first, piece), makers[piece]); });
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      if (!use(range_at(first, piece), makers[piece])) return false;
    }
  }
  return true;
}

/// Gathers small pieces of text or bytes and hands them on in large ones, asking now and then
/// whether to go on.
class Chunks {
 public:
  Chunks(std::function<void(std::string_view)> sink, const Progress& progress, std::size_t steps)
      : sink_(std::move(sink)), progress_(progress), steps_(steps) {}

  Chunks& text(std::string_view words) {
    piece_.text(words);
    return *this;
  }
  template <class Number>
  Chunks& number(Number value) {
    piece_.number(value);
    return *this;
  }
  template <class T>
  Chunks& raw(const T& value) {
    piece_.raw(value);
    return *this;
  }

  /// After each item, or so many. False when the writing shall stop.
  bool step(std::size_t items = 1) {
    done_ += items;
    if (piece_.all().size() < kChunk) return !stopped_;
    flush();
    return ask();
  }
  /// After `items` that went past this, to where it goes.
  bool step_past(std::size_t items) {
    assert(piece_.all().empty());
    done_ += items;
    return ask();
  }
  void flush() {
    sink_(piece_.all());
    piece_.clear();
  }
  /// What was made elsewhere, behind all that was given before.
  bool pass_on(std::string_view made, std::size_t items) {
    sink_(made);
    return step_past(items);
  }

 private:
  bool ask() {
    stopped_ = stopped_ ||
               (progress_ && !progress_("write", static_cast<double>(done_) /
                                                     static_cast<double>(std::max(steps_, done_))));
    return !stopped_;
  }

  static constexpr std::size_t kChunk = std::size_t{1} << 18;
  std::function<void(std::string_view)> sink_;
  const Progress& progress_;
  std::size_t steps_;
  std::size_t done_ = 0;
  bool stopped_ = false;
  Piece piece_;
};

inline Error writing_stopped() {
  return {ErrorKind::interrupted, "interrupted while writing a mesh"};
}

/// Writes every item by one(item, piece), which may run on any thread, in their order; stops when
/// the reader of the progress asks for it.
template <class Items, class One>
Result<void> write_each(Chunks& chunks, const Items& items, const One& one) {
  chunks.flush();
  const auto make = [&](const ItemRange& range, Piece& piece) {
    piece.clear();
    for (std::size_t i = range.begin; i < range.end; ++i) one(items[i], piece);
  };
  const auto use = [&](const ItemRange& range, const Piece& piece) {
    return chunks.pass_on(piece.all(), range.end - range.begin);
  };
  if (!make_in_order<Piece>(items.size(), make, use)) return writing_stopped();
  return {};
}

// The mesh formats, each with its own writer. Coordinates are rounded to float on the way; the same
// mesh gives the same bytes. What is written fits the format (write_format).
//
// Errors   bad_input where the format cannot hold so much; interrupted. Disk errors stay with the
//          file.
Result<void> write_obj(Chunks& chunks, const TriangleMesh& mesh);
Result<void> write_ply(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options);
Result<void> write_stl(Chunks& chunks, const TriangleMesh& mesh);
Result<void> write_glb(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options);

}  // namespace argil::io
