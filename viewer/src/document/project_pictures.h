// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "document/picture_shot.h"
#include "settings/thumbnail.h"

namespace argil::viewer {

/// Draws and writes small pictures of projects on a thread of its own, which there is only from the
/// first one on. One that cannot be drawn or written is left out silently: nobody's work depends on
/// it.
///
/// Threads  the document thread. The destructor waits for the pictures that were asked for, some
///          tenths of a second each; once the program is told to end (io::interrupted) there are
///          none.
class ProjectPictures {
 public:
  explicit ProjectPictures(PicturePlaces places);
  ~ProjectPictures();
  ProjectPictures(const ProjectPictures&) = delete;
  ProjectPictures& operator=(const ProjectPictures&) = delete;

  bool are_kept() const noexcept { return !places_.saved.empty(); }

  /// Whether a picture of the file as it is now is kept or on its way.
  bool has_saved(const std::filesystem::path& file) const;
  /// The picture of a file that was just saved.
  void keep_saved(const std::filesystem::path& file, PictureShot shot);
  /// With so many steps that it has not.
  void keep_work(const std::filesystem::path& file, PictureShot shot, std::size_t steps);
  /// There is no such work any more.
  void forget_work(const std::filesystem::path& file);

 private:
  struct Job {
    std::filesystem::path folder;
    std::filesystem::path file;
    FileStamp stamp;
    std::optional<std::size_t> steps;
    std::optional<PictureShot> shot;  ///< nothing: what is kept is removed
  };
  void add(Job job);
  void run();
  static void work_off(const Job& job);

  PicturePlaces places_;
  /// Of the file that was saved last, when its picture was asked for.
  std::filesystem::path saved_file_;
  std::optional<FileStamp> saved_stamp_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace argil::viewer
