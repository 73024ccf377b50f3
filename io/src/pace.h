// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <string_view>

#include "argil/core/progress.h"

namespace argil::io {

/// Thrown where progress asked to stop; no_throw makes ErrorKind::interrupted of it. An exception,
/// because it must also leave loops of CGAL and TBB.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// How far one part of some work has come, told to progress as a share of the whole; names of
/// stages are literals.
class Pace {
 public:
  /// `progress` must stay; an empty one hears nothing and never stops the work.
  explicit Pace(const Progress& progress, std::string_view stage)
      : progress_(&progress), stage_(stage) {}

  /// Throws Interrupted when the work shall stop. From the thread that began it.
  void at(double fraction) const {
    if (*progress_ && !(*progress_)(stage_, begin_ + fraction * (end_ - begin_))) {
      throw Interrupted();
    }
  }
  /// What runs from `begin` to `end` of this.
  Pace part(double begin, double end) const { return part(stage_, begin, end); }
  Pace part(std::string_view stage, double begin, double end) const {
    Pace inner = *this;
    inner.stage_ = stage;
    inner.begin_ = begin_ + begin * (end_ - begin_);
    inner.end_ = begin_ + end * (end_ - begin_);
    return inner;
  }
  /// For work that tells a Progress of one stage of its own.
  Progress progress() const {
    return [pace = *this](std::string_view, double fraction) {
      pace.at(fraction);
      return true;
    };
  }

 private:
  const Progress* progress_;
  std::string_view stage_;
  double begin_ = 0.0;
  double end_ = 1.0;
};

}  // namespace argil::io
