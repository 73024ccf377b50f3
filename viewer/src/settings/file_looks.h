// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "settings/thumbnail.h"

namespace argil::viewer {

/// Looks at the files of a list (look_at_file) on a thread of its own, which there is only from the
/// first list on: nobody waits for a disk.
///
/// Threads  want, take, is_idle: the window's. The destructor waits for the file that is being
///          looked at.
class FileLooks {
 public:
  /// `on_news` is called on the other thread when there is something to take.
  FileLooks(PicturePlaces places, std::function<void()> on_news);
  ~FileLooks();
  FileLooks(const FileLooks&) = delete;
  FileLooks& operator=(const FileLooks&) = delete;

  /// Looks at these in their order, also at those that were looked at before; what was wanted and
  /// has not come yet is forgotten.
  void want(std::vector<std::filesystem::path> files);
  /// What has come since the last call.
  std::vector<FileLook> take();
  bool has_news() const noexcept { return has_news_; }
  /// Everything that was wanted has come and was taken.
  bool is_idle() const;

 private:
  void run();

  PicturePlaces places_;
  std::function<void()> on_news_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::filesystem::path> wanted_;
  std::vector<FileLook> looks_;
  std::atomic<bool> has_news_{false};
  std::size_t list_ = 0;  ///< which one is wanted
  bool is_looking_ = false;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace argil::viewer
