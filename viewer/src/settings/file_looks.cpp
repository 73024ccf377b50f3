// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/file_looks.h"

#include <cassert>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>

namespace argil::viewer {

FileLooks::FileLooks(PicturePlaces places, std::function<void()> on_news)
    : places_(std::move(places)), on_news_(std::move(on_news)) {
  assert(on_news_);
}

FileLooks::~FileLooks() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FileLooks::want(std::vector<std::filesystem::path> files) {
  {
    const std::lock_guard lock(mutex_);
    wanted_.assign(std::make_move_iterator(files.begin()), std::make_move_iterator(files.end()));
    looks_.clear();
    has_news_ = false;
    ++list_;
    if (wanted_.empty()) return;
  }
  wake_.notify_all();
  if (thread_.joinable()) return;
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    // Without a thread the list has names alone, which are enough to choose by.
    const std::lock_guard lock(mutex_);
    wanted_.clear();
  }
}

std::vector<FileLook> FileLooks::take() {
  const std::lock_guard lock(mutex_);
  has_news_ = false;
  return std::exchange(looks_, {});
}

bool FileLooks::is_idle() const {
  const std::lock_guard lock(mutex_);
  return wanted_.empty() && looks_.empty() && !is_looking_;
}

void FileLooks::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return is_ending_ || !wanted_.empty(); });
    if (is_ending_) return;
    const std::filesystem::path file = std::move(wanted_.front());
    wanted_.pop_front();
    is_looking_ = true;
    const std::size_t list = list_;
    lock.unlock();
    FileLook look;
    try {
      look = look_at_file(places_, file);
    } catch (const std::bad_alloc&) {
      look = {};  // it stands there by its name
    }
    lock.lock();
    if (list == list_ && !look.file.empty()) {
      looks_.push_back(std::move(look));
      has_news_ = true;
      lock.unlock();
      on_news_();
      lock.lock();
    }
    is_looking_ = false;
  }
}

}  // namespace argil::viewer
