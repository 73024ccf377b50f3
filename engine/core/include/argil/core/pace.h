// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <string_view>

#include "argil/core/progress.h"

namespace argil {

/// Thrown where progress asked to stop; no_throw makes ErrorKind::interrupted of it. An exception,
/// because it must also leave loops of CGAL and TBB.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// How far one part of some work has come, told to progress as a share of the whole. A part of a
/// part is a Pace too, so that a function reports from 0 to 1 without knowing what it is a part of.
///
/// Shapes       stage: a string literal, or what else outlives the work; only the view is kept.
/// Units        fractions from 0 to 1 of this part; begin <= end.
/// Threads      `at` only from the thread that began the work.
/// Cost         one call of the progress function for each `at`; nothing where that is empty.
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
  /// The part of this that runs from `begin` to `end`, under the same name or one of its own.
  Pace part(double begin, double end) const { return part(stage_, begin, end); }
  Pace part(std::string_view stage, double begin, double end) const {
    Pace inner = *this;
    inner.stage_ = stage;
    inner.begin_ = begin_ + begin * (end_ - begin_);
    inner.end_ = begin_ + end * (end_ - begin_);
    return inner;
  }
  /// This as a Progress, for work that takes one: the name of the stage it tells is passed over,
  /// and a stop leaves it as Interrupted instead of a false answer.
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

}  // namespace argil
