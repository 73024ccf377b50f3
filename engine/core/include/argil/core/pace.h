// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <string_view>

#include "argil/core/progress.h"

namespace argil {

/// Thrown where progress asked to stop; no_throw makes ErrorKind::interrupted of it. An exception,
/// because it must also leave loops of CGAL and TBB. Whatever takes a Pace may throw it and is to
/// be called within no_throw.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// How far one part of some work has come, told to progress as a share of the whole. A part of a
/// part is a Pace too, so that a function reports from 0 to 1 without knowing what it is a part of.
///
/// Shapes       stage: a string literal, or what else outlives the work; only the view is kept. So
///              is the Progress given to the constructor: by reference, which a temporary breaks.
/// Units        fractions from 0 to 1 of this part; begin <= end. Nothing is clamped: who passes
///              more tells more.
/// Threads      `at` only from the thread that began the work.
/// Cost         one call of the progress function for each `at`; nothing where that is empty.
class Pace {
 public:
  /// `progress` must stay; an empty one hears nothing and never stops the work.
  explicit Pace(const Progress& progress, std::string_view stage)
      : progress_(&progress), stage_(stage) {}

  /// Tells that so much of this part is done, and throws Interrupted when the work shall stop: what
  /// calls it must be able to leave everything as it was from there. From the thread that began it.
  void at(double fraction) const {
    if (*progress_ && !(*progress_)(stage_, begin_ + fraction * (end_ - begin_))) {
      throw Interrupted();
    }
  }
  /// The part of this that runs from `begin` to `end`, under the same name or one of its own. From
  /// 0 to 0 it is work whose length is not told, but which can still be stopped.
  Pace part(double begin, double end) const { return part(stage_, begin, end); }
  Pace part(std::string_view stage, double begin, double end) const {
    Pace inner = *this;
    inner.stage_ = stage;
    inner.begin_ = begin_ + begin * (end_ - begin_);
    inner.end_ = begin_ + end * (end_ - begin_);
    return inner;
  }
  /// This as a Progress, for work that takes one: the name of the stage it tells is passed over,
  /// and a stop leaves it as Interrupted instead of a false answer. Holds a copy of this, and so
  /// needs only the Progress at the root of it to stay.
  Progress progress() const {
    return [pace = *this](std::string_view, double fraction) {
      pace.at(fraction);
      return true;
    };
  }

 private:
  const Progress* progress_;
  std::string_view stage_;
  // Of the whole work, whatever part of a part this is.
  double begin_ = 0.0;
  double end_ = 1.0;
};

}  // namespace argil
