// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "argil/core/distance_probe.h"
#include "argil/engine/field_sampler.h"

namespace argil::io {

/// Samplers of a clay that are lent for a piece of work after another: what one has looked up the
/// next finds.
///
/// Threads      any; the clay must stay as it is.
class SamplerPool {
 public:
  explicit SamplerPool(const Clay& clay) : clay_(clay) { free_.reserve(kMostFree); }

  /// A sampler for one thread, given back at the end. The pool must outlive it.
  class Lent final : public DistanceProbe {
   public:
    explicit Lent(SamplerPool& pool) : pool_(pool), sampler_(pool.take()) {}
    ~Lent() override { pool_.give(std::move(sampler_)); }
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;

    FieldSampler& sampler() noexcept { return *sampler_; }
    double distance_mm(const Vec3& point_mm) override { return sampler_->distance_mm(point_mm); }
    FieldValue value(const Vec3& point_mm) override { return sampler_->value(point_mm); }

   private:
    SamplerPool& pool_;
    std::unique_ptr<FieldSampler> sampler_;
  };

 private:
  std::unique_ptr<FieldSampler> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<FieldSampler>(clay_);
    std::unique_ptr<FieldSampler> last = std::move(free_.back());
    free_.pop_back();
    return last;
  }
  /// As many are kept as threads may want at once; each may have looked up megabytes.
  static constexpr std::size_t kMostFree = 64;
  void give(std::unique_ptr<FieldSampler> sampler) noexcept {
    const std::lock_guard lock(mutex_);
    if (free_.size() < kMostFree) free_.push_back(std::move(sampler));
  }

  const Clay& clay_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<FieldSampler>> free_;
};

}  // namespace argil::io
