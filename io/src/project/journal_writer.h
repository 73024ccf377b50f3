// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "argil/core/result.h"

namespace argil::io {

/// Appends lines to a journal on a thread of its own, each synced before the next is awaited.
///
/// A line stays in memory until the disk has it. When writing or syncing fails, everything since
/// the last success is written again, at the same offset, at the next push or flush: a failed sync
/// may have lost pages that look written.
///
/// Threads  one caller; what `push` waits for is at most room in the queue, and that only while the
///          disk works.
class JournalWriter {
 public:
  struct Start {
    std::filesystem::path file;
    std::string header;            ///< line to begin a new file with; made with the first line
    std::uint64_t good_bytes = 0;  ///< 0: a new file; else where an old one goes on
    std::size_t queue_lines = 64;
  };
  explicit JournalWriter(Start start);
  /// Tries once more to write what waits.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// Hands the line of a step over, without its line end. `before` brings what the line names to
  /// the disk, on the writing thread; while it fails, neither its line nor one after it is written.
  /// Tried again like a line, also after it succeeded.
  void push_step(std::string line, std::function<Result<void>()> before = {});
  /// The line of a mark, likewise.
  void push_mark(std::string line);

  /// Waits until every line pushed before is on the disk, or until an attempt that began after this
  /// call has failed.
  /// Errors  disk: the reason of that failure; the lines are kept.
  Result<void> flush();

  /// How the last attempt ended.
  Result<void> state() const;

  /// Of the file, that are on the disk.
  std::uint64_t durable_bytes() const;

  /// Steps that are not on the disk yet.
  std::size_t waiting_steps() const;

 private:
  struct Waiting {
    std::string line;
    bool is_step = false;
    std::function<Result<void>()> before;
  };
  void push(Waiting line);
  void run();
  void attempt(std::unique_lock<std::mutex>& held);
  Result<void> write_at(const std::string& text, std::uint64_t offset);

  const std::filesystem::path file_;
  const std::string header_;
  const std::size_t queue_lines_;
  int handle_ = -1;             // of the writing thread
  bool folder_synced_ = false;  // of the writing thread

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  std::deque<Waiting> waiting_;
  std::uint64_t durable_ = 0;
  std::uint64_t started_ = 0;   // attempts
  std::uint64_t finished_ = 0;  // attempts
  Result<void> state_;          // how the last attempt ended
  bool try_again_ = false;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace argil::io
