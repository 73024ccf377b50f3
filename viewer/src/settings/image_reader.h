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
#include <optional>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "picture/reference_image.h"
#include "settings/alpha_list.h"

namespace argil::viewer {

/// A thread that reads images one after another, in the order in which they were asked for. The
/// caller never waits for it.
///
/// Threads  the functions: the window's. `on_news` is called on the reader's.
class ImageReader {
 public:
  /// What was read, each once. Of what was stopped there is nothing.
  struct News {
    using Pixels = Result<std::shared_ptr<const ReferencePixels>>;
    std::vector<std::pair<std::filesystem::path, Pixels>> references;
    std::optional<AlphaList> alphas;  ///< the newest list
    std::vector<Result<std::filesystem::path>> added;
    bool empty() const noexcept { return references.empty() && !alphas && added.empty(); }
  };

  ImageReader(std::filesystem::path home, std::function<void()> on_news);
  /// Stops what is under way: ImageReaderTest.EndsWithoutWaiting.
  ~ImageReader();
  ImageReader(const ImageReader&) = delete;
  ImageReader& operator=(const ImageReader&) = delete;

  /// read_pixels() of a file, once for all who ask before it is begun.
  void read_reference(const std::filesystem::path& file);
  /// Nobody wants those any more that were asked for so far; of one file, or all.
  void forget_reference(const std::filesystem::path& file);
  void forget_references();
  /// viewer::read_alphas() of the home.
  void read_alphas();
  /// viewer::add_alpha() of a file, News::added.
  void add_alpha(const std::filesystem::path& file);

  News take_news();
  bool has_news() const noexcept { return has_news_; }
  /// All that was asked for is done and taken.
  bool is_idle() const;

 private:
  struct ReadReference {
    std::filesystem::path file;
    friend bool operator==(const ReadReference&, const ReadReference&) = default;
  };
  struct ReadAlphas {
    friend bool operator==(const ReadAlphas&, const ReadAlphas&) = default;
  };
  struct AddAlpha {
    std::filesystem::path file;
    friend bool operator==(const AddAlpha&, const AddAlpha&) = default;
  };
  using Job = std::variant<ReadReference, ReadAlphas, AddAlpha>;

  void put(Job job);
  template <class Which>
  void forget(const Which& is_forgotten);
  void run();
  void work(const Job& job, News& news) const;

  std::filesystem::path home_;
  std::function<void()> on_news_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;  ///< that wait
  std::optional<Job> at_work_;
  News news_;
  bool is_ending_ = false;
  std::atomic<bool> has_news_{false};
  std::atomic<bool> stops_{false};  ///< what is under way
  std::thread thread_;
};

}  // namespace argil::viewer
