// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/image_reader.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <string_view>
#include <utility>

#include "settings/reference_list.h"

namespace argil::viewer {

namespace fs = std::filesystem;

ImageReader::ImageReader(fs::path home, std::function<void()> on_news)
    : home_(std::move(home)), on_news_(std::move(on_news)), thread_([this] { run(); }) {}

ImageReader::~ImageReader() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    stops_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void ImageReader::read_reference(const fs::path& file) { put(ReadReference{file}); }
void ImageReader::read_alphas() { put(ReadAlphas{}); }
void ImageReader::add_alpha(const fs::path& file) { put(AddAlpha{file}); }

/// What waits already is done once: it will be read as it is then.
void ImageReader::put(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (std::find(jobs_.begin(), jobs_.end(), job) != jobs_.end()) return;
    jobs_.push_back(std::move(job));
  }
  wake_.notify_all();
}

/// `is_forgotten`: of a file of a reference.
template <class Which>
void ImageReader::forget(const Which& is_forgotten) {
  const auto is_meant = [&](const Job& job) {
    const auto* reference = std::get_if<ReadReference>(&job);
    return reference != nullptr && is_forgotten(reference->file);
  };
  const std::lock_guard lock(mutex_);
  std::erase_if(jobs_, is_meant);
  std::erase_if(news_.references, [&](const auto& read) { return is_forgotten(read.first); });
  if (at_work_ && is_meant(*at_work_)) stops_ = true;
}

void ImageReader::forget_reference(const fs::path& file) {
  forget([&](const fs::path& other) { return other == file; });
}

void ImageReader::forget_references() {
  forget([](const fs::path&) { return true; });
}

ImageReader::News ImageReader::take_news() {
  const std::lock_guard lock(mutex_);
  has_news_ = false;
  return std::exchange(news_, News());
}

bool ImageReader::is_idle() const {
  const std::lock_guard lock(mutex_);
  return jobs_.empty() && !at_work_ && news_.empty();
}

void ImageReader::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
    if (is_ending_) return;
    at_work_ = std::move(jobs_.front());
    jobs_.pop_front();
    stops_ = false;
    const Job job = *at_work_;
    lock.unlock();
    News made;
    work(job, made);
    lock.lock();
    at_work_.reset();
    // Half of it is of no use to anybody.
    if (!stops_ && !is_ending_) {
      news_.references.insert(news_.references.end(),
                              std::make_move_iterator(made.references.begin()),
                              std::make_move_iterator(made.references.end()));
      if (made.alphas) news_.alphas = std::move(made.alphas);
      news_.added.insert(news_.added.end(), std::make_move_iterator(made.added.begin()),
                         std::make_move_iterator(made.added.end()));
    }
    // Also of what was stopped: who waits for the end of all of it looks again.
    has_news_ = true;
    lock.unlock();
    if (on_news_) on_news_();
    lock.lock();
  }
}

void ImageReader::work(const Job& job, News& news) const {
  const Progress goes_on = [this](std::string_view, double) { return !stops_; };
  const auto* reference = std::get_if<ReadReference>(&job);
  const auto* added = std::get_if<AddAlpha>(&job);
  const Error no_memory{ErrorKind::memory,
                        "not enough memory to read images; close other programs"};
  try {
    if (reference != nullptr) {
      news.references.emplace_back(reference->file, read_pixels(reference->file, goes_on));
    } else if (added != nullptr) {
      news.added.push_back(viewer::add_alpha(home_, added->file, goes_on));
    } else {
      news.alphas = viewer::read_alphas(home_, goes_on);
    }
  } catch (const std::bad_alloc&) {
    news = {};
    if (reference != nullptr) {
      news.references.emplace_back(reference->file, no_memory);
    } else if (added != nullptr) {
      news.added.emplace_back(no_memory);
    } else {
      news.alphas = AlphaList{{}, {no_memory}};
    }
  }
}

}  // namespace argil::viewer
