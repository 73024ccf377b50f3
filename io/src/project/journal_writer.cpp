// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a journal on a thread of its own: lines that wait together share one sync.
#include "project/journal_writer.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "argil/core/end_slot.h"

#include "file/file_bytes.h"

namespace argil::io {
namespace {

/// 0 or the error.
int write_all(int handle, const std::string& text, std::uint64_t offset) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t got = ::pwrite(handle, text.data() + written, text.size() - written,
                                 static_cast<off_t>(offset + written));
    if (got < 0 && errno == EINTR) continue;
    // Nothing written and no error: there is no space.
    if (got <= 0) return got < 0 ? errno : ENOSPC;
    written += static_cast<std::size_t>(got);
  }
  return 0;
}

/// So that the name of a new file is on the disk too. 0 or the error.
int sync_folder(const std::filesystem::path& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return errno;
  // EINVAL: some network file systems cannot sync folders.
  const int failed_with = ::fsync(handle) == 0 || errno == EINVAL ? 0 : errno;
  ::close(handle);
  return failed_with;
}

}  // namespace

JournalWriter::JournalWriter(Start start)
    : file_(std::move(start.file)),
      header_(start.good_bytes == 0 ? start.header + "\n" : ""),
      queue_lines_(start.queue_lines),
      durable_(start.good_bytes),
      thread_([this] { run(); }) {}

JournalWriter::~JournalWriter() {
  {
    const std::lock_guard held(mutex_);
    stop_ = true;
    try_again_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (handle_ >= 0) ::close(handle_);
}

void JournalWriter::push_step(std::string line, std::function<Result<void>()> before) {
  push({std::move(line), true, std::move(before)});
}

void JournalWriter::push_mark(std::string line) { push({std::move(line), false, {}}); }

void JournalWriter::push(Waiting line) {
  assert(!line.line.empty() && line.line.find('\n') == std::string::npos);
  line.line += '\n';
  std::unique_lock held(mutex_);
  done_.wait(held, [&] { return waiting_.size() < queue_lines_ || !state_; });
  waiting_.push_back(std::move(line));
  try_again_ = true;
  wake_.notify_one();
}

Result<void> JournalWriter::flush() {
  std::unique_lock held(mutex_);
  const std::uint64_t next = started_ + 1;
  try_again_ = true;
  wake_.notify_one();
  done_.wait(held, [&] { return waiting_.empty() || (!state_ && finished_ >= next); });
  if (waiting_.empty()) return {};
  return state_;
}

Result<void> JournalWriter::state() const {
  const std::lock_guard held(mutex_);
  return state_;
}

std::uint64_t JournalWriter::durable_bytes() const {
  const std::lock_guard held(mutex_);
  return durable_;
}

std::size_t JournalWriter::waiting_steps() const {
  const std::lock_guard held(mutex_);
  return static_cast<std::size_t>(std::ranges::count_if(waiting_, &Waiting::is_step));
}

void JournalWriter::run() {
  std::unique_lock held(mutex_);
  while (true) {
    wake_.wait(held, [&] { return stop_ || (try_again_ && !waiting_.empty()); });
    if (!waiting_.empty()) attempt(held);
    if (stop_ && (waiting_.empty() || !state_)) return;
  }
}

/// All lines up to one that must wait for what it names; that one with those after it next time.
void JournalWriter::attempt(std::unique_lock<std::mutex>& held) {
  assert(held.owns_lock() && !waiting_.empty());
  std::string text = durable_ == 0 ? header_ : "";
  std::size_t lines = 0;
  while (lines < waiting_.size() && (lines == 0 || !waiting_[lines].before)) {
    text += waiting_[lines++].line;
  }
  // Copied, since the queue may grow while the lock is given up.
  const auto before = waiting_.front().before;
  const std::uint64_t offset = durable_;
  try_again_ = false;
  ++started_;
  held.unlock();
  Result<void> written;
  if (before) written = before();
  if (written) written = write_at(text, offset);
  held.lock();
  ++finished_;
  state_ = std::move(written);
  if (state_) {
    assert(lines > 0 && lines <= waiting_.size() && durable_ == offset);
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(lines));
    durable_ += text.size();
    try_again_ = true;  // for what came meanwhile
  }
  done_.notify_all();
}

Result<void> JournalWriter::write_at(const std::string& text, std::uint64_t offset) {
  // What a forced end has taken back must not come again.
  if (is_end_forced()) return disk_error("write", file_, EINTR);
  if (handle_ < 0) handle_ = ::open(file_.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (handle_ < 0) return disk_error("write", file_, errno);
  if (const int error = write_all(handle_, text, offset)) return disk_error("write", file_, error);
  // Enough, since it also syncs the length that reading needs.
  if (::fdatasync(handle_) != 0) return disk_error("write", file_, errno);
  if (folder_synced_) return {};
  if (const int error = sync_folder(file_.parent_path())) return disk_error("write", file_, error);
  folder_synced_ = true;
  return {};
}

}  // namespace argil::io
