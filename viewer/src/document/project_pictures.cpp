// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/project_pictures.h"

#include <algorithm>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "argil/io/safe_file.h"

namespace argil::viewer {

namespace fs = std::filesystem;

ProjectPictures::ProjectPictures(PicturePlaces places) : places_(std::move(places)) {}

ProjectPictures::~ProjectPictures() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool ProjectPictures::has_saved(const fs::path& file) const {
  const auto stamp = stamp_of(file);
  if (stamp && file == saved_file_ && stamp == saved_stamp_) return true;
  return has_picture(places_.saved, file);
}

void ProjectPictures::keep_saved(const fs::path& file, PictureShot shot) {
  const auto stamp = stamp_of(file);
  if (!stamp || !are_kept()) return;
  saved_file_ = file;
  saved_stamp_ = stamp;
  add({places_.saved, file, *stamp, std::nullopt, std::move(shot)});
}

void ProjectPictures::keep_work(const fs::path& file, PictureShot shot, std::size_t steps) {
  const auto stamp = stamp_of(file);
  if (!stamp || !are_kept()) return;
  add({places_.work, file, *stamp, steps, std::move(shot)});
}

void ProjectPictures::forget_work(const fs::path& file) {
  if (!are_kept()) return;
  // Where none was asked for yet there is mostly none, and no thread is needed to find that.
  std::error_code error;
  if (!thread_.joinable() && !fs::exists(picture_file(places_.work, file), error)) return;
  add({places_.work, file, {}, std::nullopt, std::nullopt});
}

/// In the place of one for the same picture that has not been begun.
void ProjectPictures::add(Job job) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(jobs_, [&](const Job& other) {
      return other.folder == job.folder && other.file == job.file;
    });
    jobs_.push_back(std::move(job));
  }
  wake_.notify_all();
  if (thread_.joinable()) return;
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    const std::lock_guard lock(mutex_);
    jobs_.clear();
  }
}

void ProjectPictures::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
    if (jobs_.empty() || io::interrupted()) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    try {
      work_off(job);
    } catch (const std::bad_alloc&) {
      // As one that the disk has no room for.
    }
    lock.lock();
  }
}

void ProjectPictures::work_off(const Job& job) {
  if (!job.shot) {
    std::error_code error;
    fs::remove(picture_file(job.folder, job.file), error);
    return;
  }
  const auto goes_on = [](std::string_view, double) { return !io::interrupted(); };
  const auto image = draw(*job.shot, goes_on);
  if (!image) return;
  static_cast<void>(write_picture(job.folder, job.file, job.stamp, image.value(), job.steps).ok());
}

}  // namespace argil::viewer
