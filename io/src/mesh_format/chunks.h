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

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_file.h"

namespace argil::io {

/// Gathers small pieces of text or bytes and hands them on in large ones, asking now and then
/// whether to go on.
class Chunks {
 public:
  Chunks(std::function<void(std::string_view)> sink, const Progress& progress, std::size_t steps)
      : sink_(std::move(sink)), progress_(progress), steps_(steps) {
    buffer_.reserve(kChunk + kLongestStep);
  }

  Chunks& text(std::string_view piece) {
    buffer_.append(piece);
    return *this;
  }
  template <class Number>
  Chunks& number(Number value) {
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    buffer_.append(digits.data(), end);
    return *this;
  }
  template <class T>
  Chunks& raw(const T& value) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    buffer_.append(bytes.data(), bytes.size());
    return *this;
  }

  /// After each vertex or triangle. False when the writing shall stop.
  bool step() {
    ++done_;
    if (buffer_.size() < kChunk) return !stopped_;
    flush();
    stopped_ = progress_ && !progress_("write", static_cast<double>(done_) /
                                                    static_cast<double>(std::max(steps_, done_)));
    return !stopped_;
  }
  void flush() {
    sink_(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 18;
  static constexpr std::size_t kLongestStep = 512;
  std::function<void(std::string_view)> sink_;
  const Progress& progress_;
  std::size_t steps_;
  std::size_t done_ = 0;
  bool stopped_ = false;
  std::string buffer_;
};

inline Error writing_stopped() {
  return {ErrorKind::interrupted, "interrupted while writing a mesh"};
}

/// Calls `one` for every item, stopping when the reader of the progress asks for it.
template <class Items, class One>
Result<void> write_each(Chunks& chunks, const Items& items, const One& one) {
  for (const auto& item : items) {
    one(item);
    if (!chunks.step()) return writing_stopped();
  }
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
