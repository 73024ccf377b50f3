// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/file_looks.h"

#include <cassert>
#include <chrono>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>

namespace argil::viewer {

FileLooks::FileLooks(std::function<FileLook(const std::filesystem::path&)> look,
                     std::function<void()> on_news)
    : shared_(std::make_shared<Shared>()) {
  assert(look && on_news);
  shared_->look = std::move(look);
  shared_->on_news = std::move(on_news);
}

FileLooks::~FileLooks() {
  constexpr std::chrono::seconds kPatience{1};
  if (!thread_.joinable()) return;
  bool has_ended = false;
  {
    std::unique_lock lock(shared_->mutex);
    shared_->is_ending = true;
    shared_->wake.notify_all();
    has_ended = shared_->ended.wait_for(lock, kPatience, [this] { return shared_->has_ended; });
  }
  if (has_ended) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

void FileLooks::want(std::vector<std::filesystem::path> files) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->wanted.assign(std::make_move_iterator(files.begin()),
                           std::make_move_iterator(files.end()));
    shared_->looks.clear();
    shared_->has_news = false;
    ++shared_->list;
    if (shared_->wanted.empty()) return;
  }
  shared_->wake.notify_all();
  if (thread_.joinable()) return;
  try {
    thread_ = std::thread([shared = shared_] { run(*shared); });
  } catch (const std::system_error&) {
    // Without a thread the list has names alone, which are enough to choose by.
    const std::lock_guard lock(shared_->mutex);
    shared_->wanted.clear();
  }
}

std::vector<FileLook> FileLooks::take() {
  const std::lock_guard lock(shared_->mutex);
  shared_->has_news = false;
  return std::exchange(shared_->looks, {});
}

bool FileLooks::is_idle() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->wanted.empty() && shared_->looks.empty() && !shared_->is_looking;
}

void FileLooks::run(Shared& shared) {
  std::unique_lock lock(shared.mutex);
  for (;;) {
    shared.wake.wait(lock, [&] { return shared.is_ending || !shared.wanted.empty(); });
    if (shared.is_ending) break;
    const std::filesystem::path file = std::move(shared.wanted.front());
    shared.wanted.pop_front();
    shared.is_looking = true;
    const std::size_t list = shared.list;
    lock.unlock();
    FileLook look;
    try {
      look = shared.look(file);
    } catch (const std::bad_alloc&) {
      look = {};  // it stands there by its name
    }
    lock.lock();
    shared.is_looking = false;
    if (shared.is_ending) break;
    if (list == shared.list && !look.file.empty()) {
      shared.looks.push_back(std::move(look));
      shared.has_news = true;
      shared.on_news();  // under the lock: where this is gone, so is what it would call
    }
  }
  shared.has_ended = true;
  shared.ended.notify_all();
}

}  // namespace argil::viewer
