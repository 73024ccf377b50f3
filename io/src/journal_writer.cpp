// SPDX-License-Identifier: GPL-3.0-or-later
#include "journal_writer.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "file_bytes.h"

namespace argil::io {
namespace {

/// 0 or the error.
int write_all(int handle, const std::string& text, std::uint64_t offset) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t got = ::pwrite(handle, text.data() + written, text.size() - written,
                                 static_cast<off_t>(offset + written));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return got < 0 ? errno : ENOSPC;
    written += static_cast<std::size_t>(got);
  }
  return 0;
}

/// So that the name of a new file is on the disk too. 0 or the error.
int sync_folder(const std::filesystem::path& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return errno;
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

void JournalWriter::push(std::string line) {
  std::unique_lock held(mutex_);
  done_.wait(held, [&] { return waiting_.size() < queue_lines_ || failed_with_ != 0; });
  waiting_.push_back(std::move(line.append("\n")));
  try_again_ = true;
  wake_.notify_one();
}

Result<void> JournalWriter::flush() {
  std::unique_lock held(mutex_);
  const std::uint64_t next = started_ + 1;
  try_again_ = true;
  wake_.notify_one();
  done_.wait(held, [&] { return waiting_.empty() || (failed_with_ != 0 && finished_ >= next); });
  if (waiting_.empty()) return {};
  return disk_error("write", file_, failed_with_);
}

Result<void> JournalWriter::state() const {
  const std::lock_guard held(mutex_);
  if (failed_with_ == 0) return {};
  return disk_error("write", file_, failed_with_);
}

void JournalWriter::run() {
  std::unique_lock held(mutex_);
  while (true) {
    wake_.wait(held, [&] { return stop_ || (try_again_ && !waiting_.empty()); });
    if (!waiting_.empty()) attempt_all(held);
    if (stop_ && (waiting_.empty() || failed_with_ != 0)) return;
  }
}

void JournalWriter::attempt_all(std::unique_lock<std::mutex>& held) {
  std::string text = durable_ == 0 ? header_ : "";
  const std::size_t lines = waiting_.size();
  for (const std::string& line : waiting_) text += line;
  const std::uint64_t offset = durable_;
  try_again_ = false;
  ++started_;
  held.unlock();
  const int failed_with = write_at(text, offset);
  held.lock();
  ++finished_;
  failed_with_ = failed_with;
  if (failed_with == 0) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(lines));
    durable_ += text.size();
    try_again_ = true;  // for what came meanwhile
  }
  done_.notify_all();
}

int JournalWriter::write_at(const std::string& text, std::uint64_t offset) {
  if (handle_ < 0) handle_ = ::open(file_.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (handle_ < 0) return errno;
  if (const int failed_with = write_all(handle_, text, offset)) return failed_with;
  if (::fdatasync(handle_) != 0) return errno;
  if (folder_synced_) return 0;
  const int failed_with = sync_folder(file_.parent_path());
  folder_synced_ = failed_with == 0;
  return failed_with;
}

}  // namespace argil::io
