// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "settings/thumbnail.h"

namespace argil::viewer {

/// Looks at the files of a list on a thread of its own, which there is only from the
/// first list on: nobody waits for a disk.
///
/// Threads  want, take, is_idle: the window's. The destructor waits for the file that is being
///          looked at, but not for a disk that does not answer, as one of a network may: after a
///          second that thread is left to itself, and calls nothing but `look` any more.
class FileLooks {
 public:
  /// Both are called on the other thread: `look` for each file (look_at_file), which may throw
  /// bad_alloc, and `on_news` when there is something to take. That must not call this.
  FileLooks(std::function<FileLook(const std::filesystem::path&)> look,
            std::function<void()> on_news);
  ~FileLooks();
  FileLooks(const FileLooks&) = delete;
  FileLooks& operator=(const FileLooks&) = delete;

  /// Looks at these in their order, also at those that were looked at before; what was wanted and
  /// has not come yet is forgotten.
  void want(std::vector<std::filesystem::path> files);
  /// What has come since the last call.
  std::vector<FileLook> take();
  bool has_news() const noexcept { return shared_->has_news; }
  /// Everything that was wanted has come and was taken.
  bool is_idle() const;

 private:
  /// What the thread sees, and keeps while this is gone already.
  struct Shared {
    std::function<FileLook(const std::filesystem::path&)> look;
    std::function<void()> on_news;
    std::mutex mutex;
    std::condition_variable wake;   ///< for the thread
    std::condition_variable ended;  ///< for the destructor
    std::deque<std::filesystem::path> wanted;
    std::vector<FileLook> looks;
    std::atomic<bool> has_news{false};
    std::size_t list = 0;  ///< which one is wanted
    bool is_looking = false;
    bool is_ending = false;
    bool has_ended = false;
  };
  static void run(Shared& shared);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace argil::viewer
